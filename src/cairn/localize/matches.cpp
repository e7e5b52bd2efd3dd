// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/matches.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "cairn/observe/guided_search.h"

namespace cairn {
namespace {

/// Holds a match by descriptor.
struct Candidate {
  float distance;
  std::int32_t feature;
  LandmarkId landmark;
  const StoredKeyframe* keyframe;
  bool operator<(const Candidate& other) const {
    return std::tie(distance, feature, landmark) < std::tie(other.distance, other.feature, other.landmark);
  }
};

/// Keeps the nearest match of each feature and of each landmark, by feature.
std::vector<Candidate> keep_nearest(std::vector<Candidate> candidates, std::size_t features) {
  std::stable_sort(candidates.begin(), candidates.end());
  std::vector<char> taken(features, 0);
  std::vector<Candidate> kept;
  for (const Candidate& candidate : candidates) {
    char& of_feature = taken[static_cast<std::size_t>(candidate.feature)];
    if (of_feature != 0) continue;
    of_feature = 1;
    kept.push_back(candidate);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Candidate& a, const Candidate& b) { return a.landmark < b.landmark; });
  kept.erase(std::unique(kept.begin(), kept.end(),
                         [](const Candidate& a, const Candidate& b) { return a.landmark == b.landmark; }),
             kept.end());
  std::sort(kept.begin(), kept.end(),
            [](const Candidate& a, const Candidate& b) { return a.feature < b.feature; });
  return kept;
}

std::vector<LandmarkMatch> with_points(const StoredMap& map, const ObservedFrame& observed,
                                       const std::vector<Candidate>& candidates) {
  std::vector<LandmarkMatch> matches;
  for (const Candidate& candidate : candidates) {
    const StoredLandmark landmark = map.landmark(candidate.landmark);
    const Eigen::Matrix3d covariance = map.noise_covariance(candidate.landmark);
    if (!covariance.allFinite()) continue;
    const Eigen::Vector3d ray = landmark.point_in_world - candidate.keyframe->world_from_camera.translation;
    const auto feature = static_cast<std::size_t>(candidate.feature);
    matches.push_back({candidate.feature, observed.observations[feature], candidate.landmark,
                       landmark.point_in_world, covariance, ray.norm()});
  }
  return matches;
}

}  // namespace

std::vector<LandmarkMatch> match_keyframes(const StoredMap& map, const Keyframes& keyframes,
                                           const ObservedFrame& observed, double max_ratio) {
  const Descriptors& descriptors = observed.features.descriptors;
  const MatchOptions options{descriptor_limit(descriptors), max_ratio, true};
  std::vector<Candidate> candidates;
  for (const auto& keyframe : keyframes)
    for (const Match& match : match_descriptors(descriptors, keyframe->descriptors, options))
      candidates.push_back({match.distance, match.query,
                            keyframe->landmarks[static_cast<std::size_t>(match.train)], keyframe.get()});
  return with_points(map, observed, keep_nearest(std::move(candidates), descriptors.count()));
}

std::vector<LandmarkMatch> match_predicted_landmarks(const StoredMap& map, const Keyframes& keyframes,
                                                     const PosedFrame& frame, double radius_px) {
  GuidedSearch search(frame, radius_px);
  std::vector<std::pair<const StoredKeyframe*, std::size_t>> shown;  // and the feature there
  for (const auto& keyframe : keyframes) {
    for (std::size_t i = 0; i < keyframe->landmarks.size(); ++i) {
      search.add(
          shown.size(), map.landmark(keyframe->landmarks[i]).point_in_world,
          {&keyframe->descriptors, i, keyframe->keypoints[i], keyframe->world_from_camera.translation});
      shown.emplace_back(keyframe.get(), i);
    }
  }
  std::vector<Candidate> candidates;
  for (const GuidedMatch& match : search.match()) {
    const auto& [keyframe, feature] = shown[match.point];
    candidates.push_back({match.distance, match.feature, keyframe->landmarks[feature], keyframe});
  }
  return with_points(map, frame.observed,
                     keep_nearest(std::move(candidates), frame.observed.features.keypoints.size()));
}

}  // namespace cairn
