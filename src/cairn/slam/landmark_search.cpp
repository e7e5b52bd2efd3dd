// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/landmark_search.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cairn {
namespace {

constexpr double kMinViewCosine = 0.5;     // 60 degrees: descriptors rarely survive more
constexpr double kMaxDistanceRatio = 5.0;  // beyond, no pyramid level shows the same patch
constexpr double kMaxSizeRatio = 1.5;      // of found to expected: two levels of ORB's pyramid

Descriptors gather(const std::vector<Appearance>& appearances) {
  if (appearances.empty()) return {};
  const Descriptors& kind = *appearances.front().descriptors;
  Descriptors rows(kind.norm(), kind.bytes(), appearances.size());
  for (std::size_t i = 0; i < appearances.size(); ++i)
    std::memcpy(rows.row(i), appearances[i].descriptors->row(appearances[i].row), rows.stride());
  return rows;
}

}  // namespace

double descriptor_limit(const Descriptors& descriptors) {
  constexpr double kBitShare = 0.3;
  constexpr double kByteDistance = 300;  // of SIFT's vectors, which have the length 512
  return descriptors.norm() == Norm::hamming ? kBitShare * 8.0 * static_cast<double>(descriptors.bytes())
                                             : kByteDistance;
}

std::optional<PredictedPlace> predict_place(const FrameView& view, const Eigen::Vector3d& point_in_world,
                                            const Appearance& appearance, double radius_px) {
  constexpr double kMinDepth = 1e-3;  // metres
  const Eigen::Vector3d point = view.camera_from_world * point_in_world;
  if (!(point.z() > kMinDepth)) return std::nullopt;
  const Eigen::Vector3d ray_then = point_in_world - appearance.centre_in_world;
  const Eigen::Vector3d ray_now = view.camera_from_world.rotation.conjugate() * point;
  const double distance_then = ray_then.norm(), distance_now = ray_now.norm();
  if (!(ray_then.dot(ray_now) > kMinViewCosine * distance_then * distance_now)) return std::nullopt;
  const double ratio = distance_then / distance_now;
  if (!(ratio < kMaxDistanceRatio && ratio * kMaxDistanceRatio > 1)) return std::nullopt;
  const Eigen::Vector3d pixel = view.rig.project(point);
  const double size = ratio * static_cast<double>(appearance.keypoint.size);
  const double sigma = std::max(1.0, ratio * static_cast<double>(appearance.keypoint.sigma_px));
  return PredictedPlace{pixel.x(), pixel.y(), radius_px * sigma, size / kMaxSizeRatio, size * kMaxSizeRatio};
}

Appearance nearest_appearance(const Map& map, const Landmark& landmark,
                              const Eigen::Vector3d& centre_in_world) {
  const auto distance = [&](const Sighting& sighting) {
    return (map[sighting.keyframe].world_from_camera.translation - centre_in_world).squaredNorm();
  };
  const auto nearest =
      std::min_element(landmark.sightings.begin(), landmark.sightings.end(),
                       [&](const Sighting& a, const Sighting& b) { return distance(a) < distance(b); });
  const Keyframe& keyframe = map[nearest->keyframe];
  const auto row = static_cast<std::size_t>(nearest->feature);
  const Features& features = keyframe.observed.features;
  return {&features.descriptors, row, features.keypoints[row], keyframe.world_from_camera.translation};
}

SearchTargets landmark_targets(const Map& map, std::span<const LandmarkId> landmarks, const FrameView& view,
                               double radius_px) {
  SearchTargets targets;
  const Eigen::Vector3d centre = view.camera_from_world.inverse().translation;
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = map[id];
    const Appearance appearance = nearest_appearance(map, landmark, centre);
    const auto place = predict_place(view, landmark.point_in_world, appearance, radius_px);
    if (!place) continue;
    targets.points_in_world.push_back(landmark.point_in_world);
    targets.landmarks.push_back(id);
    targets.places.push_back(*place);
    targets.appearances.push_back(appearance);
  }
  return targets;
}

std::vector<FoundPoint> find_targets(const SearchTargets& targets, const FrameView& view,
                                     std::span<const LandmarkId> occupied, const MatchOptions& options) {
  std::vector<FoundPoint> found;
  if (targets.size() == 0) return found;
  const auto matches =
      match_predicted(targets.places, gather(targets.appearances), view.observed.features, options);
  for (const Match& match : matches) {
    const auto target = static_cast<std::size_t>(match.query),
               feature = static_cast<std::size_t>(match.train);
    if (!occupied.empty() && occupied[feature].valid()) continue;
    found.push_back({match.train, targets.landmarks[target], targets.points_in_world[target]});
  }
  return found;
}

}  // namespace cairn
