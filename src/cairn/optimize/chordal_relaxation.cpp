// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/chordal_relaxation.h"

#include <Eigen/SparseCholesky>
#include <utility>

#include "cairn/geometry/decompositions.h"

namespace cairn {
namespace {

/// Normal equations of linear least squares in which vertex i's unknown is a block of `Block` rows and three
/// columns; blocks of held vertices are known.
template <int Block>
class BlockLeastSquares {
 public:
  using Value = Eigen::Matrix<double, Block, 3>;
  using Factor = Eigen::Matrix<double, Block, Block>;

  explicit BlockLeastSquares(std::vector<Value> initial, const std::vector<bool>& held)
      : values_(std::move(initial)), unknown_(values_.size(), -1) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!held[i]) unknown_[i] = unknowns_++;
    }
    right_side_.setZero(Block * unknowns_, 3);
  }

  /// Adds weight * || x_b - factor * x_a - offset ||^2.
  void add(std::size_t a, std::size_t b, const Factor& factor, const Value& offset, double weight) {
    add_product(b, b, weight * Factor::Identity());
    add_product(a, a, weight * factor.transpose() * factor);
    add_product(b, a, -weight * factor);
    add_product(a, b, -weight * factor.transpose());
    add_right_side(b, weight * offset);
    add_right_side(a, -weight * factor.transpose() * offset);
  }

  /// False where the equations do not determine all unknowns.
  [[nodiscard]] bool solve() {
    if (unknowns_ == 0) return true;
    Eigen::SparseMatrix<double> matrix(Block * unknowns_, Block * unknowns_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factorisation(matrix);
    if (factorisation.info() != Eigen::Success) return false;
    const Eigen::MatrixX3d solution = factorisation.solve(right_side_);
    if (!solution.allFinite()) return false;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (unknown_[i] >= 0) values_[i] = solution.template middleRows<Block>(Block * unknown_[i]);
    }
    return true;
  }

  [[nodiscard]] const std::vector<Value>& values() const { return values_; }

 private:
  /// Adds `product` to the block (row, column) of the normal matrix; known columns go to the right side.
  void add_product(std::size_t row, std::size_t column, const Factor& product) {
    if (unknown_[row] < 0) return;
    if (unknown_[column] < 0) return add_right_side(row, -product * values_[column]);
    for (int i = 0; i < Block; ++i) {
      for (int j = 0; j < Block; ++j) {
        triplets_.emplace_back(Block * unknown_[row] + i, Block * unknown_[column] + j, product(i, j));
      }
    }
  }

  void add_right_side(std::size_t row, const Value& value) {
    if (unknown_[row] >= 0) right_side_.template middleRows<Block>(Block * unknown_[row]) += value;
  }

  std::vector<Value> values_;
  std::vector<int> unknown_;  ///< number of each vertex among the unknowns, -1 where held
  int unknowns_ = 0;
  std::vector<Eigen::Triplet<double>> triplets_;
  Eigen::MatrixX3d right_side_;
};

Eigen::Quaterniond nearest_rotation(const Eigen::Matrix3d& matrix) {
  const Svd3 svd = svd_of(matrix);
  Eigen::Matrix3d u = svd.u;
  if ((u * svd.v.transpose()).determinant() < 0) u.col(2) = -u.col(2);
  return Eigen::Quaterniond(u * svd.v.transpose()).normalized();
}

std::vector<Eigen::Matrix3d> transposed_rotations(const std::vector<Rigid3>& poses) {
  std::vector<Eigen::Matrix3d> transposed;
  for (const auto& pose : poses) transposed.emplace_back(pose.rotation.conjugate().toRotationMatrix());
  return transposed;
}

/// First step, over X = R^T: X_b = R_ab^T X_a.
bool relax_rotations(const PoseGraph& graph, const PoseGraphStructure& structure,
                     std::vector<Rigid3>& poses) {
  BlockLeastSquares<3> problem(transposed_rotations(poses), structure.held);
  for (std::size_t k = 0; k < structure.ends.size(); ++k) {
    const auto& edge = graph.edges[k];
    const auto [a, b] = structure.ends[k];
    const double weight = edge.information.diagonal().tail<3>().mean();
    problem.add(a, b, edge.a_from_b.rotation.conjugate().toRotationMatrix(), Eigen::Matrix3d::Zero(), weight);
  }
  if (!problem.solve()) return false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!structure.held[i]) poses[i].rotation = nearest_rotation(problem.values()[i].transpose());
  }
  return true;
}

/// Second step: t_b = t_a + R_a t_ab.
bool relax_translations(const PoseGraph& graph, const PoseGraphStructure& structure,
                        std::vector<Rigid3>& poses) {
  std::vector<Eigen::RowVector3d> translations;
  for (const auto& pose : poses) translations.emplace_back(pose.translation.transpose());
  BlockLeastSquares<1> problem(std::move(translations), structure.held);
  for (std::size_t k = 0; k < structure.ends.size(); ++k) {
    const auto& edge = graph.edges[k];
    const auto [a, b] = structure.ends[k];
    const double weight = edge.information.diagonal().head<3>().mean();
    const Eigen::Vector3d step = poses[a].rotation * edge.a_from_b.translation;
    problem.add(a, b, Eigen::Matrix<double, 1, 1>::Identity(), step.transpose(), weight);
  }
  if (!problem.solve()) return false;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!structure.held[i]) poses[i].translation = problem.values()[i].transpose();
  }
  return true;
}

}  // namespace

std::vector<Rigid3> relax_chordal(const PoseGraph& graph, const PoseGraphStructure& structure) {
  std::vector<Rigid3> poses;
  for (const auto& vertex : graph.vertices) poses.push_back(vertex.world_from_vertex);
  if (!relax_rotations(graph, structure, poses)) return {};
  if (!relax_translations(graph, structure, poses)) return {};
  return poses;
}

}  // namespace cairn
