// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "cairn/evaluate/pose_pairs.h"

namespace cairn {

/// Errors of translation and of rotation, one for each pose or for each pair of poses.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
};

/// Absolute errors: || t_est - t_ref || and the angle of R_est^-1 R_ref. With the translations' root mean
/// square after alignment this is the ATE of the TUM benchmark (Sturm et al. 2012, sec. IV-B) and evo's APE.
[[nodiscard]] PoseErrors absolute_errors(std::span<const PosePair> pairs);

/// What the error of a pose may be at most.
struct PoseTolerance {
  double translation_m = 0;
  double rotation_deg = 0;
};

/// Returns the number of poses whose errors of translation and of rotation are both within the tolerance.
[[nodiscard]] std::size_t count_within(const PoseErrors& errors, const PoseTolerance& tolerance);

enum class RpeUnit { frames, metres, seconds };

/// Between which poses a relative error is taken.
struct RpeOptions {
  double delta = 1;  ///< in `unit`; frames: a whole number >= 1
  RpeUnit unit = RpeUnit::frames;
  /// frames, metres: each pose begins an interval (evo's --all_pairs) instead of one interval beginning where
  /// the last one ended (evo's default). seconds: always each pose.
  bool all_pairs = false;

  /// PreconditionError for a value out of range.
  void validate() const;
};

/// The intervals (i, j), positions in `pairs`, i < j:
/// - frames: as evo's filter_pairs_by_index: (0, d), (d, 2d), ..; all_pairs: (i, i + d).
/// - metres: along the estimate's path, as evo's filter_pairs_by_path: between successive poses at which the
///   path since the last such pose reached delta (the first one is where it did so first); all_pairs: from
///   each i to the j whose path from i is nearest to delta, if it is within 10 %.
/// - seconds: as the TUM tools' evaluate_rpe.py --fixed_delta --delta_unit s: to the pose nearest to stamp_i
/// +
///   delta. An interval that ends at the last pose is left out, there as here: it may be too short.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> rpe_intervals(std::span<const PosePair> pairs,
                                                                             const RpeOptions& options);

/// Relative errors over `intervals`: with Q_i the reference and P_i the estimate,
///
///     E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j)      (Sturm et al. 2012, eq. 2),
///
/// || trans(E) || and the angle of rot(E). A rigid alignment does not change them; a scale does.
[[nodiscard]] PoseErrors relative_errors(std::span<const PosePair> pairs,
                                         std::span<const std::pair<std::size_t, std::size_t>> intervals);

}  // namespace cairn
