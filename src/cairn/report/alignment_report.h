// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/evaluate/pose_pairs.h"
#include "cairn/geometry/alignment.h"

namespace cairn {

/// Holds pairs of poses and the alignment that was found from them.
struct AlignmentReport {
  std::string estimate_path, reference_path;  ///< as given; no reference: the pairs came from one file
  std::optional<double> max_gap_s;            ///< between stamps of a pair; nothing: not paired by stamps
  bool with_scale = false;
  std::vector<PosePair> pairs;
  Alignment alignment;      ///< reference_from_estimate
  double rms_before_m = 0;  ///< distance of the camera centres, root mean square
};

/// Returns rotation, translation, scale and residuals. The alignment is one (AlignmentStatus::ok).
[[nodiscard]] std::string format_alignment_text(const AlignmentReport& report);
/// Returns a JSON object: its status and, if that is "ok", the alignment in full. Metres, degrees.
[[nodiscard]] std::string format_alignment_json(const AlignmentReport& report);
/// Draws both trajectories before and after, an SVG file. The alignment is one (AlignmentStatus::ok).
[[nodiscard]] std::string draw_alignment(const AlignmentReport& report);

}  // namespace cairn
