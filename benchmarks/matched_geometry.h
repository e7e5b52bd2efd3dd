// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/features/extractor.h"
#include "comparison.h"
#include "image_pairs.h"

namespace cairn::bench {

/// Matches of a pair that agree with its true geometry.
struct Correctness {
  int matches = 0;  ///< those whose first pixel has a true place
  int correct = 0;  ///< of these, within 2 px of it
};

/// Extracts both images, matches mutual nearest neighbours with cairn's matcher, and compares with the truth.
[[nodiscard]] Correctness count_correct(const Extractor& extractor, const ImagePair& pair);

/// Adds a row for each group of pairs: correct matches of ours and of the peer's extractor.
void add_correct_matches(Comparisons& comparisons, const std::string& work, const Extractor& ours,
                         const Extractor& peers, const std::vector<ImagePair>& pairs, double at_least_share);

}  // namespace cairn::bench
