// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cairn {

/// Returns `part` / `whole` of two counts; 0 of nothing.
template <class Part, class Whole>
[[nodiscard]] double ratio(Part part, Whole whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

/// Returns `part` of `whole` in percent, both counts; 0 of nothing.
template <class Part, class Whole>
[[nodiscard]] double share_percent(Part part, Whole whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace cairn
