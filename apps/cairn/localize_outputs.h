// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/localize/localize_sequence.h"
#include "cairn/sequence/sequence.h"

namespace cairn::app {

struct LocalizeSummary {
  std::string map, sequence, output;
  std::string stamps;  ///< what the stamps are, see describe_stamps
  std::string camera;  ///< see describe_camera
  std::vector<std::string> unreadable;
  std::size_t images = 0;  ///< of the sequence
  bool stopped = false;
  double open_seconds = 0, total_seconds = 0;
  int threads = 1;
};

/// "times", or what the stamps of images without times are.
[[nodiscard]] std::string describe_stamps(const Sequence& sequence);
/// The size of the images, and the size at which they are looked at, if it is another.
[[nodiscard]] std::string describe_camera(const Camera& camera, const QueryCamera& observed);

/// One row per image; the header has the units.
[[nodiscard]] std::string format_localization_csv(const std::vector<LocalizedImage>& images,
                                                  const LocalizeSummary& summary);
/// Of the images that got a pose, good or weak.
[[nodiscard]] std::string format_trajectory(const std::vector<LocalizedImage>& images,
                                            const LocalizeSummary& summary);
[[nodiscard]] std::string format_localize_json(const std::vector<LocalizedImage>& images,
                                               const LocalizeSummary& summary);
void print_localize_summary(const std::vector<LocalizedImage>& images, const LocalizeSummary& summary);

}  // namespace cairn::app
