// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cairn/calibrate/pose_fit.h"
#include "cairn/calibrate/quantity.h"
#include "cairn/sequence/pose_path.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Holds what given poses say of a recording's calibration.
struct PoseCalibration {
  PoseTerms value = PoseTerms::Zero();  ///< as found
  PoseTerms sigma = PoseTerms::Zero();
  std::array<Finding, 8> findings{};
  std::array<std::string, 8> why;       ///< why a term is undetermined
  int stretches = 0;                    ///< motions that were compared
  double stretch_s = 0;                 ///< their median duration
  double turn_deg = 0;                  ///< angle by which the camera turns over all of them
  double path_m = 0;                    ///< length that it moves
  Vector6d scatter = Vector6d::Zero();  ///< of the residuals, as PoseFit's

  [[nodiscard]] bool is_off(int term) const {
    return findings[static_cast<std::size_t>(term)] == Finding::off;
  }
  /// Returns the camera's pose on the subject with those terms that are off, the others as stated.
  [[nodiscard]] Rigid3 corrected(const Rigid3& subject_from_camera) const;
  /// Returns 1 plus the share by which true motions are longer than those seen: the factor of a stereo
  /// baseline, the divisor of a depth scale.
  [[nodiscard]] double scale_factor() const { return 1 + value[scale_term]; }
};

/// Sets what is known beforehand.
struct PoseCalibrationOptions {
  /// Standard deviation of the scale of the seen motions that is common to all of them, so that their scatter
  /// does not show it: that of the disparities' field.
  double scale_sigma = 0;
  bool has_times = true;  ///< whether the stamps of frames are times
};

/// Compares the motions that the images show, `visual` (world_from_camera in any world, of an odometry or
/// SLAM), with those of given poses (fit_poses), and judges each term. It is undetermined if its standard
/// deviation is above 0.05 deg, 5 cm, 0.3 % or 5 ms, and off if it is larger than three of them and than 0.01
/// deg, 1 cm, 0.1 % or 1 ms. Standard deviations are those of the fit, or half of what the fits of both
/// halves of the stretches differ by if that is more. All terms are undetermined with fewer than six
/// stretches, or if poses and images disagree whatever the terms are.
[[nodiscard]] PoseCalibration calibrate_poses(const Trajectory& visual, const GivenPath& given,
                                              const PoseCalibrationOptions& options);

/// Returns the eight terms as quantities of a recording: degrees, metres, a factor named `scale_name`, and
/// seconds.
[[nodiscard]] std::vector<Quantity> quantities_of(const PoseCalibration& found,
                                                  const std::string& scale_name);

}  // namespace cairn
