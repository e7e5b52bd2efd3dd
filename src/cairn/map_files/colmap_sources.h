// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/geometry/rig.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// A camera as it took the images on disk, with its distortion and before any rectification.
struct RecordedCamera {
  Camera camera;
  /// Turns the undistorted, rectified camera of the same centre, of which a map's observations are, into it.
  Eigen::Quaterniond recorded_from_map = Eigen::Quaterniond::Identity();

  /// Returns the pixel in the image on disk of what is seen in pixel (u, v) of the map's camera; nullopt if
  /// the distortion leaves none.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Rig& rig, double u, double v) const {
    return camera.project(recorded_from_map * rig.point_at(u, v, 1));
  }
};

/// The cameras of a sequence; RGB-D has no right one.
struct RecordedRig {
  RecordedCamera left;
  std::optional<RecordedCamera> right;
  double baseline = 0;  ///< metres; of the right camera
};
[[nodiscard]] RecordedRig recorded_rig(const Sequence& sequence);

/// Returns the folder that COLMAP is given as --image_path: the sequence's, or the innermost one above it
/// that has all of its images below it.
[[nodiscard]] std::filesystem::path colmap_image_root(const Sequence& sequence);

/// Returns the name of an image relative to that folder, as "image_0/000000.png". InputError for one with
/// blanks, which COLMAP cannot read from a text.
[[nodiscard]] std::string colmap_image_name(const std::filesystem::path& root,
                                            const std::filesystem::path& image);

/// InputError if a sequence's images cannot be named; to be asked before long work.
void check_colmap_names(const Sequence& sequence);

}  // namespace cairn
