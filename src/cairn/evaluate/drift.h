// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cairn/evaluate/pose_pairs.h"

namespace cairn {

/// Sets the segments over which drift is measured. The defaults are those of the KITTI odometry benchmark;
/// with others the figures are not comparable with its table.
struct DriftOptions {
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};  ///< lengths of path, above 0
  std::size_t step = 10;  ///< number of frames between the beginnings of segments

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Holds the means over the segments of one length, or over all segments.
struct DriftFigures {
  double length_m = 0;  ///< length of the segments; 0 for all lengths
  std::size_t segments = 0;
  double translation_percent = 0;
  double rotation_deg_per_m = 0;
};

/// Holds the result of measure_drift.
struct Drift {
  DriftFigures all;
  std::vector<DriftFigures> by_length;  ///< for each length that has a segment
};

/// Measures drift as the KITTI odometry benchmark defines it (Geiger, Lenz and Urtasun 2012, "Are we ready
/// for autonomous driving?", and the benchmark's evaluate_odometry): from every `step`-th frame i and for
/// each length L to the first frame j with more than L of the reference's path behind i,
///
///     E = (P_i^-1 P_j)^-1 (Q_i^-1 Q_j),    || trans(E) || / L,    angle(rot(E)) / L,
///
/// P estimate, Q reference; all segments have the same weight in the means. Frames are the pairs; if poses
/// are missing, the path is the chord. Returns nullopt if the path is not longer than the shortest length.
[[nodiscard]] std::optional<Drift> measure_drift(std::span<const PosePair> pairs,
                                                 const DriftOptions& options = {});

}  // namespace cairn
