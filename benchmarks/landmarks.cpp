// SPDX-License-Identifier: Apache-2.0
#include "landmarks.h"

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>

#include <Eigen/LU>
#include <algorithm>
#include <memory>

#include "cairn/testing/optimize/landmark_scene.h"

namespace cairn::bench {
namespace {

using testkit::LandmarkScene;
using testkit::LandmarkSceneOptions;
using testkit::make_landmark_scene;

/// 11.5 observations each, half a pixel of noise; nothing is dropped, so that all solve one problem.
const LandmarkSceneOptions kStreet{.landmarks = 1000, .shortest_track = 3, .longest_track = 20};
constexpr LandmarkFitOptions kKeepAll{.max_error = 1e3};
/// The peers' tolerances: the loosest powers of ten with which they come to a millionth of a metre.
constexpr double kCeresFunctionTolerance = 1e-13, kTinyFunctionTolerance = 1e-8, kParameterTolerance = 1e-9;

struct Solution {
  Eigen::Vector3d point_in_world;
  Eigen::Matrix3d covariance;
};

/// The peers' camera: pixels of a point in the world.
struct Projection {
  Rig rig;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
};

std::vector<Projection> projections_of(const LandmarkScene& scene) {
  std::vector<Projection> projections;
  for (const CameraFromWorld& camera : scene.cameras)
    projections.push_back({scene.rig, camera.matrix3(), camera.translation});
  return projections;
}

/// The peers' initial value: where the last and nearest camera saw the landmark, by its disparity.
Eigen::Vector3d start_of(const LandmarkScene& scene, const std::vector<CameraObservation>& track) {
  const auto& [camera, seen] = track.back();
  return scene.cameras[static_cast<std::size_t>(camera)].inverse() *
         scene.rig.point_at(seen.u, seen.v, scene.rig.depth(seen.d));
}

std::vector<Solution> solve_by_cairn(const LandmarkScene& scene) {
  LandmarkSolver solver(scene.rig, scene.cameras, kKeepAll);
  LandmarkFit fit;
  std::vector<Solution> solutions;
  solutions.reserve(scene.tracks.size());
  for (const auto& track : scene.tracks) {
    solver.fit(track, fit);
    solutions.push_back({fit.point_in_world, fit.covariance});
  }
  return solutions;
}

class CeresCost : public ceres::SizedCostFunction<3, 3> {
 public:
  CeresCost(const Projection& camera, const Observation& seen) : camera_(camera), seen_(seen) {}

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Eigen::Vector3d in_camera =
        camera_.rotation * Eigen::Map<const Eigen::Vector3d>(blocks[0]) + camera_.translation;
    const Eigen::Vector3d whitening(1 / seen_.sigma_px, 1 / seen_.sigma_px, 1 / seen_.sigma_d_px);
    Eigen::Map<Eigen::Vector3d>{residual} =
        whitening.cwiseProduct(camera_.rig.project(in_camera) - Eigen::Vector3d(seen_.u, seen_.v, seen_.d));
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{jacobians[0]} =
          whitening.asDiagonal() * camera_.rig.projection_jacobian(in_camera) * camera_.rotation;
    return true;
  }

 private:
  const Projection& camera_;
  const Observation& seen_;
};

Solution solve_by_ceres(const LandmarkScene& scene, const std::vector<Projection>& cameras,
                        const std::vector<CameraObservation>& track) {
  Solution solution{start_of(scene, track), {}};
  double* point = solution.point_in_world.data();
  ceres::Problem problem;
  for (const auto& [camera, seen] : track)
    problem.AddResidualBlock(new CeresCost(cameras[static_cast<std::size_t>(camera)], seen), nullptr, point);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = kCeresFunctionTolerance;
  options.parameter_tolerance = kParameterTolerance;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  ceres::Covariance::Options covariance_options;
  covariance_options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(covariance_options);
  if (covariance.Compute(std::vector<const double*>{point}, &problem))
    covariance.GetCovarianceBlock(point, point, solution.covariance.data());
  return solution;
}

/// Residuals of a whole track, as TinySolverAutoDiffFunction wants them.
struct TinyResiduals {
  const std::vector<Projection>& cameras;
  const std::vector<CameraObservation>& track;

  [[nodiscard]] int NumResiduals() const {  // NOLINT(readability-identifier-naming): Ceres' name
    return 3 * static_cast<int>(track.size());
  }
  template <class T>
  bool operator()(const T* point, T* residuals) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    for (const auto& [index, seen] : track) {
      const Projection& camera = cameras[static_cast<std::size_t>(index)];
      const Vector p = camera.rotation * Eigen::Map<const Vector>(point) + camera.translation;
      const T inverse_depth = 1.0 / p.z();
      *residuals++ = (camera.rig.fx * p.x() * inverse_depth + camera.rig.cx - seen.u) / seen.sigma_px;
      *residuals++ = (camera.rig.fy * p.y() * inverse_depth + camera.rig.cy - seen.v) / seen.sigma_px;
      *residuals++ = (camera.rig.fx * camera.rig.baseline * inverse_depth - seen.d) / seen.sigma_d_px;
    }
    return true;
  }
};

using TinyFunction = ceres::TinySolverAutoDiffFunction<TinyResiduals, Eigen::Dynamic, 3>;

/// Memory is used again from landmark to landmark.
class TinyPeer {
 public:
  TinyPeer() {
    solver_.options.function_tolerance = kTinyFunctionTolerance;
    solver_.options.parameter_tolerance = kParameterTolerance;
  }

  Solution solve(const LandmarkScene& scene, const std::vector<Projection>& cameras,
                 const std::vector<CameraObservation>& track) {
    const TinyResiduals residuals{cameras, track};
    const TinyFunction function(residuals);
    Solution solution{start_of(scene, track), {}};
    solver_.Solve(function, &solution.point_in_world);
    errors_.resize(residuals.NumResiduals());
    jacobian_.resize(residuals.NumResiduals(), 3);
    function(solution.point_in_world.data(), errors_.data(), jacobian_.data());
    solution.covariance = (jacobian_.transpose() * jacobian_).inverse();
    return solution;
  }

 private:
  ceres::TinySolver<TinyFunction> solver_;
  Eigen::VectorXd errors_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> jacobian_;
};

std::vector<Solution> solve_all_by_ceres(const LandmarkScene& scene) {
  const std::vector<Projection> cameras = projections_of(scene);
  std::vector<Solution> solutions;
  for (const auto& track : scene.tracks) solutions.push_back(solve_by_ceres(scene, cameras, track));
  return solutions;
}

std::vector<Solution> solve_all_by_tiny(const LandmarkScene& scene) {
  const std::vector<Projection> cameras = projections_of(scene);
  TinyPeer peer;
  std::vector<Solution> solutions;
  for (const auto& track : scene.tracks) solutions.push_back(peer.solve(scene, cameras, track));
  return solutions;
}

void add(Comparisons& comparisons, const std::shared_ptr<const LandmarkScene>& scene, const std::string& peer,
         std::vector<Solution> (*theirs)(const LandmarkScene&), double at_most_share) {
  comparisons.timed.push_back({"1000 landmarks of 11.5 observations beside " + peer,
                               1,
                               [scene] { (void)solve_by_cairn(*scene); },
                               [scene, theirs] { (void)theirs(*scene); },
                               at_most_share,
                               {}});
  const std::vector<Solution> a = solve_by_cairn(*scene), b = theirs(*scene);
  double distance = 0, covariance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(distance, (a[i].point_in_world - b[i].point_in_world).norm());
    covariance = std::max(covariance, (a[i].covariance - b[i].covariance).norm() / b[i].covariance.norm());
  }
  comparisons.quality.push_back(
      {"landmarks: largest distance from those of " + peer + ", metres", distance, 0, {}, 1e-6});
  comparisons.quality.push_back(
      {"landmarks: largest relative difference of covariances, " + peer, covariance, 0, {}, 1e-4});
}

}  // namespace

void add_landmarks(Comparisons& comparisons) {
  constexpr double kCeresShare = 1.0 / 20, kTinyShare = 1.0 / 4;
  const auto scene = std::make_shared<const LandmarkScene>(make_landmark_scene(1, kStreet));
  add(comparisons, scene, "one Ceres problem each", solve_all_by_ceres, kCeresShare);
  add(comparisons, scene, "ceres::TinySolver", solve_all_by_tiny, kTinyShare);
}

}  // namespace cairn::bench
