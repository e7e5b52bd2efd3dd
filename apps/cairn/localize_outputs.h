// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/localize/localizer.h"
#include "cairn/sequence/trajectory.h"

namespace cairn::app {

/// What became of one image.
struct LocalizedImage {
  std::int64_t position = 0, stamp_ns = 0;  ///< in the sequence
  std::string file;                         ///< of the image
  Localization found;
  double feature_seconds = 0, localize_seconds = 0;
};

struct LocalizeSummary {
  std::string map, sequence, output;
  std::vector<std::string> unreadable;
  std::size_t images = 0;  ///< of the sequence
  bool stopped = false;
  double open_seconds = 0, total_seconds = 0;
  int threads = 1;
};

/// One row per image; the header has the units.
[[nodiscard]] std::string format_localization_csv(const std::vector<LocalizedImage>& images);
/// Of the images that got a pose, good or weak.
[[nodiscard]] Trajectory trajectory_of(const std::vector<LocalizedImage>& images);
[[nodiscard]] std::string format_localize_json(const std::vector<LocalizedImage>& images,
                                               const LocalizeSummary& summary);
void print_localize_summary(const std::vector<LocalizedImage>& images, const LocalizeSummary& summary);

}  // namespace cairn::app
