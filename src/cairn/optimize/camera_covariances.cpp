// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/camera_covariances.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/optimize/block_inverse.h"
#include "cairn/optimize/bundle_equations.h"

namespace cairn {
namespace {

constexpr int kCellColumns = 12, kCellRows = 8;
constexpr int kCells = kCellColumns * kCellRows;
constexpr std::int32_t kFixed = -1;

BundleProblem with_used(const BundleProblem& problem, std::span<const char> use_observation) {
  BundleProblem used = problem;
  used.observations.clear();
  for (std::size_t i = 0; i < problem.observations.size(); ++i)
    if (use_observation[i] != 0) used.observations.push_back(problem.observations[i]);
  return used;
}

/// Maps a number of [low, high] to a cell of [0, count).
int cell_of(double value, double low, double high, int count) {
  if (!(high > low)) return 0;
  return std::clamp(static_cast<int>(count * (value - low) / (high - low)), 0, count - 1);
}

/// Computes the mean pixel of each point of the structure.
std::vector<Eigen::Vector2d> mean_pixels(const BundleStructure& structure) {
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t point = 0; point < structure.points.size(); ++point) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t t = structure.term_begin[point]; t < structure.term_begin[point + 1]; ++t)
      sum += structure.terms[t].seen.head<2>();
    pixels.emplace_back(sum /
                        static_cast<double>(structure.term_begin[point + 1] - structure.term_begin[point]));
  }
  return pixels;
}

/// Finds the cell of each point of the structure, in a grid over the pixels that show one.
std::vector<int> find_cells(const BundleStructure& structure) {
  const std::vector<Eigen::Vector2d> pixels = mean_pixels(structure);
  Eigen::Vector2d low = pixels.front(), high = pixels.front();
  for (const Eigen::Vector2d& pixel : pixels) {
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  std::vector<int> cells;
  cells.reserve(pixels.size());
  for (const Eigen::Vector2d& pixel : pixels)
    cells.push_back(cell_of(pixel.x(), low.x(), high.x(), kCellColumns) +
                    kCellColumns * cell_of(pixel.y(), low.y(), high.y(), kCellRows));
  return cells;
}

/// Returns the matrix with a block, perhaps of zeros, at each of `places` (row below the column).
BlockMatrix with_blocks_at(const BlockMatrix& matrix,
                           std::vector<std::pair<std::int32_t, std::int32_t>> places) {
  std::sort(places.begin(), places.end());  // by column
  BlockMatrix result;
  result.begin.push_back(0);
  auto place = places.begin();
  for (std::size_t column = 0; column < matrix.columns(); ++column) {
    std::vector<std::pair<std::int32_t, Matrix6d>> blocks;
    for (std::size_t k = matrix.begin[column]; k < matrix.begin[column + 1]; ++k)
      blocks.emplace_back(matrix.rows[k], matrix.blocks[k]);
    for (; place != places.end() && place->first == static_cast<std::int32_t>(column); ++place) {
      const auto is_there = [&](const auto& block) { return block.first == place->second; };
      if (std::none_of(blocks.begin(), blocks.end(), is_there))
        blocks.emplace_back(place->second, Matrix6d::Zero());
    }
    std::sort(blocks.begin(), blocks.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [row, block] : blocks) {
      result.rows.push_back(row);
      result.blocks.push_back(block);
    }
    result.begin.push_back(result.rows.size());
  }
  return result;
}

/// Holds what a motion is in the unknowns: the perturbation of `to` less `carried` times that of `from`.
struct MotionRows {
  std::int32_t from = kFixed, to = kFixed;  // free cameras
  Matrix6d carried = Matrix6d::Zero();

  /// Applies the motion to columns over all unknowns of the cameras.
  [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> times(const Eigen::MatrixXd& columns) const {
    Eigen::Matrix<double, 6, Eigen::Dynamic> product =
        Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, columns.cols());
    if (to != kFixed) product += columns.middleRows<6>(6 * static_cast<Eigen::Index>(to));
    if (from != kFixed) product -= carried * columns.middleRows<6>(6 * static_cast<Eigen::Index>(from));
    return product;
  }

  [[nodiscard]] Matrix6d covariance(const BlockInverse& inverse) const {
    Matrix6d sum = Matrix6d::Zero();
    const auto block = [&](std::int32_t row, std::int32_t column) {
      return inverse.block(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    };
    if (to != kFixed) sum += block(to, to);
    if (from != kFixed) sum += carried * block(from, from) * carried.transpose();
    if (to == kFixed || from == kFixed) return as_covariance(sum);
    const Matrix6d mixed = block(to, from) * carried.transpose();
    return as_covariance(Matrix6d(sum - mixed - mixed.transpose()));
  }
};

/// Computes the covariances of one problem.
class MotionCovariances {
 public:
  MotionCovariances(const BundleProblem& problem, const BundleStructure& structure, SharedField shared,
                    const Executor& executor)
      : problem_(problem),
        structure_(structure),
        shared_(shared),
        executor_(executor),
        border_(problem.rig, structure, kPriorPx),
        equations_(problem.rig, structure, options_, executor, &border_),
        state_(problem, structure) {}

  /// Returns whether the observations determine the cameras.
  [[nodiscard]] bool prepare(std::span<const CameraMotion> motions) {
    find_rows(motions);
    equations_.build(state_, 0);
    const BlockMatrix matrix = with_blocks_at(equations_.reduced_matrix(), mixed_places());
    inverse_ = invert_blocks(matrix, choose_method(matrix));
    return inverse_ != nullptr && solve_cells();
  }

  [[nodiscard]] CameraCovariances compute() const {
    CameraCovariances result;
    result.determined = true;
    for (const MotionRows& rows : rows_) {
      result.formal.push_back(rows.covariance(*inverse_));
      result.covariances.push_back(covariance(rows, result.formal.back()));
    }
    return result;
  }

 private:
  static constexpr double kPriorPx = 1;  // of the field's coefficients

  void find_rows(std::span<const CameraMotion> motions) {
    std::vector<std::int32_t> free_of(problem_.camera_fixed.size(), kFixed);
    for (std::size_t free = 0; free < structure_.free_cameras.size(); ++free)
      free_of[static_cast<std::size_t>(structure_.free_cameras[free])] = static_cast<std::int32_t>(free);
    for (const auto& [from, to] : motions) {
      const auto f = static_cast<std::size_t>(from), t = static_cast<std::size_t>(to);
      const Rigid3 to_from_from = problem_.camera_from_world[t] * problem_.camera_from_world[f].inverse();
      rows_.push_back({free_of[f], free_of[t], adjoint(to_from_from)});
    }
  }

  /// Lists (column, row) of the blocks that the motions need beside the diagonal.
  [[nodiscard]] std::vector<std::pair<std::int32_t, std::int32_t>> mixed_places() const {
    std::vector<std::pair<std::int32_t, std::int32_t>> places;
    for (const MotionRows& rows : rows_)
      if (rows.from != kFixed && rows.to != kFixed)
        places.emplace_back(std::min(rows.from, rows.to), std::max(rows.from, rows.to));
    return places;
  }

  /// Computes what each cell does to cameras and field. Returns whether the equations have a solution.
  [[nodiscard]] bool solve_cells() {
    Eigen::Matrix3Xd field;
    const Eigen::MatrixXd gradients = sum_cells(field);
    by_cell_ = solve(gradients);
    by_field_ = solve(border_.cameras());
    if (!border_.solve(-by_cell_.rowwise().sum(), by_field_) || !by_cell_.allFinite()) return false;
    const Eigen::Matrix3d field_covariance = border_.covariance();
    const Eigen::Matrix3Xd field_by_cell =
        field_covariance * (field - border_.cameras().transpose() * by_cell_);
    if (shared_ == SharedField::estimated) {
      field_covariance_ = field_covariance;
      by_cell_ -= by_field_ * field_by_cell;
    }
    by_cell_ *= std::sqrt(cells_ / std::max(1.0, cells_ - 1.0));  // the gradients sum to zero
    keep_bias(field_by_cell);
    return true;
  }

  /// Sums the gradients of the points of each cell, one column for each.
  [[nodiscard]] Eigen::MatrixXd sum_cells(Eigen::Matrix3Xd& field) {
    const std::vector<int> cell_of_point = find_cells(structure_);
    Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(border_.cameras().rows(), kCells);
    field = Eigen::Matrix3Xd::Zero(3, kCells);
    for (std::size_t point = 0; point < cell_of_point.size(); ++point) {
      const Eigen::Index cell = cell_of_point[point];
      Eigen::Vector3d of_field = Eigen::Vector3d::Zero();
      equations_.add_gradient(point, gradients.col(cell), of_field);
      field.col(cell) += of_field;
    }
    for (Eigen::Index cell = 0; cell < kCells; ++cell) cells_ += gradients.col(cell).isZero(0) ? 0 : 1;
    return gradients;
  }

  /// Keeps what the residuals show of a field that was not taken off, if it is beyond its own error.
  void keep_bias(const Eigen::Matrix3Xd& field_by_cell) {
    const Eigen::Matrix3d covariance =
        as_covariance(Eigen::Matrix3d(field_by_cell * field_by_cell.transpose()));
    const Eigen::LLT<Eigen::Matrix3d> factor(covariance);
    bias_ = Eigen::VectorXd::Zero(by_field_.rows());
    if (factor.info() != Eigen::Success) return;
    const double square = border_.step().dot(factor.solve(border_.step()));
    constexpr double kLimit99 = 11.345;  // chi-square with 3 degrees of freedom
    if (square > kLimit99) bias_ = by_field_ * border_.step();
  }

  /// Solves for each column, in chunks that do not depend on the number of threads.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const {
    constexpr std::size_t kGrain = 16;
    Eigen::MatrixXd solved(right.rows(), right.cols());
    executor_.for_each_chunk(
        static_cast<std::size_t>(right.cols()), kGrain, [&](std::size_t begin, std::size_t end) {
          const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
          solved.middleCols(first, count) = inverse_->solve(right.middleCols(first, count));
        });
    return solved;
  }

  [[nodiscard]] Matrix6d covariance(const MotionRows& rows, const Matrix6d& formal) const {
    const Eigen::Matrix<double, 6, Eigen::Dynamic> pulls = rows.times(by_cell_),
                                                   field = rows.times(by_field_);
    Matrix6d with_field = as_covariance(Matrix6d(formal + field * field_covariance_ * field.transpose()));
    Matrix6d seen = as_covariance(Matrix6d(pulls * pulls.transpose()));
    const Eigen::LLT<Matrix6d> factor(with_field);
    if (factor.info() != Eigen::Success) return seen;  // of a camera to itself
    const Eigen::VectorXd sizes =
        pulls.cwiseProduct(Eigen::Matrix<double, 6, Eigen::Dynamic>(factor.solve(pulls))).colwise().sum();
    if (!(sizes.sum() > 0)) return with_field;  // no residual at all
    const double alike = std::pow(sizes.sum(), 2) / sizes.squaredNorm(), weight = alike / (alike + kCells);
    const Matrix6d mean = weight * seen + (1 - weight) * sizes.sum() / 6 * with_field;
    const Vector6d bias = rows.times(bias_);
    return as_covariance(Matrix6d((alike + 6) / alike * mean + bias * bias.transpose()));
  }

  const BundleProblem& problem_;
  const BundleStructure& structure_;
  const SharedField shared_;
  const Executor& executor_;
  BundleOptions options_;
  FieldBorder border_;
  BundleEquations equations_;
  BundleState state_;
  std::vector<MotionRows> rows_;
  std::unique_ptr<BlockInverse> inverse_;
  int cells_ = 0;             // that points are in
  Eigen::MatrixXd by_cell_;   // what each cell does to the cameras, a column for each
  Eigen::MatrixXd by_field_;  // what each coefficient of the field does to the cameras
  Eigen::VectorXd bias_;      // of the cameras by the field that was not taken off
  Eigen::Matrix3d field_covariance_ = Eigen::Matrix3d::Zero();  // zero without an estimated field
};

bool has_fixed(const BundleProblem& problem) {
  return std::any_of(problem.camera_fixed.begin(), problem.camera_fixed.end(),
                     [](char fixed) { return fixed != 0; });
}

}  // namespace

CameraCovariances camera_covariances(const BundleProblem& problem, std::span<const char> use_observation,
                                     std::span<const CameraMotion> motions, SharedField field,
                                     const Executor& executor) {
  require_bundle(problem);
  require(use_observation.size() == problem.observations.size(), "use_observation has one for each");
  const auto cameras = static_cast<std::int32_t>(problem.camera_fixed.size());
  for (const auto& [from, to] : motions)
    require(from >= 0 && from < cameras && to >= 0 && to < cameras, "a motion is of two cameras");
  const BundleProblem used = with_used(problem, use_observation);
  const BundleStructure structure = analyse_bundle(used);
  if (!has_fixed(used) || structure.free_cameras.empty() || structure.points.empty()) return {};
  MotionCovariances covariances(used, structure, field, executor);
  return covariances.prepare(motions) ? covariances.compute() : CameraCovariances{};
}

Matrix6d adjoint(const Rigid3& target_from_source) {
  const Eigen::Matrix3d rotation = target_from_source.matrix3();
  Matrix6d result = Matrix6d::Zero();
  result.topLeftCorner<3, 3>() = result.bottomRightCorner<3, 3>() = rotation;
  result.bottomLeftCorner<3, 3>() = skew(target_from_source.translation) * rotation;
  return result;
}

}  // namespace cairn
