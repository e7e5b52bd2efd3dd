// SPDX-License-Identifier: Apache-2.0
#include "cairn/map/pose_graph.h"

#include "cairn/core/error.h"

namespace cairn {

Matrix6d information_from_std(double translation_std_m, double rotation_std_rad) {
  require(translation_std_m > 0 && rotation_std_rad > 0, "standard deviations are above 0");
  Vector6d diagonal;
  diagonal.head<3>().setConstant(1.0 / (translation_std_m * translation_std_m));
  diagonal.tail<3>().setConstant(4.0 / (rotation_std_rad * rotation_std_rad));
  return diagonal.asDiagonal();
}

std::unordered_map<std::int64_t, std::size_t> vertex_positions(const PoseGraph& graph) {
  std::unordered_map<std::int64_t, std::size_t> positions;
  positions.reserve(graph.vertices.size());
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    require(positions.emplace(graph.vertices[i].id, i).second, "vertex ids are unique");
  }
  return positions;
}

std::size_t flag_loop_edges_robust(PoseGraph& graph) {
  const auto positions = vertex_positions(graph);
  std::size_t flagged = 0;
  for (PoseGraph::Edge& edge : graph.edges) {
    const auto a = positions.find(edge.a), b = positions.find(edge.b);
    require(a != positions.end() && b != positions.end(), "edges join vertices of the graph");
    edge.robust = a->second + 1 != b->second && b->second + 1 != a->second;
    if (edge.robust) ++flagged;
  }
  return flagged;
}

}  // namespace cairn
