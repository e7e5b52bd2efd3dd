// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/geometry/framed.h"
#include "cairn/geometry/geodetic.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds the covariances of the error of a given pose in the world's axes. With the error (c, w) the true
/// centre of the camera is the given one plus c (metres), and its true rotation exp(w) times the given one
/// (radians). What the poses do not state adds nothing.
struct PoseUncertainty {
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();  ///< E[c c^T]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();  ///< E[w w^T]
  /// E[c w^T]: on a lever arm the centre moves with the body's rotation.
  Eigen::Matrix3d position_rotation = Eigen::Matrix3d::Zero();
};

/// Holds the given pose of a frame.
struct GivenPose {
  WorldFromCamera world_from_camera;  ///< of the camera whose images FrameLoader gives
  std::optional<PoseUncertainty> uncertainty;
};

/// Sets where given poses come from and how they are assigned to frames.
struct GivenPosesOptions {
  std::filesystem::path path;  ///< a file or a folder (docs/poses.md); empty: the sequence's own
  double time_offset_s = 0;    ///< added to the poses' stamps
  /// If true, instead of time_offset_s, the first pose's stamp becomes that of the recording's first frame.
  bool align_first_stamps = false;
  /// Largest gap between two poses that a frame is interpolated between. GNSS/INS gives 10 to 200 poses a
  /// second: at 10 a second jitter passes, a lost pose does not. Between two poses a vehicle that accelerates
  /// by 3 m/s^2 leaves the line by at most 3/8 gap^2, 8 mm at this gap.
  double max_gap_s = 0.15;
  std::optional<GeodeticOrigin> origin = std::nullopt;  ///< of geodetic poses; nullopt: the first pose used
};

/// Holds the result of read_given_poses.
struct GivenPoses {
  std::vector<std::optional<GivenPose>> frames;  ///< one for each of Sequence::frames
  std::size_t without_pose = 0;                  ///< frames that got none
  std::optional<GeodeticOrigin> origin;          ///< of geodetic poses
  Rigid3 subject_from_camera;                    ///< pose of the camera on the subject of the stated poses
  std::filesystem::path source;                  ///< the file or folder of the poses
  std::string format;                            ///< "TUM", "KITTI", "EuRoC", "OXTS", "table", "truth"
  double time_offset_s = 0;                      ///< was added to the poses' stamps
  std::vector<std::string> warnings;             ///< what a person should know, a sentence each
};

/// Reads the poses that a user names, or the sequence's own: its truth, else its OXTS packets. A frame gets
/// the pose of its stamp; else one between those before and after it, unless these are too far apart
/// (position linear, rotation SLERP; covariances linear, which bounds the truth whatever the correlation of
/// the two errors, since squares are convex); else, as stamps are often rounded, a pose within a millisecond.
/// Files whose first column holds whole numbers belong to the frames of these numbers, except in sequences
/// that have a clock (TUM, EuRoC), and KITTI's to the frames in their order. If poses are of a body,
/// Calibration gives the camera's pose on it; a table that does not say what its quaternions are of is taken
/// as the body's if Calibration does, else as the camera's. Throws InputError for any defect, and if no frame
/// gets a pose.
[[nodiscard]] GivenPoses read_given_poses(const Sequence& sequence, const GivenPosesOptions& options = {});

/// Returns the poses alone, without their uncertainty.
[[nodiscard]] std::vector<std::optional<WorldFromCamera>> camera_poses(const GivenPoses& given);

/// Returns camera_poses of read_given_poses.
[[nodiscard]] std::vector<std::optional<WorldFromCamera>> poses_of_frames(
    const Sequence& sequence, const GivenPosesOptions& options = {});

/// Returns the folder of OXTS packets in a sequence's folder, or nullopt if there is none.
[[nodiscard]] std::optional<std::filesystem::path> oxts_in(const std::filesystem::path& sequence_folder);

}  // namespace cairn
