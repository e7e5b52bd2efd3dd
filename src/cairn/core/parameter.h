// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// InputError that names the parameter, unless `holds`.
void check_parameter(bool holds, const char* name, const char* expected, double found);

/// Above 0 and finite.
[[nodiscard]] bool is_positive(double value);
/// From 0 to 1.
[[nodiscard]] bool is_share(double value);

}  // namespace cairn
