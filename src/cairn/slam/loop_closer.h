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

struct LoopReport {
  int tried = 0;        ///< candidates that were matched with a keyframe
  int verified = 0;     ///< of these, held by geometry
  int rejected = 0;     ///< of these, more than the odometry may have drifted by, or against the graph
  int unconfirmed = 0;  ///< of these, never said again by a second keyframe
  int joined = 0;       ///< landmarks were joined, as the places agreed already
  int closed = 0;       ///< the map was bent together
  int components_joined = 0;
};

/// Recognises places, and bends the map together where the camera has come back to one. Deterministic at any
/// number of threads.
class LoopCloser {
 public:
  LoopCloser(const SlamOptions& options, const Executor& executor, IndexedMap& indexed);

  /// Tries the newest keyframe against keyframes that look like it and lie elsewhere in the map, and closes
  /// the loop that is found. Returns whether keyframes moved.
  bool close(KeyframeId keyframe);
  [[nodiscard]] const LoopReport& report() const { return report_; }
  /// The loops that were closed, as measured.
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
