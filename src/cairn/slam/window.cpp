// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/window.h"

#include <algorithm>
#include <map>

#include "cairn/slam/local_map.h"

namespace cairn {
namespace {

constexpr std::int32_t kAbsent = -1;

/// Builds the problem of some landmarks and the keyframes that were added.
class WindowBuilder {
 public:
  explicit WindowBuilder(const Map& map) : map_(map), camera_of_(map.keyframes().size(), kAbsent) {
    window_.problem.rig = map.rig();
  }

  void add_camera(KeyframeId id, bool fixed) {
    camera_of_[static_cast<std::size_t>(id.value)] = static_cast<std::int32_t>(window_.cameras.size());
    window_.cameras.push_back(id);
    window_.problem.camera_from_world.push_back(map_[id].world_from_camera.inverse());
    window_.problem.camera_fixed.push_back(fixed ? 1 : 0);
  }

  void add_points(const std::vector<LandmarkId>& landmarks) {
    for (const LandmarkId id : landmarks) {
      const auto point = static_cast<std::int32_t>(window_.points.size());
      window_.points.push_back(id);
      window_.problem.points_in_world.push_back(map_[id].point_in_world);
      for (const ObservationRef& observation : map_[id].observations) {
        const std::int32_t camera = camera_of_[static_cast<std::size_t>(observation.keyframe.value)];
        if (camera == kAbsent) continue;
        const auto& seen = map_[observation.keyframe].observed.observations;
        window_.problem.observations.push_back(
            {camera, point, seen[static_cast<std::size_t>(observation.feature)]});
      }
    }
  }

  [[nodiscard]] Window build() { return std::move(window_); }

 private:
  const Map& map_;
  std::vector<std::int32_t> camera_of_;
  Window window_;
};

/// Moves a keyframe, and with it the landmarks that no other keyframe shows.
void move_with_its_own(KeyframeId id, const Rigid3& world_from_camera, Map& map) {
  const Rigid3 new_from_old = world_from_camera * map[id].world_from_camera.inverse();
  map.move(id, world_from_camera);
  for (const LandmarkId landmark : map[id].landmarks) {
    if (landmark.valid() && map[landmark].observations.size() == 1)
      map.move(landmark, new_from_old * map[landmark].point_in_world);
  }
}

/// Removes the observation of a landmark, or its disparity alone if the pixel agrees.
void remove_outlier(const Window& window, const BundleObservation& outlier, Map& map) {
  const LandmarkId landmark = window.points[static_cast<std::size_t>(outlier.point)];
  const KeyframeId keyframe = window.cameras[static_cast<std::size_t>(outlier.camera)];
  const Eigen::Vector3d point = window.problem.camera_from_world[static_cast<std::size_t>(outlier.camera)] *
                                window.problem.points_in_world[static_cast<std::size_t>(outlier.point)];
  if (agreement(window.problem.rig, point, outlier.seen) == Agreement::pixel)
    map.remove_disparity(landmark, keyframe);
  else
    map.remove_observation(landmark, keyframe);
}

}  // namespace

Window window_around(const Map& map, KeyframeId keyframe, const MappingOptions& options) {
  auto free = neighbours_of(map, keyframe, static_cast<std::size_t>(options.window_keyframes) - 1);
  free.push_back(keyframe);
  std::sort(free.begin(), free.end());
  const auto landmarks = landmarks_of(map, free, options.trial_keyframes);
  std::vector<CovisibleKeyframe> around = keyframes_showing(map, landmarks);
  std::erase_if(around, [&](const CovisibleKeyframe& v) {
    return std::binary_search(free.begin(), free.end(), v.keyframe);
  });
  around.resize(std::min(around.size(), static_cast<std::size_t>(options.window_fixed)));
  WindowBuilder builder(map);
  for (const KeyframeId id : free) builder.add_camera(id, around.empty() && id == free.front());
  for (const CovisibleKeyframe& view : around) builder.add_camera(view.keyframe, true);
  builder.add_points(landmarks);
  return builder.build();
}

Window whole_component(const Map& map, std::int32_t component) {
  WindowBuilder builder(map);
  bool first = true;
  for (const KeyframeId id : map.keyframe_ids()) {
    if (map[id].component != component) continue;
    builder.add_camera(id, first);
    first = false;
  }
  std::vector<LandmarkId> landmarks;
  for (const LandmarkId id : map.landmark_ids()) {
    const auto& observations = map[id].observations;
    if (observations.size() > 1 && map[observations.front().keyframe].component == component)
      landmarks.push_back(id);
  }
  builder.add_points(landmarks);
  return builder.build();
}

std::int32_t largest_component(const Map& map) {
  std::map<std::int32_t, int> counts;
  for (const KeyframeId id : map.keyframe_ids()) ++counts[map[id].component];
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? 0 : most->first;
}

void apply_adjustment(const Window& window, const BundleReport& report, Map& map) {
  for (std::size_t c = 0; c < window.cameras.size(); ++c) {
    if (window.problem.camera_fixed[c] == 0)
      move_with_its_own(window.cameras[c], window.problem.camera_from_world[c].inverse(), map);
  }
  for (std::size_t p = 0; p < window.points.size(); ++p)
    if (!map[window.points[p]].erased()) map.move(window.points[p], window.problem.points_in_world[p]);
  for (std::size_t i = 0; i < report.inlier.size(); ++i) {
    if (report.inlier[i] != 0) continue;
    remove_outlier(window, window.problem.observations[i], map);
  }
}

}  // namespace cairn
