// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/two_view_choice.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/geometry/decompositions.h"
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

/// A model in GRIC's terms: dimension d of what it leaves free for a pair, number k of parameters.
struct Candidate {
  const Eigen::Matrix3d* matrix;  ///< may be null
  ErrorOfPair error;
  int dimension, parameters;

  [[nodiscard]] double limit() const { return 2.0 * (4 - dimension); }
  [[nodiscard]] double squared_error(const Pairs& pairs, std::size_t i) const {
    return error(*matrix, pairs.a[i], pairs.b[i]) / (pairs.sigma * pairs.sigma);
  }
  [[nodiscard]] bool explains(const Pairs& pairs, std::size_t i) const {
    return matrix != nullptr && squared_error(pairs, i) < limit();
  }
};

double gric(const Pairs& pairs, std::span<const std::int32_t> explained, const Candidate& model) {
  if (model.matrix == nullptr) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(explained.size());
  double sum = 0;
  for (const std::int32_t i : explained)
    sum += std::min(model.limit(), model.squared_error(pairs, static_cast<std::size_t>(i)));
  return sum + n * model.dimension * std::log(4) + model.parameters * std::log(4 * n);
}

std::vector<std::int32_t> explained_by(const Pairs& pairs, std::span<const Candidate> models) {
  std::vector<std::int32_t> explained;
  for (std::size_t i = 0; i < pairs.a.size(); ++i)
    if (std::any_of(models.begin(), models.end(), [&](const Candidate& m) { return m.explains(pairs, i); }))
      explained.push_back(static_cast<std::int32_t>(i));
  return explained;
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
  const Svd3 svd = svd_of(sum);
  Eigen::Vector3d sign(1, 1, 1);
  if (svd.u.determinant() * svd.v.determinant() < 0) sign.z() = -1;
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.u * sign.asDiagonal() * svd.v.transpose())).normalized();
}

ModelChoice choose_model(Points a, Points b, double sigma, const Eigen::Matrix3d* essential,
                         const Eigen::Matrix3d* homography) {
  require(a.size() == b.size() && sigma > 0, "points of two views correspond by position");
  const Pairs pairs{a, b, sigma};
  std::array<Candidate, 3> models{Candidate{essential, sampson_error, 3, 5},
                                  Candidate{homography, homography_sampson_error, 2, 8},
                                  Candidate{nullptr, homography_sampson_error, 2, 3}};
  Eigen::Matrix3d turn;
  if (homography != nullptr) {
    turn = fit_rotation(a, b, explained_by(pairs, std::span(models).subspan(1, 1))).toRotationMatrix();
    models[2].matrix = &turn;
  }
  const std::vector<std::int32_t> explained = explained_by(pairs, models);
  ModelChoice choice;
  choice.pairs = explained.size();
  for (std::size_t i = 0; i < models.size(); ++i) choice.gric[i] = gric(pairs, explained, models[i]);
  const auto least = std::min_element(choice.gric.begin(), choice.gric.end());
  choice.model = static_cast<TwoViewModel>(least - choice.gric.begin());
  return choice;
}

}  // namespace cairn
