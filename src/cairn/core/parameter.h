// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"

namespace cairn {

/// InputError that names the parameter, unless `holds`.
template <class Value>
void check_parameter(bool holds, const char* name, const char* expected, const Value& found) {
  if (!holds)
    throw InputError({name, 0, expected, fmt::format("{}", found), "Leave it out for the default."});
}

[[nodiscard]] inline bool is_positive(double value) {
  return value > 0 && std::isfinite(value);
}

[[nodiscard]] inline bool is_share(double value) {
  return value >= 0 && value <= 1;
}

}  // namespace cairn
