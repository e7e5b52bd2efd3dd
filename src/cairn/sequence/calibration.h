// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rectification.h"
#include "cairn/geometry/rigid3.h"
#include "cairn/geometry/stereo_correction.h"

namespace cairn {

/// Describes how depth is stored and which camera measures it.
struct DepthCalibration {
  double scale = 0;  ///< units per metre
  std::vector<std::uint16_t> invalid{0};
  std::optional<Camera> camera;  ///< nullopt if depth is registered to colour
  Rigid3 camera_from_depth;
};

/// Describes a stereo pair as it was recorded, and its rectification by FrameLoader.
struct RawStereo {
  StereoPair pair;
  StereoRectification rectification;  ///< its status is ok
};

/// Names the camera that the given poses belong to.
enum class PosesAre { camera, depth };

/// Holds the contents of camera.yaml (docs: README, "Calibration").
struct Calibration {
  Camera camera;                   ///< of FrameLoader's images: the colour camera, or the rectified left one
  std::optional<double> baseline;  ///< stereo, after rectification, metres
  std::optional<RawStereo> raw_stereo;    ///< set if the images on disk are not rectified
  std::optional<DepthCalibration> depth;  ///< RGB-D
  /// What FrameLoader takes off the rows of right images, and Observer off disparities; nullopt for nothing.
  std::optional<StereoCorrection> right_correction;
  PosesAre poses_are = PosesAre::camera;  ///< the camera that the given poses belong to
  /// Pose of the camera on the body whose poses are given (lever arm and boresight), in the body's axes; of a
  /// raw stereo pair, that of the left camera as it was recorded.
  std::optional<Rigid3> body_from_camera;
  /// Frames per second of a sequence without time stamps; nullopt if it is not stated.
  std::optional<double> rate_hz;

  /// Returns the stated rate, or else 30 Hz, which then only spaces the stamps.
  [[nodiscard]] double stamp_rate_hz() const {
    constexpr double kVideo = 30;
    return rate_hz.value_or(kVideo);
  }
};

/// Names the location of an entry of a calibration, for messages; line 0 if it has none.
struct SourceLocation {
  std::string file;
  int line = 0;
};

/// Rectifies a pair: sets camera, baseline and raw_stereo. Throws InputError that names `place` if the
/// cameras make no pair: they coincide, right and left are exchanged, or they share no view.
void set_raw_stereo(const StereoPair& pair, const SourceLocation& place, Calibration& calibration);

/// Returns the pose, on a body, of the camera whose images FrameLoader gives, if the recorded camera has the
/// pose `body_from_camera`: rectification rotates it.
[[nodiscard]] Rigid3 body_from_loaded_camera(const Calibration& calibration, const Rigid3& body_from_camera);

/// Reads a camera.yaml or a calibration of another program, recognised by its content: OpenCV, ROS, Kalibr,
/// COLMAP, RealSense, Open3D (docs/inputs.md); or the one that find_calibration finds in a folder. Throws
/// InputError with the line for an unknown or missing key, fx = 0, a scale of 0, a wrong type, or a
/// distortion that Camera lacks.
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& path);
/// Finds the calibration in a folder: camera.yaml, else one of another program under its usual name. Returns
/// nullopt if there is none, or only a camera.yaml without camera.
[[nodiscard]] std::optional<std::filesystem::path> find_calibration(const std::filesystem::path& folder);
/// Reads a camera.yaml that has no camera: depth, body, poses_are and rate_hz, which complete a calibration
/// from elsewhere. Returns nullopt for any other calibration. Throws InputError as read_calibration does.
[[nodiscard]] std::optional<Calibration> read_calibration_addition(const std::filesystem::path& path);
/// Puts what an addition states in the place of what the calibration has.
void complete_calibration(const Calibration& addition, Calibration& calibration);
/// Formats a calibration as a camera.yaml.
[[nodiscard]] std::string format_calibration(const Calibration& calibration);
/// Returns the calibration of a camera of the TUM RGB-D benchmark (tum-fr1, tum-fr2 or tum-fr3; depth 5000
/// units per metre), or nullopt for another name.
[[nodiscard]] std::optional<Calibration> known_calibration(const std::string& name);

}  // namespace cairn
