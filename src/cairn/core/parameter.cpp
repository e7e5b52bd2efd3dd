// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/parameter.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {

void check_parameter(bool holds, const char* name, const char* expected, double found) {
  if (!holds)
    throw InputError({name, 0, expected, fmt::format("{}", found), "Leave it out for the default."});
}

bool is_positive(double value) {
  return value > 0 && std::isfinite(value);
}

bool is_share(double value) {
  return value >= 0 && value <= 1;
}

}  // namespace cairn
