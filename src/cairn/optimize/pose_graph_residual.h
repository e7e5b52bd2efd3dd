// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/geometry/rigid3.h"
#include "cairn/map/pose_graph.h"

namespace cairn {

/// Computes the error of one edge as g2o defines it (EdgeSE3), in the order (translation, vector part of the
/// quaternion):
///
///     E = a_from_b^-1 * world_from_a^-1 * world_from_b,   e = (t_E, vec(q_E)) with w(q_E) >= 0.
///
/// Units are metres and sines of half angles, in the frame of the measured b.
[[nodiscard]] Vector6d pose_graph_error(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                        const Rigid3& a_from_b);

/// Computes the error of one edge of a planar graph as g2o defines it (EdgeSE2): as pose_graph_error, but
/// (0, 0, angle of q_E) in the place of its vector part, radians in (-pi, pi].
[[nodiscard]] Vector6d planar_graph_error(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                          const Rigid3& a_from_b);

/// Computes the error of an edge of `graph` if its vertices had these poses.
[[nodiscard]] Vector6d edge_error(const PoseGraph& graph, const PoseGraph::Edge& edge,
                                  const Rigid3& world_from_a, const Rigid3& world_from_b);

/// Moves a vertex by the optimiser's step xi = (w, v): exp(w) * R and t + v. The rotation is perturbed on the
/// left, in the world; the translation is not rotated with it (unlike perturb_left), so that the problem's
/// conditioning does not depend on the distance of the graph from the world's origin.
[[nodiscard]] Rigid3 perturb_vertex(const Vector6d& xi, const Rigid3& world_from_vertex);

/// Holds the derivatives of pose_graph_error by perturb_vertex of either vertex at xi = 0: rows as the error,
/// columns as xi.
struct PoseGraphJacobians {
  Matrix6d by_a;
  Matrix6d by_b;
};

/// Computes the derivatives: with M = (R_a * R_ab)^T, d = t_b - t_a and q_E = (s, u),
///
///     d t_E / d w_a =  M [d]x              d t_E / d v_a = -M
///     d t_E / d w_b =  0                   d t_E / d v_b =  M
///     d vec / d w_b =  (s I - [u]x) M / 2  = -d vec / d w_a
///
/// because q_E(w_b) = q_ab^-1 q_a^-1 exp(w_b) q_b = exp(M w_b) q_E, and exp(-M w_a) q_E for a.
[[nodiscard]] PoseGraphJacobians pose_graph_jacobians(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                                      const Rigid3& a_from_b);

/// Computes the derivatives of planar_graph_error by steps within the plane: by w_z, v_x and v_y. Columns of
/// other steps are 0.
[[nodiscard]] PoseGraphJacobians planar_graph_jacobians(const Rigid3& world_from_a,
                                                        const Rigid3& world_from_b, const Rigid3& a_from_b);

/// Computes e^T * information * e of each edge, without robust kernel, in order. Throws PreconditionError if
/// an edge names an unknown vertex.
[[nodiscard]] std::vector<double> edge_chi2(const PoseGraph& graph);
/// Computes the sum of edge_chi2, added up in order.
[[nodiscard]] double chi2(const PoseGraph& graph);

}  // namespace cairn
