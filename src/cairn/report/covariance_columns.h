// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Returns the names of the 21 columns of a covariance, as read_covariance_table wants them, a comma before
/// each: ",PREFIXrx_rx,PREFIXrx_ry" and so on, the upper triangle by rows.
[[nodiscard]] std::string format_covariance_names(const std::string& prefix);

/// Returns the values of these columns, a comma before each.
[[nodiscard]] std::string format_covariance_values(const Matrix6d& covariance);

}  // namespace cairn
