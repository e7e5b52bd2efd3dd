// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_structure.h"

#include <algorithm>
#include <numeric>

#include "cairn/core/error.h"

namespace cairn {
namespace {

using Positions = std::unordered_map<std::int64_t, std::size_t>;
using EdgeEnds = PoseGraphStructure::EdgeEnds;

std::vector<EdgeEnds> find_ends(const PoseGraph& graph, const Positions& positions) {
  std::vector<EdgeEnds> ends;
  ends.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const auto a = positions.find(edge.a), b = positions.find(edge.b);
    require(a != positions.end() && b != positions.end(), "edges join vertices of the graph");
    require(a != b, "an edge joins two different vertices");
    ends.push_back({a->second, b->second});
  }
  return ends;
}

/// The connected part of each vertex, named by the part's first vertex (union-find with path halving).
std::vector<std::size_t> find_components(std::size_t vertices, const std::vector<EdgeEnds>& ends) {
  std::vector<std::size_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& [a, b] : ends) {
    const std::size_t root_a = root(a), root_b = root(b);
    parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }
  for (std::size_t i = 0; i < vertices; ++i) parent[i] = root(i);
  return parent;
}

}  // namespace

PoseGraphStructure analyse_pose_graph(const PoseGraph& graph) {
  const Positions positions = vertex_positions(graph);
  const std::size_t vertices = graph.vertices.size();
  PoseGraphStructure structure;
  structure.ends = find_ends(graph, positions);
  structure.held.assign(vertices, false);
  const std::vector<std::size_t> component = find_components(vertices, structure.ends);
  std::vector<bool> anchored(vertices, false);
  for (const std::int64_t id : graph.fixed) {
    const auto position = positions.find(id);
    require(position != positions.end(), "fixed vertices are in the graph");
    structure.held[position->second] = true;
    anchored[component[position->second]] = true;
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    if (component[i] != i) continue;
    ++structure.components;
    if (!anchored[i]) structure.held[i] = true;
  }
  return structure;
}

}  // namespace cairn
