// SPDX-License-Identifier: Apache-2.0
#include "geometry.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/geometry/essential_ransac.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/geometry/pnp_ransac.h"

namespace cairn::bench {
namespace {

constexpr int kProblems = 500;
constexpr std::size_t kTimed = 25;  ///< of these, so that eleven repetitions take seconds
constexpr int kPoints = 200;
constexpr double kFocal = 525, kCx = 319.5, kCy = 239.5;
constexpr double kSigmaPx = 0.5;
constexpr double kConfidence = 0.99;
constexpr int kMaxIterations = 1000;

/// A camera that moves by about a fifth of the distance of what it sees: points and their pixels in both
/// views, Gaussian noise, half of them anywhere in the second image.
struct Problem {
  Rigid3 b_from_a;
  std::vector<Eigen::Vector3d> points_in_a;
  std::vector<Eigen::Vector2d> pixels_a, pixels_b;
};

bool in_image(const Eigen::Vector2d& p) {
  return p.x() >= 0 && p.x() <= 639 && p.y() >= 0 && p.y() <= 479;
}

Eigen::Vector2d project(const Eigen::Vector3d& point) {
  return {kFocal * point.x() / point.z() + kCx, kFocal * point.y() / point.z() + kCy};
}

Problem make_problem(std::uint64_t seed, double outlier_share) {
  Random random(seed);
  const auto vector = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  Problem problem;
  problem.b_from_a = {rotation_exp(0.15 * vector()), vector().normalized() * random.uniform(0.6, 1.4)};
  const int outliers = static_cast<int>(outlier_share * kPoints);
  while (static_cast<int>(problem.points_in_a.size()) < kPoints) {
    const double depth = random.uniform(2, 8);
    const Eigen::Vector2d pixel(random.uniform(0, 639), random.uniform(0, 479));
    const Eigen::Vector3d in_a((pixel.x() - kCx) / kFocal * depth, (pixel.y() - kCy) / kFocal * depth, depth);
    const Eigen::Vector3d in_b = problem.b_from_a * in_a;
    if (in_b.z() < 0.5 || !in_image(project(in_b))) continue;
    const auto noise = [&] {
      return Eigen::Vector2d(kSigmaPx * random.normal(), kSigmaPx * random.normal());
    };
    const bool outlier = static_cast<int>(problem.points_in_a.size()) < outliers;
    const Eigen::Vector2d anywhere(random.uniform(0, 639), random.uniform(0, 479));
    problem.points_in_a.push_back(in_a);
    problem.pixels_a.emplace_back(pixel + noise());
    problem.pixels_b.emplace_back(outlier ? anywhere : Eigen::Vector2d(project(in_b) + noise()));
  }
  return problem;
}

using Problems = std::vector<Problem>;

std::shared_ptr<const Problems> make_problems(double outlier_share) {
  auto problems = std::make_shared<Problems>();
  for (std::uint64_t i = 0; i < kProblems; ++i) problems->push_back(make_problem(i, outlier_share));
  return problems;
}

/// The relative errors of Lepetit, Moreno-Noguer, Fua 2009, sec. 5.1: |q - q_true| / |q_true| of the unit
/// quaternions and |t - t_true| / |t_true|, both at most 1 %.
bool is_right(const Rigid3& estimate, const Rigid3& truth) {
  constexpr double kMaxRelative = 0.01;
  const Eigen::Vector4d q = estimate.rotation.coeffs(), q_true = truth.rotation.coeffs();
  const double rotation = std::min((q - q_true).norm(), (q + q_true).norm());
  const double translation = (estimate.translation - truth.translation).norm() / truth.translation.norm();
  return rotation <= kMaxRelative && translation <= kMaxRelative;
}

/// The limit of an inlier's distance, the same for both: the root of the 95 % quantile times sigma.
const double kPnpLimitPx = std::sqrt(kInlierLimit2) * kSigmaPx;
const double kEssentialLimitPx = std::sqrt(kInlierLimit1) * kSigmaPx;

RansacOptions options_of(std::size_t item) {
  return {.max_iterations = kMaxIterations, .confidence = kConfidence, .item = item};
}

Rigid3 our_pose(const Problem& problem, std::size_t item) {
  constexpr double kUnusedBaseline = 1;
  const Rig rig{kFocal, kFocal, kCx, kCy, kUnusedBaseline};
  std::vector<Observation> seen;
  for (const auto& pixel : problem.pixels_b) {
    seen.push_back({pixel.x(), pixel.y()});
    seen.back().sigma_px = kSigmaPx;
  }
  return solve_pnp_ransac(rig, problem.points_in_a, seen, options_of(item)).camera_from_world;
}

cv::Mat camera_matrix() {
  return (cv::Mat_<double>(3, 3) << kFocal, 0, kCx, 0, kFocal, kCy, 0, 0, 1);
}

std::vector<cv::Point2d> to_opencv(const std::vector<Eigen::Vector2d>& points) {
  std::vector<cv::Point2d> result;
  for (const auto& point : points) result.emplace_back(point.x(), point.y());
  return result;
}

Rigid3 peers_pose(const Problem& problem, int method) {
  std::vector<cv::Point3d> points;
  for (const auto& point : problem.points_in_a) points.emplace_back(point.x(), point.y(), point.z());
  cv::Mat rotation, translation;
  const bool found = cv::solvePnPRansac(points, to_opencv(problem.pixels_b), camera_matrix(), cv::noArray(),
                                        rotation, translation, false, kMaxIterations,
                                        static_cast<float>(kPnpLimitPx), kConfidence, cv::noArray(), method);
  if (!found) return {};
  const auto vector = [](const cv::Mat& m) {
    return Eigen::Vector3d(m.at<double>(0), m.at<double>(1), m.at<double>(2));
  };
  return {rotation_exp(vector(rotation)), vector(translation)};
}

std::vector<Eigen::Vector2d> rays_of(const std::vector<Eigen::Vector2d>& pixels) {
  std::vector<Eigen::Vector2d> rays;
  for (const auto& pixel : pixels) rays.emplace_back((pixel.x() - kCx) / kFocal, (pixel.y() - kCy) / kFocal);
  return rays;
}

Eigen::Matrix3d our_essential(const Problem& problem, std::size_t item) {
  return find_essential(rays_of(problem.pixels_a), rays_of(problem.pixels_b), kSigmaPx / kFocal,
                        options_of(item))
      .model;
}

/// OpenCV compares the squared Sampson error, too, with the squared limit. Its version 4.6 has no argument
/// for the number of iterations in this overload: it is 1000, as ours.
Eigen::Matrix3d peers_essential(const Problem& problem, int method) {
  const cv::Mat found = cv::findEssentialMat(to_opencv(problem.pixels_a), to_opencv(problem.pixels_b),
                                             camera_matrix(), method, kConfidence, kEssentialLimitPx);
  Eigen::Matrix3d essential = Eigen::Matrix3d::Zero();
  if (found.rows < 3) return essential;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) essential(i, j) = found.at<double>(i, j);
  return essential;
}

/// One of the four motions is right; their choice is not what is compared.
bool is_right(const Eigen::Matrix3d& essential, const Rigid3& truth) {
  const Rigid3 unit{truth.rotation, truth.translation.normalized()};
  for (Rigid3 motion : decompose_essential(essential).candidates()) {
    motion.translation.normalize();
    if (is_right(motion, unit)) return true;
  }
  return false;
}

template <class Solve>
double count_right(const Problems& problems, const Solve& solve) {
  double right = 0;
  for (std::size_t i = 0; i < problems.size(); ++i)
    right += is_right(solve(problems[i], i), problems[i].b_from_a) ? 1 : 0;
  return right;
}

/// Time of the first problems and number of right results of both.
template <class Ours, class Peers>
void add(Comparisons& comparisons, const std::string& work, const std::shared_ptr<const Problems>& problems,
         const Ours& ours, const Peers& peers) {
  const auto all = [problems](const auto& solve) {
    return [problems, solve] {
      for (std::size_t i = 0; i < kTimed; ++i) (void)solve((*problems)[i], i);
    };
  };
  comparisons.timed.push_back(
      {fmt::format("{} problems: {}", kTimed, work), 1, all(ours), all(peers), 1.0, {}});
  comparisons.quality.push_back({fmt::format("right within 1 % of {}: {}", kProblems, work),
                                 count_right(*problems, ours),
                                 count_right(*problems, peers),
                                 1.0,
                                 {}});
}

}  // namespace

void add_geometry(Comparisons& comparisons) {
  for (const double share : {0.2, 0.5}) {
    const auto problems = make_problems(share);
    const std::string outliers = fmt::format("{} points, {:.0f} % wrong", kPoints, 100 * share);
    const auto peers_pnp = [](int method) {
      return [method](const Problem& problem, std::size_t) { return peers_pose(problem, method); };
    };
    const auto peers_five_point = [](int method) {
      return [method](const Problem& problem, std::size_t) { return peers_essential(problem, method); };
    };
    add(comparisons, "solvePnPRansac, EPnP, " + outliers, problems, our_pose,
        peers_pnp(cv::SOLVEPNP_ITERATIVE));
    add(comparisons, "solvePnPRansac, P3P, " + outliers, problems, our_pose, peers_pnp(cv::SOLVEPNP_P3P));
    add(comparisons, "findEssentialMat, RANSAC, " + outliers, problems, our_essential,
        peers_five_point(cv::RANSAC));
    add(comparisons, "findEssentialMat, USAC_ACCURATE, " + outliers, problems, our_essential,
        peers_five_point(cv::USAC_ACCURATE));
  }
}

}  // namespace cairn::bench
