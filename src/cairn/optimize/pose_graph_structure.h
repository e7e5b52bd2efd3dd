// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map/pose_graph.h"

namespace cairn {

/// What does not change while a pose graph is optimised.
struct PoseGraphStructure {
  struct EdgeEnds {
    std::size_t a, b;  ///< positions in graph.vertices
  };
  std::vector<EdgeEnds> ends;  ///< for each edge, in order
  std::vector<bool> held;      ///< for each vertex: keeps its pose
  int components = 0;          ///< connected parts of the graph
};

/// Holds the vertices in `graph.fixed`, and in each connected part without one its first vertex: parts cannot
/// be placed relative to each other. PreconditionError for double ids, an edge or a fixed id that names an
/// unknown vertex, an edge from a vertex to itself.
[[nodiscard]] PoseGraphStructure analyse_pose_graph(const PoseGraph& graph);

}  // namespace cairn
