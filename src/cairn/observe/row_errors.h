// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/core/executor.h"
#include "cairn/geometry/stereo_correction.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds how far the rows of a recording's stereo pairs are from one another, of what both images show.
struct RowErrors {
  RowField field = RowField::Zero();  ///< left row less right row
  /// Standard deviations of its terms, pixels: by the scatter of the matches, or half of what both halves of
  /// the pairs differ by if that is more.
  RowField sigma = RowField::Zero();
  int pairs = 0;          ///< pairs with matches
  int matches = 0;        ///< windows found in both images
  double rms_px = 0;      ///< of the field over the matches
  double scatter_px = 0;  ///< robust standard deviation of the matches about the field
  /// Root mean square over the matches of the difference between the fields of the first and the second half
  /// of the pairs.
  double halves_differ_px = 0;

  /// Returns whether there are enough matches, from two pairs or more.
  [[nodiscard]] bool is_determined() const;
  /// Returns whether the field is determined, agrees between the halves of the recording and is large enough
  /// to matter: an error of the row of 0.25 px was seen to bias disparities by 0.05 px.
  [[nodiscard]] bool should_be_applied() const;
};

/// Measures the rows of up to 8 pairs over the whole sequence: features matched within some rows, the
/// windows around them found again in the right image in both directions, and a robust fit (Cauchy's weights)
/// of 1, x, y, x y, x^2, y^2. Pairs that cannot be read are ignored. Measures nothing in a sequence without
/// right images. Deterministic at any number of threads.
[[nodiscard]] RowErrors measure_row_errors(const Sequence& sequence, const Executor& executor);

/// Holds a sequence whose right images are loaded with their rows corrected, where that was worth it.
struct AlignedRows {
  Sequence sequence;
  RowErrors errors;      ///< of the given sequence; all zero if they were not measured
  bool applied = false;  ///< whether the sequence's calibration has the field now
};

/// Measures the rows of a stereo sequence and corrects them as `self_calibration` says: "auto" where they
/// should be, "report" never, "off" does not measure. A calibration that states a correction keeps it.
[[nodiscard]] AlignedRows align_rows(const Sequence& sequence, const std::string& self_calibration,
                                     const Executor& executor);

}  // namespace cairn
