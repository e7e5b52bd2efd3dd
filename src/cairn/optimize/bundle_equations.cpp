// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_equations.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn {
namespace {

constexpr std::size_t kPointGrain = 64;  // points of a chunk: tens of microseconds

/// [p]x M, without the products with the zeros of [p]x.
Eigen::Matrix3d cross_times(const Eigen::Vector3d& p, const Eigen::Matrix3d& m) {
  Eigen::Matrix3d product;
  for (Eigen::Index c = 0; c < 3; ++c) product.col(c) = p.cross(m.col(c));
  return product;
}

/// Subtracts a b^T. One column after the other, so that `a` stays in registers.
void subtract_product(const Eigen::Matrix<double, 6, 3>& a, const Eigen::Matrix<double, 6, 3>& b,
                      Matrix6d& block) {
  for (Eigen::Index c = 0; c < 6; ++c)
    block.col(c) -= a.col(0) * b(c, 0) + a.col(1) * b(c, 1) + a.col(2) * b(c, 2);
}

}  // namespace

BundleEquations::BundleEquations(const Rig& rig, const BundleStructure& structure,
                                 const BundleOptions& options, const Executor& executor, FieldBorder* border)
    : rig_(rig),
      structure_(structure),
      options_(options),
      executor_(executor),
      border_(border),
      active_(structure.terms.size(), 1),
      links_(structure.link_free.size()),
      link_blocks_(structure.link_free.size()),
      factors_(structure.points.size()),
      prior_errors_(structure.free_cameras.size(), Vector6d::Zero()) {
  find_pattern();
  solver_ = make_block_cholesky(reduced_, choose_method(reduced_));
}

/// Column c of the reduced matrix has a block in row r >= c where a point links both cameras.
void BundleEquations::find_pattern() {
  const std::size_t count = structure_.free_cameras.size();
  right_ = camera_step_ = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(count));
  block_of_.assign(count * count, -1);
  reduced_.begin.push_back(0);
  for (std::size_t column = 0; column < count; ++column) {
    std::int32_t* block_of_row = &block_of_[column * count];
    block_of_row[column] = 0;
    for (const std::size_t link : structure_.links_of_free.of(column)) {
      const auto point = static_cast<std::size_t>(structure_.link_point[link]);
      for (std::size_t other = link; other < structure_.link_begin[point + 1]; ++other)
        block_of_row[structure_.link_free[other]] = 0;
    }
    for (std::size_t row = column; row < count; ++row) {
      if (block_of_row[row] < 0) continue;
      block_of_row[row] = static_cast<std::int32_t>(reduced_.rows.size());
      reduced_.rows.push_back(static_cast<std::int32_t>(row));
    }
    reduced_.begin.push_back(reduced_.rows.size());
  }
  reduced_.blocks.resize(reduced_.rows.size());
}

void BundleEquations::build(const BundleState& state, double lambda) {
  for (std::size_t free = 0; free < prior_errors_.size(); ++free)
    prior_errors_[free] = prior_error(free, state);
  executor_.for_each_chunk(structure_.points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t point = begin; point < end; ++point) build_point(point, state, lambda);
  });
  executor_.for_each(structure_.free_cameras.size(), [&](std::size_t free) { build_column(free, lambda); });
  if (border_ == nullptr) return;
  executor_.for_each(structure_.free_cameras.size(), [&](std::size_t free) { build_border_column(free); });
  border_->sum_points(state.field, lambda);
}

void BundleEquations::build_point(std::size_t point, const BundleState& state, double lambda) {
  const PointSums sums = expand_terms(point, state);
  if (!sums.determine_point()) {
    drop_terms(point);
    return;
  }
  factors_[point] = factorise(sums, lambda);
  for (std::size_t link = structure_.link_begin[point]; link < structure_.link_begin[point + 1]; ++link)
    whiten(factors_[point], link_blocks_[link]);
  if (border_ != nullptr) build_border_point(point);
}

void BundleEquations::build_border_point(std::size_t point) {
  FieldBorder::Point& sums = border_->point(point);
  whiten(factors_[point], sums.coupling);
  sums.gradient.noalias() -= sums.coupling * factors_[point].h;
}

/// Returns the term as the state's field corrects it, in `corrected`; without a field the term itself.
const BundleTerm& BundleEquations::term_at(std::size_t t, const BundleState& state,
                                           BundleTerm& corrected) const {
  if (border_ == nullptr) return structure_.terms[t];
  corrected = border_->correct(structure_.terms[t], state.field);
  return corrected;
}

PointSums BundleEquations::expand_terms(std::size_t point, const BundleState& state) {
  PointSums sums;
  BundleTerm corrected;
  if (border_ != nullptr) border_->clear_point(point);
  const std::size_t begin = structure_.term_begin[point];
  for (std::size_t t = begin; t < structure_.term_begin[point + 1]; ++t) {
    const bool is_link = t - begin < structure_.links(point);
    const std::size_t link = structure_.link_begin[point] + t - begin;
    const BundleTerm& term = term_at(t, state, corrected);
    const MatrixPose& pose = state.matrix_poses[static_cast<std::size_t>(term.camera)];
    const Eigen::Vector3d in_camera = pose * state.points[point];
    if (!is_in_front(in_camera)) active_[t] = 0;
    if (active_[t] == 0) {
      if (is_link) clear_link(link);
      continue;
    }
    const TermExpansion expansion(rig_, in_camera, term, options_.kernel, options_.kernel_scale);
    const Eigen::Matrix3d turned = sums.add(expansion, pose.rotation);
    if (border_ != nullptr) border_->add_term(point, term, expansion, pose.rotation);
    if (!is_link) continue;
    if (border_ != nullptr) border_->set_link(link, term, expansion);
    links_[link] = {in_camera, expansion.gradient(), expansion.hessian()};
    link_blocks_[link] << cross_times(in_camera, turned), turned;
  }
  return sums;
}

void BundleEquations::clear_link(std::size_t link) {
  links_[link] = {};
  link_blocks_[link].setZero();
}

void BundleEquations::drop_terms(std::size_t point) {
  factors_[point] = {};
  if (border_ != nullptr) border_->clear_point(point);
  for (std::size_t t = structure_.term_begin[point]; t < structure_.term_begin[point + 1]; ++t)
    active_[t] = 0;
  for (std::size_t link = structure_.link_begin[point]; link < structure_.link_begin[point + 1]; ++link)
    clear_link(link);
}

/// Adds U and g of a link, the former below the diagonal only.
void BundleEquations::add_link(const Link& link, Matrix6d& hessian, Vector6d& gradient) {
  const Eigen::Matrix3d turned = cross_times(link.point_in_camera, link.hessian).transpose();
  hessian.topLeftCorner<3, 3>() += cross_times(link.point_in_camera, turned);
  hessian.bottomLeftCorner<3, 3>() += turned;
  hessian.bottomRightCorner<3, 3>() += link.hessian;
  gradient.head<3>() += link.point_in_camera.cross(link.gradient);
  gradient.tail<3>() += link.gradient;
}

BundleEquations::PointFactor BundleEquations::factorise(const PointSums& sums, double lambda) {
  const Eigen::Matrix3d& v = sums.information;
  const Eigen::Vector3d diagonal = (1.0 + lambda) * v.diagonal();
  PointFactor factor;
  const double i0 = 1.0 / std::sqrt(diagonal[0]);
  factor.l10 = v(1, 0) * i0;
  factor.l20 = v(2, 0) * i0;
  const double i1 = 1.0 / std::sqrt(diagonal[1] - factor.l10 * factor.l10);
  factor.l21 = (v(2, 1) - factor.l20 * factor.l10) * i1;
  const double i2 = 1.0 / std::sqrt(diagonal[2] - factor.l20 * factor.l20 - factor.l21 * factor.l21);
  factor.inverse_diagonal = {i0, i1, i2};
  factor.h[0] = sums.gradient[0] * i0;
  factor.h[1] = (sums.gradient[1] - factor.l10 * factor.h[0]) * i1;
  factor.h[2] = (sums.gradient[2] - factor.l20 * factor.h[0] - factor.l21 * factor.h[1]) * i2;
  return factor;
}

/// Z to Y = Z L^-T: its rows are L^-1 times those of Z.
template <int kRows>
void BundleEquations::whiten(const PointFactor& factor, Eigen::Matrix<double, kRows, 3>& block) {
  block.col(0) *= factor.inverse_diagonal[0];
  block.col(1) = (block.col(1) - factor.l10 * block.col(0)) * factor.inverse_diagonal[1];
  block.col(2) =
      (block.col(2) - factor.l20 * block.col(0) - factor.l21 * block.col(1)) * factor.inverse_diagonal[2];
}

void BundleEquations::build_column(std::size_t free, double lambda) {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  const std::int32_t* block_of_row = &block_of_[free * structure_.free_cameras.size()];
  std::fill(reduced_.blocks.begin() + static_cast<std::ptrdiff_t>(reduced_.begin[free]),
            reduced_.blocks.begin() + static_cast<std::ptrdiff_t>(reduced_.begin[free + 1]),
            Matrix6d::Zero());
  for (const std::size_t link : structure_.links_of_free.of(free)) {
    add_link(links_[link], hessian, gradient);
    const auto point = static_cast<std::size_t>(structure_.link_point[link]);
    const LinkBlock& own = link_blocks_[link];
    gradient.noalias() -= own * factors_[point].h;
    for (std::size_t other = link; other < structure_.link_begin[point + 1]; ++other)
      subtract_product(link_blocks_[other], own,
                       reduced_.blocks[static_cast<std::size_t>(block_of_row[structure_.link_free[other]])]);
  }
  const CameraPrior& prior = structure_.prior_of_free[free];
  hessian += prior.information;
  gradient.noalias() += prior.information * prior_errors_[free];
  constexpr double kLeastDiagonal = 1e-6;  // so that a camera without observations stays
  hessian.diagonal() += lambda * hessian.diagonal().cwiseMax(kLeastDiagonal);
  reduced_.blocks[reduced_.begin[free]] += hessian;
  right_.segment<6>(6 * static_cast<Eigen::Index>(free)) = -gradient;
}

void BundleEquations::build_border_column(std::size_t free) {
  LinkBlock block = LinkBlock::Zero();
  for (const std::size_t link : structure_.links_of_free.of(free)) {
    border_->add_link(link, links_[link].point_in_camera, block);
    const auto point = static_cast<std::size_t>(structure_.link_point[link]);
    block.noalias() -= link_blocks_[link] * border_->point(point).coupling.transpose();
  }
  border_->set_camera(free, block);
}

void BundleEquations::add_gradient(std::size_t point, Eigen::Ref<Eigen::VectorXd> cameras,
                                   Eigen::Vector3d& field) const {
  for (std::size_t link = structure_.link_begin[point]; link < structure_.link_begin[point + 1]; ++link) {
    Matrix6d unused = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    add_link(links_[link], unused, gradient);
    gradient.noalias() -= link_blocks_[link] * factors_[point].h;
    cameras.segment<6>(6 * static_cast<Eigen::Index>(structure_.link_free[link])) += gradient;
  }
  field += border_->point(point).gradient;
}

bool BundleEquations::solve() {
  if (border_ != nullptr) return solve_bordered();
  return structure_.free_cameras.empty() || solver_->solve(reduced_, right_, camera_step_);
}

bool BundleEquations::solve_bordered() {
  Eigen::MatrixX3d solved_cameras = border_->cameras();
  if (!structure_.free_cameras.empty()) {
    if (!solver_->solve(reduced_, right_, camera_step_)) return false;
    Eigen::VectorXd column;
    for (Eigen::Index c = 0; c < 3; ++c) {
      if (!solver_->solve(border_->cameras().col(c), column)) return false;
      solved_cameras.col(c) = column;
    }
  }
  if (!border_->solve(camera_step_, solved_cameras)) return false;
  camera_step_.noalias() -= solved_cameras * border_->step();
  return true;
}

Eigen::Vector3d BundleEquations::point_step(std::size_t point) const {
  const PointFactor& factor = factors_[point];
  Eigen::Vector3d y = factor.h;
  for (std::size_t link = structure_.link_begin[point]; link < structure_.link_begin[point + 1]; ++link)
    y.noalias() += link_blocks_[link].transpose() *
                   camera_step_.segment<6>(6 * static_cast<Eigen::Index>(structure_.link_free[link]));
  if (border_ != nullptr) y.noalias() += border_->point(point).coupling.transpose() * border_->step();
  Eigen::Vector3d step;
  step[2] = -y[2] * factor.inverse_diagonal[2];
  step[1] = (-y[1] - factor.l21 * step[2]) * factor.inverse_diagonal[1];
  step[0] = (-y[0] - factor.l10 * step[1] - factor.l20 * step[2]) * factor.inverse_diagonal[0];
  return step;
}

void BundleEquations::move(const BundleState& from, BundleState& to) const {
  move_cameras(from, to);
  if (border_ != nullptr) to.field = from.field + border_->step();
  executor_.for_each_chunk(structure_.points.size(), kPointGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t point = begin; point < end; ++point) move_point(point, from, to);
  });
  sum_costs(to);
}

void BundleEquations::move_cameras(const BundleState& from, BundleState& to) const {
  for (std::size_t free = 0; free < structure_.free_cameras.size(); ++free) {
    const auto camera = static_cast<std::size_t>(structure_.free_cameras[free]);
    const Vector6d step = camera_step_.segment<6>(6 * static_cast<Eigen::Index>(free));
    to.set_camera(camera, perturb_left(step, from.camera_from_world[camera]));
  }
}

void BundleEquations::move_point(std::size_t point, const BundleState& from, BundleState& to) const {
  to.points[point] = from.points[point] + point_step(point);
  if (price_point(point, from.term_costs, to)) return;
  to.points[point] = from.points[point];
  price_point(point, from.term_costs, to);
}

void BundleEquations::evaluate_costs(BundleState& state) const {
  for (std::size_t point = 0; point < structure_.points.size(); ++point)
    price_point(point, state.term_costs, state);
  sum_costs(state);
}

/// Returns zero for a free camera without prior.
Vector6d BundleEquations::prior_error(std::size_t free, const BundleState& state) const {
  const CameraPrior& prior = structure_.prior_of_free[free];
  if (prior.information.isZero(0)) return Vector6d::Zero();
  const auto camera = static_cast<std::size_t>(structure_.free_cameras[free]);
  return left_perturbation(prior.camera_from_world, state.camera_from_world[camera]);
}

void BundleEquations::sum_costs(BundleState& state) const {
  state.sum_costs();
  for (std::size_t free = 0; free < structure_.prior_of_free.size(); ++free) {
    const Vector6d error = prior_error(free, state);
    state.cost += 0.5 * error.dot(structure_.prior_of_free[free].information * error);
  }
  if (border_ != nullptr) state.cost += border_->prior_cost(state.field);
}

std::size_t BundleEquations::count_disparities() const {
  std::size_t count = 0;
  for (std::size_t t = 0; t < active_.size(); ++t)
    if (active_[t] != 0 && structure_.terms[t].inverse_variances.z() > 0) ++count;
  return count;
}

/// False where a term is behind its camera.
bool BundleEquations::price_point(std::size_t point, const std::vector<double>& costs_before,
                                  BundleState& state) const {
  bool in_front = true;
  BundleTerm corrected;
  for (std::size_t t = structure_.term_begin[point]; t < structure_.term_begin[point + 1]; ++t) {
    const BundleTerm& term = term_at(t, state, corrected);
    const Eigen::Vector3d in_camera =
        state.matrix_poses[static_cast<std::size_t>(term.camera)] * state.points[point];
    state.term_costs[t] = costs_before[t];
    if (active_[t] == 0) continue;
    if (is_in_front(in_camera))
      state.term_costs[t] = kernel_cost(options_.kernel, options_.kernel_scale,
                                        term.squared_error(rig_.project(in_camera) - term.seen));
    else
      in_front = false;
  }
  return in_front;
}

BundleState::BundleState(const BundleProblem& problem, const BundleStructure& structure)
    : camera_from_world(problem.camera_from_world),
      matrix_poses(to_matrix_poses(camera_from_world)),
      term_costs(structure.terms.size(), 0.0) {
  for (const std::int32_t point : structure.points)
    points.push_back(problem.points_in_world[static_cast<std::size_t>(point)]);
}

void BundleState::set_camera(std::size_t camera, const Rigid3& pose) {
  camera_from_world[camera] = pose;
  matrix_poses[camera] = to_matrix_pose(pose);
}

std::vector<MatrixPose> to_matrix_poses(const std::vector<Rigid3>& poses) {
  std::vector<MatrixPose> matrix_poses;
  matrix_poses.reserve(poses.size());
  for (const Rigid3& pose : poses) matrix_poses.push_back(to_matrix_pose(pose));
  return matrix_poses;
}

void BundleState::sum_costs() {
  cost = 0.5 * std::accumulate(term_costs.begin(), term_costs.end(), 0.0);
}

}  // namespace cairn
