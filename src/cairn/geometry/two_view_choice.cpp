// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/two_view_choice.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/geometry/essential.h"
#include "cairn/geometry/homography.h"

namespace cairn {
namespace {

using Points = std::span<const Eigen::Vector2d>;
using ErrorOfPair = double (*)(const Eigen::Matrix3d&, const Eigen::Vector2d&, const Eigen::Vector2d&);

/// Two views with the standard deviation of their points.
struct Pairs {
  Points a, b;
  double sigma;
};

double gric(const Pairs& pairs, const Eigen::Matrix3d& model, ErrorOfPair error, int dimension,
            int parameters) {
  constexpr int kDataDimension = 4;
  const double limit = 2.0 * (kDataDimension - dimension), n = static_cast<double>(pairs.a.size());
  double sum = 0;
  for (std::size_t i = 0; i < pairs.a.size(); ++i)
    sum += std::min(limit, error(model, pairs.a[i], pairs.b[i]) / (pairs.sigma * pairs.sigma));
  return sum + n * dimension * std::log(kDataDimension) + parameters * std::log(kDataDimension * n);
}

/// Those that the homography explains within GRIC's limit: what a rotation has to explain.
std::vector<std::int32_t> inliers_of(const Pairs& pairs, const Eigen::Matrix3d& H) {
  constexpr double kLimit = 4;
  std::vector<std::int32_t> inliers;
  for (std::size_t i = 0; i < pairs.a.size(); ++i)
    if (homography_sampson_error(H, pairs.a[i], pairs.b[i]) < kLimit * pairs.sigma * pairs.sigma)
      inliers.push_back(static_cast<std::int32_t>(i));
  return inliers;
}

}  // namespace

std::string_view to_string(TwoViewModel model) {
  switch (model) {
    case TwoViewModel::homography:
      return "homography";
    case TwoViewModel::rotation:
      return "rotation";
    case TwoViewModel::essential:
      break;
  }
  return "essential";
}

Eigen::Quaterniond fit_rotation(Points a, Points b, std::span<const std::int32_t> used) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const std::int32_t index : used) {
    const auto i = static_cast<std::size_t>(index);
    sum += b[i].homogeneous().normalized() * a[i].homogeneous().normalized().transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, 1);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign.z() = -1;
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose()))
      .normalized();
}

ModelChoice choose_model(Points a, Points b, double sigma, const Eigen::Matrix3d* essential,
                         const Eigen::Matrix3d* homography) {
  require(a.size() == b.size() && sigma > 0, "points of two views correspond by position");
  const Pairs pairs{a, b, sigma};
  ModelChoice choice;
  choice.gric.fill(std::numeric_limits<double>::infinity());
  if (essential != nullptr) choice.gric[0] = gric(pairs, *essential, sampson_error, 3, 5);
  if (homography != nullptr) {
    choice.gric[1] = gric(pairs, *homography, homography_sampson_error, 2, 8);
    const Eigen::Matrix3d turn = fit_rotation(a, b, inliers_of(pairs, *homography)).toRotationMatrix();
    choice.gric[2] = gric(pairs, turn, homography_sampson_error, 2, 3);
  }
  const auto least = std::min_element(choice.gric.begin(), choice.gric.end());
  choice.model = static_cast<TwoViewModel>(least - choice.gric.begin());
  return choice;
}

}  // namespace cairn
