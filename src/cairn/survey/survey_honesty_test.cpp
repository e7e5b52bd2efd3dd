// SPDX-License-Identifier: Apache-2.0
// Landmarks of a simulated street, whose surfaces are known: are they where they should be, and do their
// covariances say how well?
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "cairn/core/random.h"
#include "cairn/geometry/inlier_limits.h"
#include "cairn/simulate/simulate_street.h"
#include "cairn/survey/landmarks.h"
#include "cairn/survey/surveyor.h"

namespace cairn {
namespace {

constexpr double kNoisePx = 0.5;
constexpr int kFrames = 60;
const double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The surface that a frame's pixel shows.
struct SurfacePoint {
  Eigen::Vector3d point_in_world, normal_in_world;
};

struct StreetFrame {
  ObservedFrame observed;  ///< with noise
  GivenPose given;
  std::vector<std::optional<SurfacePoint>> shown;  ///< by each feature; nothing at edges
};

std::optional<SurfacePoint> surface_at(const DepthImage& depth, const Rig& rig,
                                       const Rigid3& world_from_camera, double u, double v) {
  const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
  if (!depth.contains(x - 1, y - 1) || !depth.contains(x + 1, y + 1)) return std::nullopt;
  const auto point = [&](int i, int j) { return rig.point_at(i, j, static_cast<double>(depth(i, j))); };
  const double middle = static_cast<double>(depth(x, y));
  for (const auto& [i, j] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) {
    const auto other = static_cast<double>(depth(i, j));
    if (!(other > 0) || std::abs(1 / other - 1 / middle) * rig.fx * rig.baseline > 1) return std::nullopt;
  }
  const Eigen::Vector3d normal =
      (point(x + 1, y) - point(x - 1, y)).cross(point(x, y + 1) - point(x, y - 1)).normalized();
  // The ray through (u, v) meets the plane of the pixel's surface.
  const Eigen::Vector3d ray = rig.point_at(u, v, 1);
  const Eigen::Vector3d on_surface = ray * (normal.dot(point(x, y)) / normal.dot(ray));
  return SurfacePoint{world_from_camera * on_surface, world_from_camera.rotation * normal};
}

/// Frames of one street, observed once for all tests.
const std::vector<StreetFrame>& street() {
  static const std::vector<StreetFrame> kFramesSeen = [] {
    SimulateStreetOptions street_options;
    street_options.frames_count = kFrames;
    street_options.noise = StreetNoise::none;
    const Executor executor(2);
    const SimulatedStreet street(street_options, executor);
    const SurveyOptions options;
    const Observer observer(street.calibration(), options.observer);
    const Rig rig = rig_of(street.calibration(), {});
    return executor.map<StreetFrame>(kFrames, [&](std::size_t i) {
      const int k = static_cast<int>(i);
      SimulatedStereoFrame images = street.render(k);
      StreetFrame frame;
      frame.given.world_from_camera = street.world_from_camera(k);
      Frame loaded{{k}, street.stamp_ns(k), std::move(images.left), {}, std::move(images.right)};
      frame.observed = observer.observe(loaded);
      Random random(7, i);
      for (std::size_t f = 0; f < frame.observed.observations.size(); ++f) {
        Observation& seen = frame.observed.observations[f];
        frame.shown.push_back(
            surface_at(images.depth_true, rig, frame.given.world_from_camera, seen.u, seen.v));
        seen.u += kNoisePx * random.normal();
        seen.v += kNoisePx * random.normal();
        seen.d += kNoisePx * random.normal();
        seen.sigma_px = kNoisePx;
        if (seen.has_disparity() && seen.d < 1) seen.d = kNaN;
        frame.observed.points_in_camera[f] = point_in_camera(rig, seen);
      }
      return frame;
    });
  }();
  return kFramesSeen;
}

struct Honesty {
  std::size_t landmarks = 0, judged = 0;
  double median_distance_m = 0;  ///< from the surface, of landmarks within 20 m
  double nees_per_freedom = 0, covered_95 = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Replaces a share of the matches by others of the same frame.
void spoil(double share, const ObservedFrame& observed, Random& random, std::vector<TrackMatch>& matches) {
  std::vector<char> taken(observed.observations.size());
  for (const TrackMatch& match : matches) taken[static_cast<std::size_t>(match.feature)] = 1;
  for (TrackMatch& match : matches) {
    if (random.uniform() >= share) continue;
    const auto other = random.index(static_cast<std::uint32_t>(taken.size()));
    if (taken[other] != 0 || !observed.observations[other].has_disparity()) continue;
    taken[other] = 1;
    match.feature = static_cast<std::int32_t>(other);
  }
}

/// The place on the surface that a landmark shows.
struct Truth {
  SurfacePoint middle;  ///< each coordinate the middle of what its observations show
  double spread_m = 0;  ///< of these: a feature's centre wanders on the surface with the view
};

/// The stages of Surveyor, without its adjustment of poses, which are exact here.
class StreetMapper {
 public:
  explicit StreetMapper(double wrong_share) : wrong_share_(wrong_share) { options_.tracks.pose_frames = 0; }

  std::vector<SurveyLandmark> map() {
    for (std::size_t i = 0; i < street().size(); ++i) add(i);
    adjust_finished_tracks({kFrames + options_.tracks.window});
    return std::move(landmarks_);
  }

  /// What the kept observations of a landmark show; nothing where one is at an edge.
  [[nodiscard]] std::optional<Truth> truth_of(const SurveyLandmark& landmark) const {
    std::array<std::vector<double>, 3> coordinates;
    std::vector<SurfacePoint> points;
    for (const ObservationRef& observation : landmark.observations) {
      const auto feature = frames_[observation.keyframe].kept[static_cast<std::size_t>(observation.feature)];
      const auto& shown = street()[observation.keyframe.index()].shown[feature];
      if (!shown) return std::nullopt;
      points.push_back(*shown);
      for (int k = 0; k < 3; ++k)
        coordinates[static_cast<std::size_t>(k)].push_back(shown->point_in_world[k]);
    }
    Truth truth{points.front(), 0};
    for (int k = 0; k < 3; ++k)
      truth.middle.point_in_world[k] = median(coordinates[static_cast<std::size_t>(k)]);
    for (const SurfacePoint& point : points)
      truth.spread_m += (point.point_in_world - truth.middle.point_in_world).squaredNorm();
    truth.spread_m = std::sqrt(truth.spread_m / static_cast<double>(points.size()));
    return truth;
  }

 private:
  void add(std::size_t i) {
    SurveyFrame frame;
    frame.id = {static_cast<std::int32_t>(i)};
    frame.observed = street()[i].observed;
    frame.given = street()[i].given;
    frame.world_from_camera = frame.odometry = frame.given.world_from_camera;
    frame.camera_from_world = frame.world_from_camera.inverse();
    auto matches = match_to_tracks(rig_, frames_, tracks_, frame, options_.tracks, executor_);
    Random random(11, i);
    spoil(wrong_share_, frame.observed, random, matches);
    drop_unused_features(frame, matches);
    extend_tracks(frame, matches, tracks_);
    const KeyframeId newest = frame.id;
    frames_.push_back(std::move(frame));
    adjust_finished_tracks(newest);
  }

  void adjust_finished_tracks(KeyframeId newest) {
    auto adjusted =
        adjust_tracks(rig_, frames_, extract_finished(newest, options_.tracks, tracks_), options_, executor_);
    for (const SurveyLandmark& landmark : adjusted.landmarks)
      variance_.add(landmark.squared_error_sum, landmark.redundancy);
    for (SurveyLandmark& landmark : adjusted.landmarks) {
      complete_covariance(frames_, {variance_.prior(), noise_.noise()}, true, landmark);
      noise_.add(landmark.information.errors);
      if (!failed_rule(landmark.indicators, landmark.own_covariance(), options_.cleaning))
        landmarks_.push_back(std::move(landmark));
    }
  }

  double wrong_share_;
  SurveyOptions options_;
  Executor executor_{2};
  Rig rig_ = rig_of(SimulatedStreet({.frames_count = 1}).calibration(), {});
  FrameBuffer frames_;
  std::vector<Track> tracks_;
  VarianceModel variance_;
  LandmarkNoiseModel noise_;
  std::vector<SurveyLandmark> landmarks_;
};

Honesty measure(double wrong_share) {
  constexpr double kNear = 20;
  constexpr double kSharp = 0.3;  // a truth that is itself less sure says nothing of the covariance
  StreetMapper mapper(wrong_share);
  Honesty honesty;
  std::vector<double> distances;
  double nees = 0;
  std::size_t inside = 0;
  for (const SurveyLandmark& landmark : mapper.map()) {
    const auto truth = mapper.truth_of(landmark);
    if (!truth) continue;
    ++honesty.landmarks;
    const Eigen::Vector3d error = landmark.point_in_world - truth->middle.point_in_world;
    if (landmark.indicators.distance.mean <= kNear)
      distances.push_back(std::abs(truth->middle.normal_in_world.dot(error)));
    if (truth->spread_m > kSharp * std::sqrt(landmark.covariance().trace())) continue;
    const double squared = error.dot(landmark.covariance().inverse() * error);
    nees += squared / 3;
    inside += squared <= kInlierLimit3 ? 1 : 0;
    ++honesty.judged;
  }
  const auto count = static_cast<double>(honesty.judged);
  honesty.nees_per_freedom = nees / count;
  honesty.covered_95 = static_cast<double>(inside) / count;
  honesty.median_distance_m = median(distances);
  return honesty;
}

void expect_honest(const Honesty& honesty, double times) {
  EXPECT_GT(honesty.landmarks, 10000U);
  EXPECT_GT(honesty.judged, 3 * honesty.landmarks / 4);
  EXPECT_LE(honesty.median_distance_m, 0.03 * times);
  EXPECT_GE(honesty.nees_per_freedom, 0.8 / times);
  EXPECT_LE(honesty.nees_per_freedom, 1.25 * times);
  EXPECT_GE(honesty.covered_95, 1 - 0.08 * times);
  EXPECT_LE(honesty.covered_95, 0.98);
  for (const auto& [name, value] : {std::pair{"distance_m", honesty.median_distance_m},
                                    {"nees_per_freedom", honesty.nees_per_freedom},
                                    {"covered_95", honesty.covered_95}})
    testing::Test::RecordProperty(name, std::to_string(value));
}

TEST(SlowSurveyHonesty, holds_with_half_a_pixel_of_noise) {
  expect_honest(measure(0), 1);
}

TEST(SlowSurveyHonesty, holds_with_a_fifth_of_the_matches_wrong) {
  expect_honest(measure(0.2), 1.5);
}

}  // namespace
}  // namespace cairn
