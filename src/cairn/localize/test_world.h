// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/localize/localizer.h"
#include "cairn/map/frame_file.h"
#include "cairn/map/map_writer.h"

namespace cairn::test {

/// A folder that is gone after the test, of which it has the name.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(testing::TempDir()) /
            (std::string(test->test_suite_name()) + test->name() + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

constexpr Rig kRig{500, 500, 319.5, 239.5, 0.4};
constexpr int kWidth = 640, kHeight = 480;

/// A street of points on both sides, seen by a camera that drives along it (x), looking ahead and aside, with
/// descriptors of bits that change a little from view to view.
class World {
 public:
  struct Options {
    int points = 3000;
    double length = 60;  ///< metres of street
    int keyframes = 40;
    double landmark_sigma = 0.02;  ///< metres across the line of sight; three times as much along it
    double sigma_px = 1;
    int flipped_bits = 20;  ///< of 256, from view to view
    std::uint64_t seed = 1;
  };

  explicit World(const Options& options) : options_(options) {
    Random random(options.seed);
    for (int i = 0; i < options.points; ++i) {
      const double side = random.uniform() < 0.5 ? -1 : 1;
      points_.emplace_back(random.uniform(0, options.length + 20), side * random.uniform(3, 9),
                           random.uniform(-2.5, 2.5));
      looks_.push_back(random_look(random));
    }
  }

  /// Looking along the street, a little to one side and the other.
  [[nodiscard]] WorldFromCamera pose_at(double x, double sideways = 0, double turn = 0) const {
    Eigen::Matrix3d ahead;  // camera x: right (-y in the world), y: down (-z), z: along x
    ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const Eigen::Quaterniond turned = rotation_exp({0, 0, turn});
    return WorldFromCamera({turned * Eigen::Quaterniond(ahead), {x, sideways, 0}});
  }

  /// What a camera sees: noisy observations of at most `most` points within 25 m, with or without disparity.
  struct View {
    ObservedFrame frame;
    std::vector<std::int32_t> points;  ///< of each feature
  };
  [[nodiscard]] View see(const WorldFromCamera& world_from_camera, std::uint64_t stream, bool stereo,
                         std::size_t most = 400) const {
    Random random(options_.seed + 1000, stream);
    View view;
    const CameraFromWorld camera_from_world = world_from_camera.inverse();
    std::vector<std::array<std::uint8_t, 32>> looks;
    for (std::size_t i = 0; i < points_.size() && view.points.size() < most; ++i) {
      const Eigen::Vector3d point = camera_from_world * points_[i];
      if (point.z() < 1 || point.z() > 25) continue;
      const Eigen::Vector3d pixel = kRig.project(point);
      if (pixel.x() < 0 || pixel.x() > kWidth - 1 || pixel.y() < 0 || pixel.y() > kHeight - 1) continue;
      Observation seen{pixel.x() + options_.sigma_px * random.normal(),
                       pixel.y() + options_.sigma_px * random.normal()};
      seen.sigma_px = options_.sigma_px;
      seen.sigma_d_px = 0.5;
      if (stereo) seen.d = std::max(0.5, pixel.z() + seen.sigma_d_px * random.normal());
      view.frame.observations.push_back(seen);
      view.frame.points_in_camera.push_back(point_in_camera(kRig, seen));
      view.frame.features.keypoints.push_back({static_cast<float>(seen.u), static_cast<float>(seen.v),
                                               static_cast<float>(300 / point.z()), 0, 0,
                                               static_cast<float>(options_.sigma_px)});
      view.points.push_back(static_cast<std::int32_t>(i));
      looks.push_back(changed(looks_[i], random));
    }
    view.frame.features.descriptors = Descriptors(Norm::hamming, 32, looks.size());
    for (std::size_t i = 0; i < looks.size(); ++i)
      std::memcpy(view.frame.features.descriptors.row(i), looks[i].data(), 32);
    view.frame.frame = {static_cast<std::int32_t>(stream)};
    view.frame.stamp_ns = static_cast<std::int64_t>(stream) * 100'000'000;
    return view;
  }

  /// Landmarks seen twice at least, each off by as much as its covariance says.
  void write_map(const std::filesystem::path& folder) const {
    MapHeader header;
    header.rig = kRig;
    header.width = kWidth;
    header.height = kHeight;
    header.descriptor = {"ORB", Norm::hamming, 32};
    std::filesystem::create_directories(folder);
    MapWriter writer(folder, header);
    std::vector<View> views;
    std::vector<WorldFromCamera> poses;
    std::vector<std::vector<Sighting>> sightings(points_.size());
    for (int k = 0; k < options_.keyframes; ++k) {
      poses.push_back(pose_at(options_.length * k / options_.keyframes, 0, k % 2 == 0 ? 0.15 : -0.15));
      views.push_back(see(poses.back(), static_cast<std::uint64_t>(k), true));
      for (std::size_t i = 0; i < views.back().points.size(); ++i)
        sightings[static_cast<std::size_t>(views.back().points[i])].push_back(
            {{k}, static_cast<std::int32_t>(i)});
    }
    std::vector<LandmarkId> ids(points_.size());
    std::int32_t next = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (sightings[i].size() >= 2) ids[i] = {next++};
    for (std::size_t k = 0; k < views.size(); ++k) {
      std::vector<LandmarkId> shown;
      for (const std::int32_t point : views[k].points) shown.push_back(ids[static_cast<std::size_t>(point)]);
      writer.add_frame(views[k].frame, shown, poses[k]);
    }
    Random random(options_.seed + 2000);
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (ids[i].valid()) writer.add_landmark(landmark(i, sightings[i], views, poses, random));
    writer.finish();
    MapWriter::discard_spools(folder);
  }

 private:
  using Look = std::array<std::uint8_t, 32>;

  static Look random_look(Random& random) {
    Look look{};
    for (std::uint8_t& byte : look) byte = static_cast<std::uint8_t>(random.index(256));
    return look;
  }
  [[nodiscard]] Look changed(Look look, Random& random) const {
    for (int i = 0; i < options_.flipped_bits; ++i) {
      const std::uint32_t bit = random.index(256);
      look[bit / 8] = static_cast<std::uint8_t>(look[bit / 8] ^ (1U << (bit % 8)));
    }
    return look;
  }

  [[nodiscard]] FinishedLandmark landmark(std::size_t point, const std::vector<Sighting>& sightings,
                                          const std::vector<View>& views,
                                          const std::vector<WorldFromCamera>& poses, Random& random) const {
    FinishedLandmark result;
    const WorldFromCamera& first = poses[static_cast<std::size_t>(sightings.front().keyframe.value)];
    const Eigen::Vector3d along = (points_[point] - first.translation).normalized();
    const double variance = options_.landmark_sigma * options_.landmark_sigma;
    result.covariance = variance * (Eigen::Matrix3d::Identity() + 8 * along * along.transpose());
    result.covariance = 0.5 * (result.covariance + result.covariance.transpose()).eval();
    const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
    result.point_in_world = points_[point];
    if (variance > 0) result.point_in_world += Eigen::Matrix3d(result.covariance.llt().matrixL()) * noise;
    result.sightings = sightings;
    result.descriptors = Descriptors(Norm::hamming, 32, sightings.size());
    std::vector<LandmarkView> seen;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const auto keyframe = static_cast<std::size_t>(sightings[i].keyframe.value);
      const auto feature = static_cast<std::size_t>(sightings[i].feature);
      const ObservedFrame& frame = views[keyframe].frame;
      result.keypoints.push_back(frame.features.keypoints[feature]);
      std::memcpy(result.descriptors.row(i), frame.features.descriptors.row(feature), 32);
      seen.push_back({poses[keyframe].inverse(), frame.observations[feature]});
    }
    result.indicators = indicators_of(kRig, result.point_in_world, seen);
    return result;
  }

  Options options_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Look> looks_;
};

inline QueryCamera query_camera() {
  return {kRig, kWidth, kHeight};
}

}  // namespace cairn::test
