// SPDX-License-Identifier: Apache-2.0
#include "cairn/slam/graph_edge.h"

#include <Eigen/Cholesky>

namespace cairn {
namespace {

// With these the loop edges of a real Kinect recording cost about as much as they have degrees of freedom.
constexpr double kRotationFloor = 0.004;     // radians: 2 px at 525 px focal length
constexpr double kTranslationFloor = 0.010;  // metres: the Kinect's systematic depth error at 2 to 3 m

Matrix6d inverse(const Matrix6d& symmetric) {
  return symmetric.ldlt().solve(Matrix6d::Identity());
}

/// With D = (exp(w), v) perturbing current_from_reference on the left, the edge's error is D^-1: translation
/// -v, vector part of the quaternion -w / 2. Hence (v, w) = -(t, 2 q), and the blocks change places.
Matrix6d in_g2o_order(const Matrix6d& information) {
  Matrix6d ordered;
  ordered.topLeftCorner<3, 3>() = information.bottomRightCorner<3, 3>();
  ordered.topRightCorner<3, 3>() = 2 * information.bottomLeftCorner<3, 3>();
  ordered.bottomLeftCorner<3, 3>() = 2 * information.topRightCorner<3, 3>();
  ordered.bottomRightCorner<3, 3>() = 4 * information.topLeftCorner<3, 3>();
  return ordered;
}

}  // namespace

PoseGraph::Edge make_edge(KeyframeId reference, KeyframeId current, const Motion& motion, bool loop) {
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(kRotationFloor), Eigen::Vector3d::Constant(kTranslationFloor);
  Matrix6d covariance = inverse(motion.information);
  covariance.diagonal() += floor.cwiseAbs2();
  Matrix6d information = in_g2o_order(inverse(covariance));
  information = (0.5 * (information + information.transpose())).eval();
  return {reference.value, current.value, motion.current_from_reference.inverse(), information, loop};
}

}  // namespace cairn
