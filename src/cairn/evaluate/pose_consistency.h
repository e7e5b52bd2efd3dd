// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cairn/evaluate/consistency.h"
#include "cairn/evaluate/covariance_table.h"
#include "cairn/evaluate/pose_pairs.h"

namespace cairn {

/// Holds the consistency of poses: of all six numbers, and apart for position and rotation.
struct PoseConsistency {
  ErrorConsistency pose;                ///< without a meaning of median_std and median_error, which mix units
  ErrorConsistency position, rotation;  ///< metres, radians
};

/// Names what a covariance is relative to.
enum class CovarianceScope {
  absolute,      ///< the world, with what the map itself is uncertain by
  in_map,        ///< the map, taken as exact on the whole
  from_first,    ///< the first keyframe of the component
  from_previous  ///< the keyframe before
};

/// Holds what was found of one set of covariances.
struct StatedPoses {
  CovarianceScope scope = CovarianceScope::in_map;
  bool is_weak = false;                        ///< of the poses that the estimate itself calls weak
  std::size_t without_truth = 0;               ///< poses that pair with none of the reference
  std::size_t without_covariance = 0;          ///< paired poses for which none is stated
  std::optional<PoseConsistency> consistency;  ///< nullopt if no pose with a covariance pairs
};

/// Assesses the covariances of localised poses (kLocalizationPrefixes), those of good poses first, then those
/// of weak ones if there are any, each set apart. The error is left_perturbation of camera_from_world, so a
/// turned or moved world does not change it; with `scale`, by which an alignment scaled the estimate (`pairs`
/// are aligned), the position's part of the covariance is scaled. Stamps of the table are those of the pairs.
[[nodiscard]] std::vector<StatedPoses> assess_localizations(const CovarianceTable& table,
                                                            std::span<const PosePair> pairs, double scale);

/// Assesses the covariances of keyframes (kKeyframePrefixes). The error is left_perturbation of
/// camera_from_keyframe, estimate to truth, with the first keyframe of the component or the one of the row
/// before; a component begins where a row states nothing of the row before. `pairs` and `scale` are as in
/// assess_localizations. A file without the columns of the row before is one component.
[[nodiscard]] std::vector<StatedPoses> assess_keyframes(const CovarianceTable& table,
                                                        std::span<const PosePair> pairs, double scale);

}  // namespace cairn
