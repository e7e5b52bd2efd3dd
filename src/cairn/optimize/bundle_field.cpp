// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/bundle_field.h"

#include <Eigen/Cholesky>

#include "cairn/geometry/covariance.h"

namespace cairn {

FieldBorder::FieldBorder(const Rig& rig, const BundleStructure& structure, double prior_sigma_px)
    : rig_(rig),
      structure_(structure),
      prior_information_(1.0 / (prior_sigma_px * prior_sigma_px)),
      points_(structure.points.size()),
      link_rows_(structure.link_free.size(), Eigen::Vector3d::Zero()),
      cameras_(Eigen::MatrixX3d::Zero(6 * static_cast<Eigen::Index>(structure.free_cameras.size()), 3)),
      information_(Eigen::Matrix3d::Zero()),
      remainder_(Eigen::Matrix3d::Zero()),
      right_(Eigen::Vector3d::Zero()),
      step_(Eigen::Vector3d::Zero()) {}

BundleTerm FieldBorder::correct(const BundleTerm& term, const DisparityField& field) const {
  BundleTerm corrected = term;
  corrected.seen.z() -= disparity_field_basis(rig_, term.seen.x()).dot(field);
  return corrected;
}

double FieldBorder::prior_cost(const DisparityField& field) const {
  return 0.5 * prior_information_ * field.squaredNorm();
}

void FieldBorder::clear_point(std::size_t point) {
  points_[point] = {};
  for (std::size_t link = structure_.link_begin[point]; link < structure_.link_begin[point + 1]; ++link)
    link_rows_[link].setZero();
}

void FieldBorder::add_term(std::size_t point, const BundleTerm& term, const TermExpansion& expansion,
                           const Eigen::Matrix3d& rotation) {
  Point& sums = points_[point];
  const Eigen::Vector3d basis = disparity_field_basis(rig_, term.seen.x());
  const Eigen::Vector3d weighted = expansion.disparity_weight() * basis;
  sums.information.noalias() += weighted * basis.transpose();
  sums.gradient += expansion.weighted_error().z() * basis;
  sums.coupling.noalias() += (expansion.disparity_by_depth() * weighted) * rotation.row(2);
}

void FieldBorder::set_link(std::size_t link, const BundleTerm& term, const TermExpansion& expansion) {
  link_rows_[link] = expansion.disparity_weight() * expansion.disparity_by_depth() *
                     disparity_field_basis(rig_, term.seen.x());
}

/// The depth of p = exp(w) p + v changes by p.y w.x - p.x w.y + v.z.
void FieldBorder::add_link(std::size_t link, const Eigen::Vector3d& point_in_camera,
                           CameraBlock& block) const {
  const auto row = link_rows_[link].transpose();
  block.row(0) += point_in_camera.y() * row;
  block.row(1) -= point_in_camera.x() * row;
  block.row(5) += row;
}

void FieldBorder::set_camera(std::size_t free, const CameraBlock& block) {
  cameras_.middleRows<6>(6 * static_cast<Eigen::Index>(free)) = block;
}

void FieldBorder::sum_points(const DisparityField& field, double lambda) {
  information_ = prior_information_ * Eigen::Matrix3d::Identity();
  right_ = -prior_information_ * field;
  Eigen::Matrix3d eliminated = Eigen::Matrix3d::Zero();
  for (const Point& point : points_) {
    information_ += point.information;
    right_ -= point.gradient;
    eliminated.noalias() += point.coupling * point.coupling.transpose();
  }
  information_.diagonal() *= 1.0 + lambda;
  information_ -= eliminated;
}

bool FieldBorder::solve(const Eigen::VectorXd& solved_right, const Eigen::MatrixX3d& solved_cameras) {
  remainder_ = information_ - cameras_.transpose() * solved_cameras;
  const Eigen::LLT<Eigen::Matrix3d> factor(remainder_);
  if (factor.info() != Eigen::Success) return false;
  step_ = factor.solve(right_ - cameras_.transpose() * solved_right);
  return step_.allFinite();
}

Eigen::Matrix3d FieldBorder::covariance() const {
  return as_covariance(remainder_.llt().solve(Eigen::Matrix3d::Identity()));
}

}  // namespace cairn
