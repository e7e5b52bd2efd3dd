// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map/pose_graph.h"

namespace cairn {

/// Describes what does not change during the optimisation of a pose graph.
struct PoseGraphStructure {
  /// Holds the two vertices of an edge.
  struct EdgeEnds {
    std::size_t a, b;  ///< positions in graph.vertices
  };
  std::vector<EdgeEnds> ends;  ///< for each edge, in order
  std::vector<bool> held;      ///< one for each vertex: true if its pose is kept
  int components = 0;          ///< number of connected parts of the graph
};

/// Finds the structure. Held are the vertices in `graph.fixed` and, in each connected part without one, the
/// first vertex, because parts cannot be placed relative to each other. Throws PreconditionError if an id
/// occurs twice, an edge or a fixed id names an unknown vertex, or an edge joins a vertex to itself.
[[nodiscard]] PoseGraphStructure analyse_pose_graph(const PoseGraph& graph);

}  // namespace cairn
