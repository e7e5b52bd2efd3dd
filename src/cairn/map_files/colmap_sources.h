// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/geometry/rig.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Describes a camera as it took the images on disk, with its distortion and before any rectification.
struct RecordedCamera {
  Camera camera;
  /// Rotation into this camera from the undistorted, rectified camera with the same centre, of which a map's
  /// observations are.
  Eigen::Quaterniond recorded_from_map = Eigen::Quaterniond::Identity();

  /// Returns the pixel in the image on disk of what is seen in pixel (u, v) of the map's camera; nullopt if
  /// the distortion leaves none.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Rig& rig, double u, double v) const {
    return camera.project(recorded_from_map * rig.point_at(u, v, 1));
  }
};

/// Holds the cameras of a sequence; RGB-D has no right one.
struct RecordedRig {
  RecordedCamera left;
  std::optional<RecordedCamera> right;
  double baseline = 0;  ///< distance between the cameras, metres; 0 if there is none
};
/// Returns the cameras that took the images of a sequence.
[[nodiscard]] RecordedRig recorded_rig(const Sequence& sequence);

/// Returns the folder to be given to COLMAP as --image_path: that of the sequence, or the innermost one above
/// it that contains all of its images.
[[nodiscard]] std::filesystem::path colmap_image_root(const Sequence& sequence);

/// Returns the name of an image relative to `root`, such as "image_0/000000.png". Throws InputError for a
/// name with blanks, which COLMAP cannot read from a text.
[[nodiscard]] std::string colmap_image_name(const std::filesystem::path& root,
                                            const std::filesystem::path& image);

/// Throws InputError if an image of the sequence has a name with blanks; to be called before long work.
void check_colmap_names(const Sequence& sequence);

}  // namespace cairn
