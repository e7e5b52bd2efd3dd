// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cairn/geometry/camera.h"
#include "cairn/geometry/rig.h"
#include "cairn/localize/localize_sequence.h"
#include "cairn/report/landmark_picture.h"
#include "cairn/report/localization_picture.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds what is told of the images that were looked for in a map, beside what became of each.
struct LocalizationSummary {
  std::string map, sequence, output;  ///< folders, as the user named them
  std::string stamps;                 ///< what the stamps are, see describe_stamps
  std::string camera;                 ///< see describe_camera
  std::size_t unreadable = 0;         ///< images that were skipped
  std::size_t images = 0;             ///< of the sequence
  bool stopped = false;
  double open_seconds = 0, total_seconds = 0;
  double peak_memory_mb = 0;
  int threads = 1;
};

/// Returns "times", or what the stamps of images without times are.
[[nodiscard]] std::string describe_stamps(const Sequence& sequence);
/// Returns the size of the images, and the size at which they are looked at if it is another.
[[nodiscard]] std::string describe_camera(const Camera& camera, const QueryCamera& observed);

/// Returns localization.csv: a comment that says what the columns are, a line of names with units, and one
/// row for each image; images without a pose have empty columns.
[[nodiscard]] std::string format_localization_csv(const std::vector<LocalizedImage>& images,
                                                  const LocalizationSummary& summary);
/// Returns the trajectory of the images that got a pose, good or weak, as TUM has it.
[[nodiscard]] std::string format_found_trajectory(const std::vector<LocalizedImage>& images,
                                                  const LocalizationSummary& summary);
/// Returns run.json: counts, medians, times and one object for each image.
[[nodiscard]] std::string format_localization_json(const std::vector<LocalizedImage>& images,
                                                   const LocalizationSummary& summary);
/// Returns what the program prints in the end, for people.
[[nodiscard]] std::string format_localization_text(const std::vector<LocalizedImage>& images,
                                                   const LocalizationSummary& summary);

/// Returns the poses that were found, for draw_found_poses.
[[nodiscard]] std::vector<FoundPose> found_poses(const std::vector<LocalizedImage>& images);

/// Returns the matches of an image with the map, for draw_localization. `camera` is that of the image as it
/// is stored, `rig` that in which its features were observed. Without a pose a landmark lies on its feature;
/// what the image does not show lies far outside it.
[[nodiscard]] std::vector<DrawnMatch> drawn_matches(const Localization& found, const Camera& camera,
                                                    const Rig& rig);

}  // namespace cairn
