// SPDX-License-Identifier: Apache-2.0
// Private to this room: poses as files state them, one reader per format, before they are those of frames.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/pose_table_header.h"
#include "cairn/sequence/trajectory_file.h"

namespace cairn {

/// Names the subject of poses: the camera whose images FrameLoader gives, or a body with these axes; or not
/// stated: the body if the calibration has a camera on one, else the camera.
enum class PoseSubject { camera, body_forward_left_up, body_forward_right_down, body_of_sensor, not_stated };

/// Holds one pose as a file states it.
struct RecordedPose {
  std::int64_t key = 0;  ///< nanoseconds, number of a frame, or position of a frame in the recording
  /// Position, metres in the world; of geodetic poses latitude and longitude (degrees), height above the
  /// ellipsoid (metres).
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// world_from_subject; of geodetic poses the world is east, north, up at the position itself.
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  /// Covariances of the position (square metres) and of a small rotation (square radians) about the same
  /// axes.
  Eigen::Matrix3d place_covariance = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d rotation_covariance = Eigen::Matrix3d::Zero();
};

/// Holds the poses of a file or a folder.
struct RecordedPoses {
  std::filesystem::path source;  ///< for messages
  std::string format;            ///< "TUM", "KITTI", "EuRoC", "OXTS", "NovAtel", "SBET", "table"
  PoseKey key = PoseKey::stamp;
  PoseSubject subject = PoseSubject::camera;
  bool geodetic = false;
  bool has_uncertainty = false;
  std::vector<RecordedPose> poses;  ///< keys increase strictly; at least one
  /// Key of the first row, even if it was left out because the receiver had no fix yet.
  std::optional<std::int64_t> first_key;
  std::vector<std::string> warnings;  ///< what a person should know, a sentence each
};

/// Reads the poses of a file or a folder, whose format it recognises by the content. A TUM file or a table
/// may have numbers of frames instead of stamps only if `may_have_numbers`. Throws InputError for any defect.
[[nodiscard]] RecordedPoses read_recorded_poses(const std::filesystem::path& path, bool may_have_numbers);

/// Converts a trajectory of the camera.
[[nodiscard]] RecordedPoses poses_of_trajectory(const Trajectory& trajectory);

/// Tells whether a folder holds OXTS packets: data/ and timestamps.txt.
[[nodiscard]] bool is_oxts(const std::filesystem::path& folder);
/// Reads the packets of an OXTS inertial navigation system as KITTI has them (Geiger et al. 2013, "Vision
/// meets robotics: the KITTI dataset"): data/NNNNNNNNNN.txt, each of 30 values, and timestamps.txt.
[[nodiscard]] RecordedPoses read_oxts(const std::filesystem::path& folder);

/// Tells whether a file holds logs INSPVAA, INSPVASA or INSPVAXA of a NovAtel receiver, perhaps among others.
[[nodiscard]] bool is_novatel(const std::filesystem::path& path);
/// Reads these logs; of several kinds the one with the most lines. Stamps become UTC since 1970, heights
/// those above the ellipsoid. Lines without a navigation solution are left out and counted.
[[nodiscard]] RecordedPoses read_novatel(const std::filesystem::path& path);

/// Tells whether a file is a binary SBET: records of 17 doubles, of which the first is plausible.
[[nodiscard]] bool is_sbet(const std::filesystem::path& path);
/// Reads an SBET. Stamps are seconds of the GPS week, as the file has them.
[[nodiscard]] RecordedPoses read_sbet(const std::filesystem::path& path);

/// Reads a table with angles whose columns are named. `header` is that of find_table_header.
[[nodiscard]] RecordedPoses read_pose_table(const std::filesystem::path& path, TableHeader header);
/// Reads a table with quaternions in named columns, in any order. Between blanks, whole numbers of an
/// unstated unit belong to frames if `may_have_numbers`.
[[nodiscard]] RecordedPoses read_quaternion_table(const std::filesystem::path& path, TableHeader header,
                                                  bool may_have_numbers);
/// Reads poses in EuRoC's order of columns, `stamp [ns], px, py, pz, qw, qx, qy, qz, ...`, which no line
/// names.
[[nodiscard]] RecordedPoses read_unnamed_asl_poses(const std::filesystem::path& path);

/// Reads poses that no line names: TUM's rows, perhaps with more columns behind, separated by blanks, commas
/// or semicolons; 3x4 or 4x4 matrices by rows, perhaps behind a number or a stamp (KITTI); EuRoC's rows; the
/// vertices of a g2o file by their ids. Lines before the first row of numbers are left out. Throws InputError
/// for any defect.
[[nodiscard]] RecordedPoses read_unnamed_poses(const std::filesystem::path& path, bool may_have_numbers);

/// Returns the pose with its key.
[[nodiscard]] RecordedPose recorded_pose(std::int64_t key, const Rigid3& world_from_subject);

/// Returns the covariance of independent errors: the squares on the diagonal.
[[nodiscard]] Eigen::Matrix3d covariance_of(const Eigen::Vector3d& standard_deviations);

}  // namespace cairn
