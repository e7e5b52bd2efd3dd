// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "cairn/evaluate/pose_pairs.h"

namespace cairn {

/// Holds errors of translation and of rotation, one for each pose or for each pair of poses.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
};

/// Computes absolute errors: || t_est - t_ref || and the angle of R_est^-1 R_ref. The root mean square of the
/// translations after alignment is the ATE of the TUM benchmark (Sturm et al. 2012, sec. IV-B) and evo's APE.
[[nodiscard]] PoseErrors absolute_errors(std::span<const PosePair> pairs);

/// Sets the largest accepted error of a pose.
struct PoseTolerance {
  double translation_m = 0;
  double rotation_deg = 0;
};

/// Returns the number of poses whose errors of translation and of rotation are both within the tolerance.
[[nodiscard]] std::size_t count_within(const PoseErrors& errors, const PoseTolerance& tolerance);

/// Names the unit of the interval of a relative error.
enum class RpeUnit { frames, metres, seconds };

/// Sets the poses between which a relative error is measured.
struct RpeOptions {
  double delta = 1;  ///< in `unit`; frames: a whole number >= 1
  RpeUnit unit = RpeUnit::frames;
  /// Frames and metres: if true, each pose begins an interval (evo's --all_pairs), otherwise each interval
  /// begins at the end of the last one (evo's default). Seconds: each pose always begins an interval.
  bool all_pairs = false;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Returns the intervals (i, j), positions in `pairs`, i < j:
/// - frames: as evo's filter_pairs_by_index: (0, d), (d, 2d), ..; all_pairs: (i, i + d).
/// - metres: along the estimate's path, as evo's filter_pairs_by_path: between successive poses at which the
///   path since the last such pose reached delta (the first is the one that reached it first); all_pairs:
///   from each i to the j whose path from i is nearest to delta, if it is within 10 %.
/// - seconds: as the TUM tools' evaluate_rpe.py --fixed_delta --delta_unit s: to the pose nearest to the
///   stamp of i plus delta. An interval that ends at the last pose is left out, as it is there: it may be too
///   short.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> rpe_intervals(std::span<const PosePair> pairs,
                                                                             const RpeOptions& options);

/// Computes relative errors over `intervals`: with Q_i the reference and P_i the estimate,
///
///     E = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j)      (Sturm et al. 2012, eq. 2),
///
/// || trans(E) || and the angle of rot(E). A rigid alignment does not change them; a scale does.
[[nodiscard]] PoseErrors relative_errors(std::span<const PosePair> pairs,
                                         std::span<const std::pair<std::size_t, std::size_t>> intervals);

}  // namespace cairn
