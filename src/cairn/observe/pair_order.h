// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Counts matches that tell whether the left images of a stereo sequence are the left camera's. What both
/// cameras see lies further left in the right image (a positive disparity) and on the same row; if the two
/// images are exchanged, the sign is as well.
struct PairOrder {
  int pairs = 0;     ///< pairs that were examined
  int as_given = 0;  ///< matches of features on one row with a positive disparity
  /// Matches of features on one row with a positive disparity if left and right are exchanged, rectified for
  /// that; counted only if as_given leaves a doubt.
  int exchanged = 0;

  /// Returns whether there are many matches with the images exchanged, and few as given. Returns false if
  /// there are few in both cases: poor texture, or a scene so far away that it has no disparity.
  [[nodiscard]] bool looks_exchanged() const;
};

/// Matches features of a few pairs over the whole sequence, as many as are needed to decide: one pair if the
/// order is right and the texture good. Pairs that cannot be read are ignored. Counts nothing for a sequence
/// without right images.
[[nodiscard]] PairOrder measure_pair_order(const Sequence& sequence);

/// Throws InputError with the figures and the remedy if the images look exchanged.
void check_pair_order(const Sequence& sequence);

}  // namespace cairn
