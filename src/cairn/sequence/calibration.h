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

namespace cairn {

/// How depth is stored, and by which camera it was seen.
struct DepthCalibration {
  double scale = 0;  ///< units per metre
  std::vector<std::uint16_t> invalid{0};
  std::optional<Camera> camera;  ///< only where depth is not registered to colour
  Rigid3 camera_from_depth;
};

/// A stereo pair as it was recorded, and what FrameLoader makes of it.
struct RawStereo {
  StereoPair pair;
  StereoRectification rectification;  ///< of status ok
};

enum class PosesAre { camera, depth };

/// What camera.yaml says (docs: README, "Calibration").
struct Calibration {
  Camera camera;                          ///< colour or left camera, as FrameLoader's images are: rectified
  std::optional<double> baseline;         ///< stereo, after rectification, metres
  std::optional<RawStereo> raw_stereo;    ///< where the images on disk are not rectified
  std::optional<DepthCalibration> depth;  ///< RGB-D
  PosesAre poses_are = PosesAre::camera;  ///< which camera the given poses belong to
  /// Where the camera sits on the body whose poses are given (lever arm and boresight), in the body's axes;
  /// of a raw stereo pair the left camera as it was recorded.
  std::optional<Rigid3> body_from_camera;
  /// Frames a second of a sequence without time stamps; nothing if nobody states it.
  std::optional<double> rate_hz;

  /// Returns the stated rate, or else 30 Hz, which then only spaces the stamps.
  [[nodiscard]] double stamp_rate_hz() const {
    constexpr double kVideo = 30;
    return rate_hz.value_or(kVideo);
  }
};

/// Where something of a calibration stands, for messages; line 0 where it means nothing.
struct SourceLocation {
  std::string file;
  int line = 0;
};

/// Rectifies a pair: sets camera, baseline and raw_stereo. InputError that names `place` for cameras that
/// make no pair: in one place, right and left exchanged, without a view in common.
void set_raw_stereo(const StereoPair& pair, const SourceLocation& place, Calibration& calibration);

/// Where the camera whose images FrameLoader gives sits on a body that has the recorded one at
/// `body_from_camera`: rectification turns it.
[[nodiscard]] Rigid3 body_from_loaded_camera(const Calibration& calibration, const Rigid3& body_from_camera);

/// InputError with the line for an unknown key, a missing one, fx = 0, a scale of 0, a wrong type.
[[nodiscard]] Calibration read_calibration(const std::filesystem::path& path);
[[nodiscard]] std::string format_calibration(const Calibration& calibration);
/// tum-fr1, tum-fr2, tum-fr3: the cameras of the TUM RGB-D benchmark, depth 5000 units per metre.
[[nodiscard]] std::optional<Calibration> known_calibration(const std::string& name);

}  // namespace cairn
