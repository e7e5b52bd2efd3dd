// SPDX-License-Identifier: Apache-2.0
#include "matched_geometry.h"

#include "cairn/matching/matching.h"

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

void add_correct_matches(Comparisons& comparisons, const std::string& work, const Extractor& ours,
                         const Extractor& peers, const std::vector<ImagePair>& pairs, double at_least_share) {
  std::vector<QualityComparison> rows;
  for (const ImagePair& pair : pairs) {
    const std::string name = work + ", correct matches, " + pair.group;
    if (rows.empty() || rows.back().work != name) rows.push_back({name, 0, 0, at_least_share, {}});
    rows.back().ours += count_correct(ours, pair).correct;
    rows.back().peers += count_correct(peers, pair).correct;
  }
  comparisons.quality.insert(comparisons.quality.end(), rows.begin(), rows.end());
}

}  // namespace cairn::bench
