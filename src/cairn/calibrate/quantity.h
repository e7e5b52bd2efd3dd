// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace cairn {

/// Says what a recording tells about a quantity of its calibration.
enum class Finding {
  undetermined,  ///< the recording does not show it, see Quantity::why
  as_stated,     ///< it is what the calibration states, as far as the recording shows
  off,           ///< it differs from what the calibration states
};

/// Holds how far a quantity is from what the calibration states.
struct Quantity {
  std::string name, unit;
  double value = 0;  ///< true value less the stated one; of a factor, true value over the stated one
  double sigma = 0;  ///< standard deviation; where undetermined, with what was assumed beforehand
  Finding finding = Finding::undetermined;
  std::string why;          ///< why it is undetermined; empty if it is not
  bool is_written = false;  ///< whether the calibration that was made of it has it
};

/// Returns "undetermined", "as stated" or "off".
[[nodiscard]] inline const char* to_string(Finding finding) {
  switch (finding) {
    case Finding::as_stated:
      return "as stated";
    case Finding::off:
      return "off";
    case Finding::undetermined:
      break;
  }
  return "undetermined";
}

}  // namespace cairn
