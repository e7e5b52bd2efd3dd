// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/local_map.h"

#include <algorithm>

namespace cairn {

std::vector<CovisibleKeyframe> keyframes_showing(const Map& map, std::span<const LandmarkId> landmarks) {
  std::vector<int> counts(map.keyframes().size(), 0);
  for (const LandmarkId id : landmarks) {
    if (!id.valid()) continue;
    for (const ObservationRef& observation : map[id].observations)
      ++counts[static_cast<std::size_t>(observation.keyframe.value)];
  }
  std::vector<CovisibleKeyframe> views;
  for (std::size_t k = counts.size(); k-- > 0;)
    if (counts[k] > 0) views.push_back({{static_cast<std::int32_t>(k)}, counts[k]});
  std::stable_sort(views.begin(), views.end(), [](const CovisibleKeyframe& a, const CovisibleKeyframe& b) {
    return a.shared > b.shared;
  });
  return views;
}

std::vector<CovisibleKeyframe> covisible_keyframes(const Map& map, KeyframeId id, int min_shared) {
  std::vector<CovisibleKeyframe> views = keyframes_showing(map, map[id].landmarks);
  std::erase_if(views, [&](const CovisibleKeyframe& v) { return v.keyframe == id || v.shared < min_shared; });
  return views;
}

bool is_on_trial_or_confirmed(const Map& map, LandmarkId landmark, int trial_keyframes) {
  const std::vector<ObservationRef>& observations = map[landmark].observations;
  if (observations.size() != 1) return !observations.empty();
  const auto newest = static_cast<std::int32_t>(map.keyframes().size()) - 1;
  return newest - observations.front().keyframe.value <= trial_keyframes;
}

std::vector<LandmarkId> landmarks_of(const Map& map, std::span<const KeyframeId> keyframes,
                                     int trial_keyframes) {
  std::vector<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map[id].landmarks)
      if (landmark.valid() && is_on_trial_or_confirmed(map, landmark, trial_keyframes))
        landmarks.push_back(landmark);
  }
  std::sort(landmarks.begin(), landmarks.end());
  landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
  return landmarks;
}

std::vector<KeyframeId> neighbours_of(const Map& map, KeyframeId id, std::size_t count) {
  constexpr int kMinShared = 15;
  std::vector<KeyframeId> ids;
  for (const CovisibleKeyframe& view : covisible_keyframes(map, id, kMinShared)) {
    if (ids.size() == count) break;
    ids.push_back(view.keyframe);
  }
  return ids;
}

std::vector<KeyframeId> local_keyframes(const Map& map, std::span<const LandmarkId> landmarks,
                                        std::size_t count, std::size_t neighbours) {
  std::vector<KeyframeId> local;
  const std::vector<CovisibleKeyframe> views = keyframes_showing(map, landmarks);
  for (std::size_t i = 0; i < std::min(count, views.size()); ++i) {
    local.push_back(views[i].keyframe);
    const auto around = neighbours_of(map, views[i].keyframe, neighbours);
    local.insert(local.end(), around.begin(), around.end());
  }
  std::sort(local.begin(), local.end());
  local.erase(std::unique(local.begin(), local.end()), local.end());
  return local;
}

}  // namespace cairn
