// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/covariance_columns.h"

#include <fmt/format.h>

#include "cairn/evaluate/covariance_table.h"

namespace cairn {

std::string format_covariance_names(const std::string& prefix) {
  std::string text;
  for (const std::string& name : covariance_columns(prefix)) text += "," + name;
  return text;
}

std::string format_covariance_values(const Matrix6d& covariance) {
  std::string text;
  for (int i = 0; i < 6; ++i)
    for (int k = i; k < 6; ++k) text += fmt::format(",{:.9g}", covariance(i, k));
  return text;
}

}  // namespace cairn
