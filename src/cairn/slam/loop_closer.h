// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/map/pose_graph.h"
#include "cairn/slam/indexed_map.h"
#include "cairn/slam/loop_judge.h"
#include "cairn/slam/options.h"

namespace cairn {

/// Counts the candidates for loops, and what became of the loops found.
struct LoopReport {
  int tried = 0;     ///< candidates that were matched with a keyframe
  int verified = 0;  ///< candidates that passed the geometric verification
  int rejected = 0;  ///< loops refused: larger than the drift of odometry, or in conflict with the pose graph
  int unconfirmed = 0;        ///< loops that no second keyframe confirmed
  int joined = 0;             ///< loops that the poses fitted already: only landmarks were fused
  int closed = 0;             ///< loops closed by optimising the pose graph of a component
  int components_joined = 0;  ///< loops by which two components were joined
};

/// Recognises places that the camera has come back to, and closes the loops. Deterministic at any number of
/// threads.
class LoopCloser {
 public:
  LoopCloser(const SlamOptions& options, const Executor& executor, IndexedMap& indexed);

  /// Searches for a loop from `keyframe`, the newest, to keyframes that look like it and are not its
  /// neighbours, and closes the one with the most inliers if it is believed (LoopJudge). Returns whether
  /// keyframes moved.
  bool close(KeyframeId keyframe);
  [[nodiscard]] const LoopReport& report() const { return report_; }
  /// Returns the closed loops as edges of a pose graph, with the motions as measured.
  [[nodiscard]] const std::vector<PoseGraph::Edge>& edges() const { return edges_; }

 private:
  [[nodiscard]] std::vector<KeyframeId> candidates(KeyframeId keyframe) const;
  [[nodiscard]] std::optional<LoopHypothesis> verify(KeyframeId keyframe);
  bool bend(const LoopHypothesis& loop);
  [[nodiscard]] bool join_components(const LoopHypothesis& loop);
  void fuse_landmarks(const LoopHypothesis& loop);

  const SlamOptions& options_;
  const Executor& executor_;
  const PlaceIndex& places_;
  Map& map_;
  LoopJudge judge_;
  LoopReport report_;
  std::vector<PoseGraph::Edge> edges_;
};

}  // namespace cairn
