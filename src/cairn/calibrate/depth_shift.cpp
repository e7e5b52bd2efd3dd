// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/depth_shift.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/image/image.h"
#include "cairn/map/map.h"
#include "cairn/optimize/landmark_fit.h"
#include "cairn/sequence/pose_path.h"
#include "cairn/slam/window.h"

namespace cairn {
namespace {

using Terms = Eigen::Matrix<double, 5, 1>;  // du, dv, dt, a, b
using TermMatrix = Eigen::Matrix<double, 5, 5>;

/// Holds one observation: its error of inverse depth and the derivatives by the terms.
struct Reading {
  double error = 0, sigma = 0;  // 1/m
  Terms slopes = Terms::Zero();
  int keyframe = 0;
};

/// Holds the plane of the inverse depths around a pixel.
struct DepthPlane {
  double value;           ///< at the pixel, 1/m
  Eigen::Vector2d slope;  ///< by columns and rows, 1/m per pixel
};

/// Fits the plane of inverse depths around a pixel. Returns nullopt where depths are missing or not smooth.
std::optional<DepthPlane> plane_at(const DepthImage& depth, double u, double v) {
  constexpr int kRadius = 5, kFewest = 100;  // of 121 pixels
  constexpr double kLargestShare = 0.02;     // of the value, RMS
  const int column = static_cast<int>(std::lround(u)), row = static_cast<int>(std::lround(v));
  if (column < kRadius || row < kRadius || column + kRadius >= depth.width() ||
      row + kRadius >= depth.height())
    return std::nullopt;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  int count = 0;
  for (int y = row - kRadius; y <= row + kRadius; ++y) {
    for (int x = column - kRadius; x <= column + kRadius; ++x) {
      const double z = static_cast<double>(depth(x, y));
      if (!(z > 0)) continue;
      const Eigen::Vector3d basis(1, x - u, y - v);
      normal += basis * basis.transpose();
      right += basis / z;
      squares += 1 / (z * z);
      ++count;
    }
  }
  if (count < kFewest) return std::nullopt;
  const Eigen::Vector3d plane = normal.ldlt().solve(right);
  const double rms = std::sqrt(std::max(0.0, squares - plane.dot(right)) / count);
  if (!(plane[0] > 0) || rms > kLargestShare * plane[0]) return std::nullopt;
  return DepthPlane{plane[0], plane.tail<2>()};
}

/// Holds a landmark that was intersected from its pixels alone.
struct Intersection {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  bool is_known = false;
};

/// Holds keyframes and landmarks as the pixels alone place them.
struct PixelMap {
  std::vector<std::optional<Rigid3>> camera_from_world;  ///< by keyframe; none: of another component
  std::vector<Intersection> points;                      ///< by landmark
};

/// Adjusts the component of a run once more with disparities that hold little but the scale: poses that
/// follow shifted depths would hide a part of the shift.
Window adjust_by_pixels(const SlamResult& slam, const Executor& executor) {
  constexpr double kLess = 200;  // times the standard deviations of disparities
  Window window = whole_component(slam.map, slam.main_component());
  for (BundleObservation& observation : window.problem.observations) observation.seen.sigma_d_px *= kLess;
  BundleOptions options;
  options.max_iterations = 100;
  options.converged_relative_cost = 1e-6;
  (void)adjust_bundle(window.problem, options, executor);
  return window;
}

/// Intersects the landmarks of a map from their pixels in at least four keyframes.
PixelMap place_by_pixels(const SlamResult& slam, const Executor& executor) {
  const Map& map = slam.map;
  const Window window = adjust_by_pixels(slam, executor);
  PixelMap result;
  result.camera_from_world.resize(map.keyframes().size());
  result.points.resize(map.landmarks().size());
  std::vector<CameraFromWorld> cameras(map.keyframes().size());
  for (std::size_t i = 0; i < window.cameras.size(); ++i) {
    const std::size_t keyframe = window.cameras[i].index();
    result.camera_from_world[keyframe] = window.problem.camera_from_world[i];
    cameras[keyframe] = CameraFromWorld(window.problem.camera_from_world[i]);
  }
  LandmarkFitOptions options;
  options.min_observations = 4;
  LandmarkSolver solver(map.rig(), cameras, options);
  std::vector<CameraObservation> views;
  LandmarkFit fit;
  for (const LandmarkId id : window.points) {
    views.clear();
    for (const ObservationRef& ref : map[id].observations) {
      if (!result.camera_from_world[ref.keyframe.index()]) continue;
      const auto& observations = map[ref.keyframe].observed.observations;
      views.push_back(
          {ref.keyframe.value, without_disparity(observations[static_cast<std::size_t>(ref.feature)])});
    }
    if (static_cast<int>(views.size()) < options.min_observations) continue;
    solver.fit(views, fit);
    if (fit.status == LandmarkFitStatus::ok)
      result.points[id.index()] = {fit.point_in_world, fit.covariance, true};
  }
  return result;
}

/// Reads the depth images of keyframes at their landmarks.
class ShiftReader {
 public:
  ShiftReader(const Sequence& sequence, const SlamResult& slam, const Executor& executor)
      : loader_(sequence),
        camera_(sequence.calibration.camera),
        map_(slam.map),
        placed_(place_by_pixels(slam, executor)) {
    std::vector<SubjectPose> poses;
    for (const StampedPose& pose : slam.trajectory())
      poses.push_back({pose.stamp_ns, pose.world_from_camera});
    constexpr double kLargestGap = 0.25;  // seconds
    path_ = PosePath(std::move(poses), kLargestGap);
  }

  [[nodiscard]] std::vector<Reading> read(const Keyframe& keyframe) const {
    std::vector<Reading> readings;
    const bool is_placed = placed_.camera_from_world[keyframe.id.index()].has_value();
    if (!is_placed || !keyframe.observed.frame.valid()) return readings;
    try {
      const DepthImage depth = loader_.load_depth(keyframe.observed.frame);
      if (depth.empty()) return readings;
      for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i)
        if (const auto reading = read(keyframe, i, depth)) readings.push_back(*reading);
    } catch (const InputError&) {
      readings.clear();
    }
    return readings;
  }

 private:
  [[nodiscard]] std::optional<Reading> read(const Keyframe& keyframe, std::size_t feature,
                                            const DepthImage& depth) const {
    constexpr double kLargestSigma = 0.02;  // of the inverse depth, a share
    const LandmarkId id = keyframe.landmarks[feature];
    if (!id.valid() || !placed_.points[id.index()].is_known) return std::nullopt;
    const Intersection& point = placed_.points[id.index()];
    const Observation& seen = keyframe.observed.observations[feature];
    if (!seen.has_disparity()) return std::nullopt;
    const auto pixel = camera_.project(map_.rig().point_at(seen.u, seen.v, 1));  // seen is undistorted
    const auto plane = pixel ? plane_at(depth, pixel->x(), pixel->y()) : std::nullopt;
    const Rigid3& camera_from_world = *placed_.camera_from_world[keyframe.id.index()];
    const Eigen::Vector3d in_camera = camera_from_world * point.point;
    if (!plane || !(in_camera.z() > 0)) return std::nullopt;
    const double r = 1 / in_camera.z();
    const Eigen::Vector3d axis = camera_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    const double sigma_share = r * std::sqrt(std::max(0.0, axis.dot(point.covariance * axis)));
    const auto by_time = derivative_by_time(keyframe, point.point);
    if (!by_time || sigma_share > kLargestSigma) return std::nullopt;
    Reading reading;
    reading.error = plane->value - r;
    reading.sigma = std::hypot(sigma_share * r, seen.sigma_d_px / (map_.rig().fx * map_.rig().baseline));
    reading.slopes << plane->slope.x(), plane->slope.y(), by_time->z() - plane->slope.dot(by_time->head<2>()),
        1, r;
    reading.keyframe = keyframe.id.value;
    return reading;
  }

  /// Computes the pixel and the inverse depth of a point at the stamp of a keyframe plus some seconds.
  [[nodiscard]] std::optional<Eigen::Vector3d> seen_at(std::int64_t stamp_ns, double later_s,
                                                       const Eigen::Vector3d& point) const {
    const auto pose = path_.at(stamp_ns, -later_s);
    if (!pose) return std::nullopt;
    const Eigen::Vector3d in_camera = pose->inverse() * point;
    if (!(in_camera.z() > 0)) return std::nullopt;
    const Eigen::Vector3d pixel = map_.rig().project(in_camera);
    return Eigen::Vector3d(pixel.x(), pixel.y(), 1 / in_camera.z());
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> derivative_by_time(const Keyframe& keyframe,
                                                                  const Eigen::Vector3d& point) const {
    constexpr double kStep = 0.02;  // seconds
    const std::int64_t stamp = keyframe.observed.stamp_ns;
    const auto later = seen_at(stamp, kStep, point), earlier = seen_at(stamp, -kStep, point);
    if (!later || !earlier) return std::nullopt;
    return Eigen::Vector3d((*later - *earlier) / (2 * kStep));
  }

  FrameLoader loader_;
  Camera camera_;
  const Map& map_;
  PixelMap placed_;
  PosePath path_;
};

double error_left(const Reading& reading, const Terms& terms) {
  return (reading.error - reading.slopes.dot(terms)) / reading.sigma;
}

/// Holds the terms and the inverse of their normal equations, with the scale of Cauchy's weights.
struct ShiftFit {
  Terms value = Terms::Zero();
  TermMatrix inverse = TermMatrix::Identity();
  double scale = 1;
};

ShiftFit fit_shift(std::span<const Reading> readings) {
  constexpr int kRounds = 20;
  constexpr double kTuning = 2.385;
  const Terms prior =
      (Terms() << 20, 20, 0.2, 0.1, 0.2).finished();  // standard deviations: px, s, 1/m, share
  ShiftFit fit;
  for (int round = 0; round < kRounds && !readings.empty(); ++round) {
    std::vector<double> sizes;
    for (const Reading& reading : readings) sizes.push_back(std::abs(error_left(reading, fit.value)));
    fit.scale = kTuning * std::max(kSigmaPerMedian * median(std::move(sizes)), 1e-3);
    TermMatrix normal = prior.array().square().inverse().matrix().asDiagonal();
    Terms right = Terms::Zero();
    for (const Reading& reading : readings) {
      const double left = error_left(reading, fit.value) / fit.scale;
      const double weight = 1 / ((1 + left * left) * reading.sigma * reading.sigma);
      normal += weight * reading.slopes * reading.slopes.transpose();
      right += weight * reading.error * reading.slopes;
    }
    fit.inverse = normal.ldlt().solve(TermMatrix::Identity());
    fit.value = fit.inverse * right;
  }
  return fit;
}

/// Computes the standard deviations of a fit whose readings of one keyframe may err alike (Liang and Zeger
/// 1986).
Terms clustered_sigma(std::span<const Reading> readings, const ShiftFit& fit) {
  TermMatrix spread = TermMatrix::Zero();
  for (std::size_t i = 0; i < readings.size();) {
    Terms sum = Terms::Zero();
    const int keyframe = readings[i].keyframe;
    for (; i < readings.size() && readings[i].keyframe == keyframe; ++i) {
      const double left = error_left(readings[i], fit.value), share = left / fit.scale;
      sum += left / ((1 + share * share) * readings[i].sigma) * readings[i].slopes;
    }
    spread += sum * sum.transpose();
  }
  return (fit.inverse * spread * fit.inverse).diagonal().cwiseMax(0).cwiseSqrt();
}

/// Computes the standard deviations of the mean of the fits of the four quarters of the readings.
Terms sigma_by_quarters(std::span<const Reading> readings) {
  constexpr std::size_t kParts = 4;
  Eigen::Matrix<double, 5, kParts> values;
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t begin = k * readings.size() / kParts, end = (k + 1) * readings.size() / kParts;
    values.col(static_cast<Eigen::Index>(k)) = fit_shift(readings.subspan(begin, end - begin)).value;
  }
  const Terms mean = values.rowwise().mean();
  return ((values.colwise() - mean).rowwise().squaredNorm() / (kParts * (kParts - 1.0))).cwiseSqrt();
}

void judge(DepthShift& found) {
  constexpr double kSigmas = 3;
  const Eigen::Vector3d largest_sigma(0.5, 0.5, 0.005), least(1, 1, 0.003);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double size = std::abs(found.value[i]);
    if (!(found.sigma[i] <= largest_sigma[i])) {
      found.findings[k] = Finding::undetermined;
      found.why[k] = fmt::format(
          "known to {0:.3g} {2} only, and {1:g} {2} is needed: too few surfaces slope, or the camera "
          "moves too little",
          found.sigma[i], largest_sigma[i], i < 2 ? "px" : "s");
    } else {
      found.findings[k] =
          size > kSigmas * found.sigma[i] && size > least[i] ? Finding::off : Finding::as_stated;
    }
  }
}

}  // namespace

DepthShift measure_depth_shift(const Sequence& sequence, const SlamResult& slam, const Executor& executor) {
  constexpr std::size_t kFewest = 300;
  DepthShift found;
  const ShiftReader reader(sequence, slam, executor);
  const std::vector<Keyframe>& keyframes = slam.map.keyframes();
  const auto of_keyframes = executor.map<std::vector<Reading>>(
      keyframes.size(), [&](std::size_t k) { return reader.read(keyframes[k]); });
  std::vector<Reading> readings;
  for (const auto& some : of_keyframes) readings.insert(readings.end(), some.begin(), some.end());
  found.readings = static_cast<int>(readings.size());
  if (readings.size() < kFewest) {
    found.why.fill(
        fmt::format("{} observations of known points with a smooth depth are too few", readings.size()));
    found.sigma << 20, 20, 0.2;
    return found;
  }
  const std::span<const Reading> all = readings;
  const ShiftFit fit = fit_shift(all);
  found.value = fit.value.head<3>();
  found.sigma = clustered_sigma(all, fit).head<3>().cwiseMax(sigma_by_quarters(all).head<3>());
  judge(found);
  return found;
}

void move_depth(const Eigen::Vector2d& shift_px, Calibration& calibration) {
  const Camera& color = calibration.camera;
  auto& depth = calibration.depth->camera;
  if (!depth) depth = color;
  depth->cx -= shift_px.x() * depth->fx / color.fx;
  depth->cy -= shift_px.y() * depth->fy / color.fy;
}

std::vector<Quantity> quantities_of(const DepthShift& found) {
  std::vector<Quantity> quantities;
  const char* const names[] = {"depth shift u", "depth shift v", "depth delay"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    quantities.push_back({names[i], i < 2 ? "px" : "s", found.value[k], found.sigma[k], found.findings[i],
                          found.why[i], false});
  }
  return quantities;
}

}  // namespace cairn
