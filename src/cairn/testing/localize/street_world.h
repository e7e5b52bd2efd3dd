// SPDX-License-Identifier: Apache-2.0
// A simulated street and maps of it, for tests and benchmarks.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/localize/localizer.h"
#include "cairn/map_files/map_writer.h"
#include "cairn/testing/geometry/random_points.h"

namespace cairn::testkit {

inline constexpr SimulatedCamera kStreetCamera{{500, 500, 319.5, 239.5, 0.4}, 640, 480};

/// Simulates a street of points on both sides, seen by a camera that drives along it (x), looking ahead and
/// aside, with descriptors like SIFT's that change a little from view to view.
class StreetWorld {
 public:
  struct Options {
    std::size_t points = 3000;
    double length = 60;  ///< metres of street
    int keyframes = 40;
    double landmark_sigma = 0.02;  ///< metres across the line of sight; three times as much along it
    double sigma_px = 1;
    std::size_t features = 400;  ///< of a keyframe, at most
    std::uint64_t seed = 1;
  };

  explicit StreetWorld(const Options& options);

  /// Returns the pose of a camera that looks along the street, turned to the left by `turn` radians.
  [[nodiscard]] static WorldFromCamera pose_at(double x, double sideways = 0, double turn = 0);

  /// Holds what a camera sees.
  struct View {
    ObservedFrame frame;
    std::vector<std::size_t> points;  ///< of each feature
  };
  /// Returns at most `most` points up to 25 m away, with noise, with or without disparities.
  [[nodiscard]] View see(const WorldFromCamera& world_from_camera, std::uint64_t stream, bool stereo,
                         std::size_t most) const;
  /// Returns as many points as a keyframe has.
  [[nodiscard]] View see(const WorldFromCamera& pose, std::uint64_t stream, bool stereo) const {
    return see(pose, stream, stereo, options_.features);
  }

  /// Writes landmarks that are seen twice at least, each off by as much as its covariance says.
  void write_map(const std::filesystem::path& folder) const;

 private:
  struct KeyframeView {
    KeyframeId id;
    WorldFromCamera world_from_camera;
    View view;
  };

  [[nodiscard]] WorldFromCamera keyframe_pose(int k) const;
  [[nodiscard]] std::vector<std::size_t> visible(const WorldFromCamera& world_from_camera,
                                                 std::size_t most) const;
  void add_feature(const Eigen::Vector3d& point_in_camera, bool stereo, Random& random,
                   ObservedFrame& frame) const;
  void put_look(std::size_t point, Random& of_view, std::uint8_t* row) const;
  [[nodiscard]] std::vector<LandmarkId> number_landmarks() const;
  [[nodiscard]] FinishedLandmark landmark(std::size_t point, const std::deque<KeyframeView>& window,
                                          Random& random) const;
  void displace(std::size_t point, const CameraFromWorld& camera_from_world, Random& random,
                FinishedLandmark& landmark) const;

  Options options_;
  std::vector<Eigen::Vector3d> points_;  // by x
};

/// Returns kStreetCamera as localisation takes it.
[[nodiscard]] QueryCamera street_query_camera();

}  // namespace cairn::testkit
