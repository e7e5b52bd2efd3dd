// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/map/pose_graph.h"
#include "cairn/optimize/pose_graph_structure.h"

namespace cairn {

/// Computes the poses of a pose graph from its measurements alone, in two linear steps (Carlone, Tron,
/// Daniilidis, Dellaert 2015, "Initialization techniques for 3D SLAM", sec. III-B; Martinec and Pajdla 2007):
///
///     min sum w_k || R_b - R_a R_ab ||_F^2   over 3x3 matrices, each then moved to the nearest rotation,
///     min sum v_k || t_b - t_a - R_a t_ab ||^2.
///
/// The weights are the mean information of the edge's rotation and translation. Held vertices keep their
/// poses; the poses of the others in `graph` are not used. Edges flagged robust count like all others.
/// Returns one pose for each vertex, in order; returns none if the information leaves a pose undetermined.
/// Cost: two sparse Cholesky factorisations. Deterministic.
[[nodiscard]] std::vector<Rigid3> relax_chordal(const PoseGraph& graph, const PoseGraphStructure& structure);

}  // namespace cairn
