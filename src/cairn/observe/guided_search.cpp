// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/guided_search.h"

namespace cairn {

void GuidedSearch::add(std::size_t number, const Eigen::Vector3d& point_in_world,
                       const Appearance& appearance, double extra_px) {
  auto window = predict_window(frame_, point_in_world, appearance, radius_px_);
  if (!window) return;
  window->radius_px += extra_px;
  numbers_.push_back(number);
  windows_.push_back(*window);
  appearances_.push_back(appearance);
}

std::vector<GuidedMatch> GuidedSearch::match(double max_ratio, const Executor& executor) const {
  const Features& features = frame_.observed.features;
  const MatchOptions options{descriptor_limit(features.descriptors), max_ratio, true};
  std::vector<GuidedMatch> matches;
  if (numbers_.empty()) return matches;
  for (const Match& match : match_predicted(windows_, gather(appearances_), features, options, executor))
    matches.push_back({numbers_[static_cast<std::size_t>(match.query)], match.train, match.distance});
  return matches;
}

}  // namespace cairn
