// SPDX-License-Identifier: Apache-2.0
#include "matched_geometry.h"

#include "cairn/features/matching.h"

namespace cairn::bench {

Correctness count_correct(const Extractor& extractor, const ImagePair& pair) {
  constexpr double kMaxErrorPx = 2;
  const Features first = extractor.extract(pair.first);
  const Features second = extractor.extract(pair.second);
  Correctness counted;
  for (const Match& match : match_mutual(first.descriptors, second.descriptors)) {
    const Keypoint& a = first.keypoints[static_cast<std::size_t>(match.query)];
    const Keypoint& b = second.keypoints[static_cast<std::size_t>(match.train)];
    const auto place = pair.place_in_second({a.u, a.v});
    if (!place) continue;
    ++counted.matches;
    if ((*place - Eigen::Vector2d(b.u, b.v)).norm() <= kMaxErrorPx) ++counted.correct;
  }
  return counted;
}

}  // namespace cairn::bench
