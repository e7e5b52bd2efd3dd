// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_residual.h"

#include <cmath>
#include <numeric>

#include "cairn/core/error.h"

namespace cairn {
namespace {

/// q_E of the header with w >= 0.
Eigen::Quaterniond rotation_error(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                  const Rigid3& a_from_b) {
  Eigen::Quaterniond error =
      a_from_b.rotation.conjugate() * world_from_a.rotation.conjugate() * world_from_b.rotation;
  if (error.w() < 0) error.coeffs() = -error.coeffs();
  return error;
}

}  // namespace

Vector6d pose_graph_error(const Rigid3& world_from_a, const Rigid3& world_from_b, const Rigid3& a_from_b) {
  const Eigen::Vector3d b_in_a =
      world_from_a.rotation.conjugate() * (world_from_b.translation - world_from_a.translation);
  Vector6d error;
  error.head<3>() = a_from_b.rotation.conjugate() * (b_in_a - a_from_b.translation);
  error.tail<3>() = rotation_error(world_from_a, world_from_b, a_from_b).vec();
  return error;
}

Vector6d planar_graph_error(const Rigid3& world_from_a, const Rigid3& world_from_b, const Rigid3& a_from_b) {
  const Eigen::Quaterniond rotation = rotation_error(world_from_a, world_from_b, a_from_b);
  Vector6d error = pose_graph_error(world_from_a, world_from_b, a_from_b);
  error.tail<3>() << 0, 0, 2 * std::atan2(rotation.z(), rotation.w());
  return error;
}

Vector6d edge_error(const PoseGraph& graph, const PoseGraph::Edge& edge, const Rigid3& world_from_a,
                    const Rigid3& world_from_b) {
  return graph.planar ? planar_graph_error(world_from_a, world_from_b, edge.a_from_b)
                      : pose_graph_error(world_from_a, world_from_b, edge.a_from_b);
}

Rigid3 perturb_vertex(const Vector6d& xi, const Rigid3& world_from_vertex) {
  return {(rotation_exp(xi.head<3>()) * world_from_vertex.rotation).normalized(),
          world_from_vertex.translation + xi.tail<3>()};
}

PoseGraphJacobians pose_graph_jacobians(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                        const Rigid3& a_from_b) {
  const Eigen::Matrix3d measured_b_from_world =
      (world_from_a.rotation * a_from_b.rotation).conjugate().toRotationMatrix();
  const Eigen::Vector3d b_from_a_in_world = world_from_b.translation - world_from_a.translation;
  const Eigen::Quaterniond q = rotation_error(world_from_a, world_from_b, a_from_b);
  const Eigen::Matrix3d half_turn =
      0.5 * (q.w() * Eigen::Matrix3d::Identity() - skew(q.vec())) * measured_b_from_world;
  PoseGraphJacobians jacobians{Matrix6d::Zero(), Matrix6d::Zero()};
  jacobians.by_a.topLeftCorner<3, 3>() = measured_b_from_world * skew(b_from_a_in_world);
  jacobians.by_a.topRightCorner<3, 3>() = -measured_b_from_world;
  jacobians.by_a.bottomLeftCorner<3, 3>() = -half_turn;
  jacobians.by_b.topRightCorner<3, 3>() = measured_b_from_world;
  jacobians.by_b.bottomLeftCorner<3, 3>() = half_turn;
  return jacobians;
}

PoseGraphJacobians planar_graph_jacobians(const Rigid3& world_from_a, const Rigid3& world_from_b,
                                          const Rigid3& a_from_b) {
  const PoseGraphJacobians spatial = pose_graph_jacobians(world_from_a, world_from_b, a_from_b);
  PoseGraphJacobians jacobians{Matrix6d::Zero(), Matrix6d::Zero()};
  jacobians.by_a.block<2, 3>(0, 2) = spatial.by_a.block<2, 3>(0, 2);
  jacobians.by_b.block<2, 3>(0, 2) = spatial.by_b.block<2, 3>(0, 2);
  jacobians.by_a(5, 2) = -1;
  jacobians.by_b(5, 2) = 1;
  return jacobians;
}

std::vector<double> edge_chi2(const PoseGraph& graph) {
  const auto positions = vertex_positions(graph);
  std::vector<double> result;
  result.reserve(graph.edges.size());
  for (const PoseGraph::Edge& edge : graph.edges) {
    const auto a = positions.find(edge.a), b = positions.find(edge.b);
    require(a != positions.end() && b != positions.end(), "edges join vertices of the graph");
    const Vector6d error = edge_error(graph, edge, graph.vertices[a->second].world_from_vertex,
                                      graph.vertices[b->second].world_from_vertex);
    result.push_back(error.dot(edge.information * error));
  }
  return result;
}

double chi2(const PoseGraph& graph) {
  const std::vector<double> each = edge_chi2(graph);
  return std::accumulate(each.begin(), each.end(), 0.0);
}

}  // namespace cairn
