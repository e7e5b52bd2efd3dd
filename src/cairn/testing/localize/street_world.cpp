// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/localize/street_world.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>

namespace cairn::testkit {

namespace {

constexpr std::size_t kBytes = 128;

std::vector<std::size_t> evenly_spaced(const std::vector<std::size_t>& found, std::size_t most) {
  if (found.size() <= most) return found;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(found[i * found.size() / most]);
  return some;
}

MapHeader street_header() {
  MapHeader header;
  header.rig = kStreetCamera.rig;
  header.width = kStreetCamera.width;
  header.height = kStreetCamera.height;
  header.descriptor = {"SIFT", Norm::l2, kBytes};
  return header;
}

}  // namespace

StreetWorld::StreetWorld(const Options& options) : options_(options) {
  Random random(options.seed);
  for (std::size_t i = 0; i < options.points; ++i) {
    const double side = random.uniform() < 0.5 ? -1 : 1;
    const Eigen::Vector3d point = point_in_box(random, {0, 3, -2.5}, {options.length + 20, 9, 2.5});
    points_.emplace_back(point.x(), side * point.y(), point.z());
  }
  std::sort(points_.begin(), points_.end(),
            [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); });
}

WorldFromCamera StreetWorld::pose_at(double x, double sideways, double turn) {
  Eigen::Matrix3d ahead;  // camera x: right (-y in the world), y: down (-z), z: along x
  ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return WorldFromCamera({rotation_exp({0, 0, turn}) * Eigen::Quaterniond(ahead), {x, sideways, 0}});
}

StreetWorld::View StreetWorld::see(const WorldFromCamera& world_from_camera, std::uint64_t stream,
                                   bool stereo, std::size_t most) const {
  Random random(options_.seed + 1000, stream);
  View view;
  view.points = visible(world_from_camera, most);
  view.frame.frame = {static_cast<std::int32_t>(stream)};
  view.frame.stamp_ns = static_cast<std::int64_t>(stream) * 100'000'000;
  view.frame.features.descriptors = Descriptors(Norm::l2, kBytes, view.points.size());
  const CameraFromWorld camera_from_world = world_from_camera.inverse();
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    add_feature(camera_from_world * points_[view.points[i]], stereo, random, view.frame);
    put_look(view.points[i], random, view.frame.features.descriptors.row(i));
  }
  return view;
}

void StreetWorld::write_map(const std::filesystem::path& folder) const {
  std::filesystem::create_directories(folder);
  MapWriter writer(folder, street_header());
  const std::vector<LandmarkId> ids = number_landmarks();
  Random random(options_.seed + 2000);
  std::deque<KeyframeView> window;  // those that may show what is not finished yet
  std::size_t finished = 0;
  for (int k = 0; k < options_.keyframes; ++k) {
    window.push_back({{k}, keyframe_pose(k), see(keyframe_pose(k), static_cast<std::uint64_t>(k), true)});
    const KeyframeView& now = window.back();
    std::vector<LandmarkId> shown;
    for (const std::size_t point : now.view.points) shown.push_back(ids[point]);
    writer.add_frame(now.view.frame, shown, now.world_from_camera);
    const double passed = now.world_from_camera.translation.x() - 10;
    for (; finished < points_.size() && points_[finished].x() < passed; ++finished)
      if (ids[finished].valid()) writer.add_landmark(landmark(finished, window, random));
    while (window.front().world_from_camera.translation.x() < passed - 40) window.pop_front();
  }
  for (; finished < points_.size(); ++finished)
    if (ids[finished].valid()) writer.add_landmark(landmark(finished, window, random));
  writer.finish();
  MapWriter::discard_append_files(folder);
}

WorldFromCamera StreetWorld::keyframe_pose(int k) const {
  return pose_at(options_.length * k / options_.keyframes, 0, k % 2 == 0 ? 0.15 : -0.15);
}

std::vector<std::size_t> StreetWorld::visible(const WorldFromCamera& world_from_camera,
                                              std::size_t most) const {
  constexpr double kFarthest = 25;  // metres
  const double x = world_from_camera.translation.x();
  const auto begin = std::lower_bound(points_.begin(), points_.end(), x - kFarthest,
                                      [](const Eigen::Vector3d& point, double at) { return point.x() < at; });
  std::vector<std::size_t> found;
  const CameraFromWorld camera_from_world = world_from_camera.inverse();
  for (auto point = begin; point != points_.end() && point->x() < x + kFarthest; ++point) {
    const Eigen::Vector3d in_camera = camera_from_world * *point;
    if (in_camera.z() < 1 || in_camera.z() > kFarthest) continue;
    if (kStreetCamera.shows(kStreetCamera.rig.project(in_camera)))
      found.push_back(static_cast<std::size_t>(point - points_.begin()));
  }
  return evenly_spaced(found, most);
}

void StreetWorld::add_feature(const Eigen::Vector3d& point_in_camera, bool stereo, Random& random,
                              ObservedFrame& frame) const {
  constexpr double kSigmaDisparity = 0.5, kSmallest = 0.5;
  Observation seen = observe(random, kStreetCamera.rig.project(point_in_camera),
                             {options_.sigma_px, kSigmaDisparity}, stereo);
  if (stereo) seen.d = std::max(kSmallest, seen.d);
  frame.observations.push_back(seen);
  frame.points_in_camera.push_back(point_in_camera);
  frame.features.keypoints.push_back({static_cast<float>(seen.u), static_cast<float>(seen.v),
                                      static_cast<float>(300 / point_in_camera.z()), 0, 0,
                                      static_cast<float>(options_.sigma_px)});
}

/// Writes the point's own look with the view's noise.
void StreetWorld::put_look(std::size_t point, Random& of_view, std::uint8_t* row) const {
  Random of_point(options_.seed + 3000, point);
  for (std::size_t b = 0; b < kBytes; b += 8) {
    const std::uint64_t look = of_point.next(), noise = of_view.next();
    for (std::size_t k = 0; k < 8; ++k)
      row[b + k] = static_cast<std::uint8_t>(((look >> (8 * k)) & 63U) + ((noise >> (8 * k)) & 15U));
  }
}

/// Returns ids, in their order, for points that are seen twice.
std::vector<LandmarkId> StreetWorld::number_landmarks() const {
  std::vector<int> observations(points_.size(), 0);
  for (int k = 0; k < options_.keyframes; ++k)
    for (const std::size_t point : visible(keyframe_pose(k), options_.features)) ++observations[point];
  std::vector<LandmarkId> ids(points_.size());
  std::int32_t next = 0;
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (observations[i] >= 2) ids[i] = {next++};
  return ids;
}

FinishedLandmark StreetWorld::landmark(std::size_t point, const std::deque<KeyframeView>& window,
                                       Random& random) const {
  FinishedLandmark result;
  std::vector<PosedObservation> seen;
  std::vector<const std::uint8_t*> rows;
  for (const KeyframeView& keyframe : window) {
    const auto& points = keyframe.view.points;
    const auto place = std::lower_bound(points.begin(), points.end(), point);
    if (place == points.end() || *place != point) continue;
    const auto feature = static_cast<std::size_t>(place - points.begin());
    const ObservedFrame& frame = keyframe.view.frame;
    result.observations.push_back({keyframe.id, static_cast<std::int32_t>(feature)});
    result.keypoints.push_back(frame.features.keypoints[feature]);
    rows.push_back(frame.features.descriptors.row(feature));
    seen.push_back({keyframe.world_from_camera.inverse(), frame.observations[feature]});
  }
  result.descriptors = Descriptors(Norm::l2, kBytes, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) std::memcpy(result.descriptors.row(i), rows[i], kBytes);
  displace(point, seen.front().camera_from_world, random, result);
  result.indicators = indicators_of(kStreetCamera.rig, result.point_in_world, seen);
  return result;
}

/// Puts the landmark beside its point, as its covariance says.
void StreetWorld::displace(std::size_t point, const CameraFromWorld& camera_from_world, Random& random,
                           FinishedLandmark& landmark) const {
  const Eigen::Vector3d along = (points_[point] - camera_from_world.inverse().translation).normalized();
  const double variance = options_.landmark_sigma * options_.landmark_sigma;
  const Eigen::Matrix3d covariance = variance * (Eigen::Matrix3d::Identity() + 8 * along * along.transpose());
  landmark.covariance = 0.5 * (covariance + covariance.transpose());
  landmark.point_in_world = points_[point];
  if (variance == 0) return;
  const Eigen::Vector3d noise = normal_vector(random);
  landmark.point_in_world += Eigen::Matrix3d(landmark.covariance.llt().matrixL()) * noise;
}

QueryCamera street_query_camera() {
  return {kStreetCamera.rig, kStreetCamera.width, kStreetCamera.height};
}

}  // namespace cairn::testkit
