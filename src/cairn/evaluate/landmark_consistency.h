// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/evaluate/consistency.h"
#include "cairn/evaluate/error_statistics.h"
#include "cairn/evaluate/evaluation.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// Sets how the landmarks of a map are compared with a simulated world.
struct LandmarkEvaluationOptions {
  /// How the map is moved onto the truth, by the centres of its keyframes.
  AlignmentMode alignment = AlignmentMode::none;
  double max_gap_s = 0.02;  ///< largest difference between the stamps of a keyframe and its frame

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Holds the landmarks of which a figure is within a range.
struct LandmarkClass {
  double from = 0, to = 0;  ///< the second not included; infinite of the last class
  ErrorConsistency consistency;
};

/// Holds the result of evaluate_landmarks. Lengths are metres.
struct LandmarkEvaluation {
  AlignmentStatus alignment_status =
      AlignmentStatus::ok;         ///< otherwise nothing below `keyframe_pairs` is set
  std::size_t keyframe_pairs = 0;  ///< keyframes of the main component that are frames of the sequence
  Similarity3 truth_from_map;      ///< the alignment
  double keyframe_error_m = 0, keyframe_error_deg = 0;  ///< medians, after the alignment

  std::size_t landmarks = 0;            ///< of the map: the sum of `judged` and the next four
  std::size_t in_other_components = 0;  ///< have no common world with the truth
  std::size_t without_covariance = 0;
  std::size_t undetermined = 0;   ///< their covariance is infinite
  std::size_t without_truth = 0;  ///< the truth shows nothing where they are
  std::size_t judged = 0;
  std::size_t at_edges = 0;  ///< judged ones near which several surfaces are seen: the nearest counts

  std::optional<ErrorConsistency> all;                  ///< of those judged
  std::optional<ErrorStatistics> distances_m;           ///< from the true surface, of those judged
  std::optional<ErrorConsistency> on_surface, at_edge;  ///< with one surface near them, with several
  /// Those that have a landmark, by the distance from the nearest camera that observed it, metres, and by the
  /// number of observations.
  std::vector<LandmarkClass> by_distance, by_observations;
};

/// Name of the folder in a simulated sequence that holds the true depth of the colour or left images.
inline constexpr const char* kDepthTruthFolder = "depth_truth";

/// Compares the landmarks of a map with the surfaces of the simulated world that it was made of: all of them,
/// whatever their error. The covariance of a landmark says where the place is of which its observations are
/// images. Of that place the truth knows only that it lies on a surface: a feature is no point with a mark,
/// its centre wanders on the surface with the view. So the error is the distance e from the true surface
/// along its normal n, and its variance n^T C n: e^2 / n^T C n is chi-square distributed with 1 degree of
/// freedom if C is honest, wherever on the plane the true place is. What C says of the directions along the
/// surface is not tested.
///
/// The surface is the one that the true depth shows where the landmark projects into the image of the nearest
/// camera that observed it, with the true pose; of several surfaces within 3 pixels the one that the landmark
/// is nearest to. Depths are those of `cairn simulate street|room --depth-truth`.
///
/// Throws InputError if the sequence has no true depth or poses, the map cannot be read, is not of the
/// sequence's camera, shares no time with it, holds more than one recording, or lies in another world; and if
/// a covariance is neither finite and positive definite along the normal, nor zero, nor infinite.
[[nodiscard]] LandmarkEvaluation evaluate_landmarks(const std::filesystem::path& map_folder,
                                                    const Sequence& sequence,
                                                    const LandmarkEvaluationOptions& options,
                                                    const Executor& executor);

}  // namespace cairn
