// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/matches.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "cairn/frontend/prediction.h"

namespace cairn {
namespace {

/// A match by descriptor.
struct Candidate {
  float distance;
  std::int32_t feature;
  LandmarkId landmark;
  const ViewedKeyframe* keyframe;
  bool operator<(const Candidate& other) const {
    return std::tie(distance, feature, landmark) < std::tie(other.distance, other.feature, other.landmark);
  }
};

/// The nearest first; each feature and each landmark once.
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

std::vector<LandmarkMatch> with_points(const MapView& map, const ObservedFrame& observed,
                                       const std::vector<Candidate>& candidates) {
  std::vector<LandmarkMatch> matches;
  for (const Candidate& candidate : candidates) {
    const StoredLandmark landmark = map.landmark(candidate.landmark);
    if (!landmark.covariance.allFinite()) continue;
    const Eigen::Vector3d ray = landmark.point_in_world - candidate.keyframe->world_from_camera.translation;
    const auto feature = static_cast<std::size_t>(candidate.feature);
    matches.push_back({candidate.feature, observed.observations[feature], candidate.landmark,
                       landmark.point_in_world, landmark.covariance, ray.norm()});
  }
  return matches;
}

/// The landmarks of keyframes that a view should show.
struct Targets {
  std::vector<PredictedPlace> places;
  std::vector<LandmarkId> landmarks;
  std::vector<const ViewedKeyframe*> keyframes;
  std::vector<const std::uint8_t*> descriptors;
};

void add_targets(const MapView& map, const ViewedKeyframe& keyframe, const FrameView& view, double radius_px,
                 Targets& targets) {
  Appearance appearance;
  appearance.centre_in_world = keyframe.world_from_camera.translation;
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    appearance.keypoint = keyframe.keypoints[i];
    const Eigen::Vector3d point = map.landmark(keyframe.landmarks[i]).point_in_world;
    const auto place = predict_place(view, point, appearance, radius_px);
    if (!place) continue;
    targets.places.push_back(*place);
    targets.landmarks.push_back(keyframe.landmarks[i]);
    targets.keyframes.push_back(&keyframe);
    targets.descriptors.push_back(keyframe.descriptors.row(i));
  }
}

Descriptors gather(const std::vector<const std::uint8_t*>& rows, const Descriptors& kind) {
  Descriptors gathered(kind.norm(), kind.bytes(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) std::memcpy(gathered.row(i), rows[i], gathered.stride());
  return gathered;
}

}  // namespace

std::vector<LandmarkMatch> match_keyframes(const MapView& map, const Keyframes& keyframes,
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

std::vector<LandmarkMatch> match_predicted_landmarks(const MapView& map, const Keyframes& keyframes,
                                                     const PosedQuery& query, double radius_px) {
  const Features& features = query.observed.features;
  const FrameView view{query.rig, query.observed, query.camera_from_world};
  Targets targets;
  for (const auto& keyframe : keyframes) add_targets(map, *keyframe, view, radius_px, targets);
  const MatchOptions options{descriptor_limit(features.descriptors), 0, true};
  std::vector<Candidate> candidates;
  for (const Match& match : match_predicted(targets.places, gather(targets.descriptors, features.descriptors),
                                            features, options)) {
    const auto target = static_cast<std::size_t>(match.query);
    candidates.push_back({match.distance, match.train, targets.landmarks[target], targets.keyframes[target]});
  }
  return with_points(map, query.observed, keep_nearest(std::move(candidates), features.keypoints.size()));
}

}  // namespace cairn
