// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Whether the left images of a stereo sequence are the left camera's. What both cameras see lies further
/// left in the right image (a positive disparity) and on the same row; where the two images are exchanged, so
/// is the sign.
struct PairOrder {
  int pairs = 0;      ///< that were looked at
  int as_given = 0;   ///< matches of features on one row with a positive disparity
  int exchanged = 0;  ///< the same with left and right exchanged, rectified for that; counted only where
                      ///< as_given leaves a doubt

  /// Many matches the other way around, and few as given. False also where there are few either way: poor
  /// texture, or a scene so far away that it has no disparity.
  [[nodiscard]] bool looks_exchanged() const;
};

/// Matches features of a few pairs of the sequence, from its beginning to its end, as far as is needed to
/// decide: one pair where the order is right and the texture good. Pairs that cannot be read are passed over.
/// Nothing is counted for a sequence without right images.
[[nodiscard]] PairOrder measure_pair_order(const Sequence& sequence);

/// InputError with the figures and the way out where the images look exchanged.
void check_pair_order(const Sequence& sequence);

}  // namespace cairn
