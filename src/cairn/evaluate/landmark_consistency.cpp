// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/landmark_consistency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/median.h"
#include "cairn/evaluate/pose_errors.h"
#include "cairn/evaluate/pose_pairs.h"
#include "cairn/evaluate/true_surfaces.h"
#include "cairn/geometry/rig.h"
#include "cairn/image/codec.h"
#include "cairn/map_files/landmark_stream.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/stored_map.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/given_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// Holds a frame that is a keyframe of the map.
struct TrueKeyframe {
  fs::path depth;               ///< its true depth image
  Rigid3 camera_from_world;     ///< true
  Rigid3 estimated_from_world;  ///< camera_from_world by the map, its world moved onto the truth
};

/// Holds what the map says of a landmark, its world moved onto the truth.
struct PlacedLandmark {
  std::uint32_t number = 0;
  Vector3d point = Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double distance = 0;  ///< from the nearest camera that observed it
  std::uint32_t observations = 0;
};

/// Holds the error of a landmark along the normal of the true surface, metres.
struct SurfaceError {
  double error = 0, variance = 0, distance = 0;
  std::uint32_t observations = 0;
  bool at_edge = false;
};

void expect_depth_truth(const Sequence& sequence) {
  if (fs::is_directory(sequence.folder / kDepthTruthFolder)) return;
  throw InputError({sequence.folder.string(), 0,
                    fmt::format("a simulated sequence with the true depth in {}/", kDepthTruthFolder), "none",
                    "Make one with cairn simulate street --depth-truth, or room."});
}

void expect_same_camera(const fs::path& map_folder, const MapInfo& info, const Sequence& sequence) {
  const Camera& camera = sequence.calibration.camera;
  const double baseline = info.rig.baseline;  // not of the left images
  const Rig rig{camera.fx, camera.fy, camera.cx, camera.cy, baseline};
  if (camera.model == CameraModel::pinhole && are_same(info.rig, rig)) return;
  const auto describe = [](double fx, double fy, double cx, double cy) {
    return fmt::format("fx {:g} fy {:g} cx {:g} cy {:g}", fx, fy, cx, cy);
  };
  throw InputError({map_folder.string(), 0,
                    fmt::format("a map of the camera of {}: {}", sequence.folder.string(),
                                describe(camera.fx, camera.fy, camera.cx, camera.cy)),
                    describe(info.rig.fx, info.rig.fy, info.rig.cx, info.rig.cy),
                    "Name the sequence that the map was made of."});
}

/// Pairs keyframes of the main component with the frames of the sequence.
class KeyframePairing {
 public:
  KeyframePairing(const fs::path& map_folder, const StoredMap& map, const Sequence& sequence,
                  double max_gap_s)
      : sequence_(sequence) {
    const auto truth = poses_of_frames(sequence);
    std::vector<std::int64_t> frame_stamps, keyframe_stamps;
    std::vector<std::size_t> frames;
    std::vector<KeyframeId> ids;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!truth[i]) continue;
      frames.push_back(i);
      frame_stamps.push_back(sequence.frames[i].stamp_ns);
    }
    for (std::size_t i = 0; i < map.poses().size(); ++i) {
      const KeyframeId id{static_cast<std::int32_t>(i)};
      if (!map.in_main_component(id)) continue;
      ids.push_back(id);
      keyframe_stamps.push_back(map.info().keyframes[i].stamp_ns);
    }
    expect_one_recording(map_folder, keyframe_stamps);
    for (const auto& [k, f] :
         associate_stamps(keyframe_stamps, frame_stamps, std::llround(1e9 * max_gap_s))) {
      ids_.push_back(ids[k]);
      frames_.push_back(frames[f]);
      pairs.push_back({keyframe_stamps[k], map.poses()[ids[k].index()], *truth[frames[f]]});
    }
    if (pairs.empty())
      throw InputError(
          {map_folder.string(), 0,
           fmt::format("keyframes within {} s of the frames of {}", max_gap_s, sequence.folder.string()),
           "none", "Name the sequence that the map was made of."});
  }

  std::vector<PosePair> pairs;  ///< poses by the map and true ones, in order of time

  /// Returns for each keyframe of the map its frame, or nullopt.
  [[nodiscard]] std::vector<std::optional<TrueKeyframe>> keyframes(const Similarity3& truth_from_map,
                                                                   std::size_t count) const {
    std::vector<std::optional<TrueKeyframe>> all(count);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const fs::path image = sequence_.frames[frames_[i]].color.filename();
      all[ids_[i].index()] =
          TrueKeyframe{sequence_.folder / kDepthTruthFolder / image, pairs[i].reference.inverse(),
                       (truth_from_map * pairs[i].estimate).inverse()};
    }
    return all;
  }

 private:
  static void expect_one_recording(const fs::path& map_folder, const std::vector<std::int64_t>& stamps) {
    if (std::adjacent_find(stamps.begin(), stamps.end(), std::greater_equal<>()) == stamps.end()) return;
    throw InputError({map_folder.string(), 0, "a map of one recording", "stamps that begin anew",
                      "Name the map of the first run, which went on from no other map."});
  }

  const Sequence& sequence_;
  std::vector<KeyframeId> ids_;      // of the pairs
  std::vector<std::size_t> frames_;  // positions in the sequence, of the pairs
};

double path_length(std::span<const PosePair> pairs) {
  double length = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    length += (pairs[i].reference.translation - pairs[i - 1].reference.translation).norm();
  return length;
}

/// Throws InputError if the keyframes are so far from the truth that no drift or receiver can be the reason.
void expect_same_world(const fs::path& map_folder, const LandmarkEvaluation& evaluation,
                       std::span<const PosePair> pairs) {
  constexpr double kLargestDeg = 10, kSmallestLimit = 5, kShareOfPath = 0.1;
  const double limit_m = std::max(kSmallestLimit, kShareOfPath * path_length(pairs));
  if (evaluation.keyframe_error_m <= limit_m && evaluation.keyframe_error_deg <= kLargestDeg) return;
  throw InputError({map_folder.string(), 0,
                    fmt::format("a map in the world of the truth, its keyframes within {:.1f} m and {:g} deg",
                                limit_m, kLargestDeg),
                    fmt::format("{:.1f} m and {:.1f} deg (medians)", evaluation.keyframe_error_m,
                                evaluation.keyframe_error_deg),
                    "Add --align se3 if the map has a world of its own, as that of cairn slam has."});
}

/// Sorts the landmarks of the map into those of each keyframe that is their nearest camera, and counts the
/// rest.
std::vector<std::vector<PlacedLandmark>> place_landmarks(
    const fs::path& folder, const StoredMap& map, const std::vector<std::optional<TrueKeyframe>>& keyframes,
    LandmarkEvaluation& evaluation) {
  const Eigen::Matrix3d turn =
      evaluation.truth_from_map.scale * evaluation.truth_from_map.rotation.toRotationMatrix();
  std::vector<std::vector<PlacedLandmark>> placed(keyframes.size());
  LandmarkStream landmarks(folder, map.info());
  ObservationStream observations(folder, map.info());
  for (std::uint32_t number = 0; const auto landmark = landmarks.next(); ++number) {
    PlacedLandmark one{number, evaluation.truth_from_map * landmark->point_in_world,
                       turn * landmark->covariance * turn.transpose(),
                       std::numeric_limits<double>::infinity(), landmark->observations};
    std::optional<std::size_t> nearest;
    bool in_main = false;
    for (std::uint32_t i = 0; i < landmark->observations; ++i) {
      const KeyframeId id = observations.next().value().observation.keyframe;
      in_main = in_main || map.in_main_component(id);
      if (!keyframes[id.index()]) continue;
      const double distance = (keyframes[id.index()]->estimated_from_world * one.point).norm();
      if (distance < one.distance) one.distance = distance, nearest = id.index();
    }
    ++evaluation.landmarks;
    if (!in_main) {
      ++evaluation.in_other_components;
    } else if (landmark->covariance.isZero(0)) {
      ++evaluation.without_covariance;
    } else if (!landmark->covariance.allFinite()) {
      ++evaluation.undetermined;
    } else if (!nearest) {
      ++evaluation.without_truth;
    } else {
      placed[*nearest].push_back(one);
    }
  }
  return placed;
}

/// Returns how many units of the true depth make a metre: as many as of the depth images, or of KITTI's.
double true_depth_units(const Calibration& calibration) {
  constexpr double kKitti = 256;
  return calibration.depth ? calibration.depth->scale : kKitti;
}

/// Compares a landmark with the nearest of the true surfaces where it projects. Returns nullopt if there is
/// none.
std::optional<SurfaceError> surface_error(const fs::path& folder, const RawDepthImage& depth,
                                          const Calibration& calibration, const TrueKeyframe& keyframe,
                                          const PlacedLandmark& landmark) {
  const Vector3d point = keyframe.camera_from_world * landmark.point;
  const auto pixel = calibration.camera.project(point);
  if (!pixel) return std::nullopt;
  const std::vector<Plane> surfaces =
      find_surfaces(depth, calibration.camera, *pixel, {.units_per_metre = true_depth_units(calibration)});
  if (surfaces.empty()) return std::nullopt;
  const Plane& surface = *std::min_element(
      surfaces.begin(), surfaces.end(),
      [&](const auto& a, const auto& b) { return std::abs(a.behind(point)) < std::abs(b.behind(point)); });
  const Vector3d normal = keyframe.camera_from_world.rotation.conjugate() * surface.normal;
  const double variance = normal.dot(landmark.covariance * normal);
  if (!(variance > 0))
    throw InputError({(folder / kPointFile).string(), 0,
                      fmt::format("a positive definite covariance of landmark {}", landmark.number),
                      "one that is not", "Make the map again."});
  return SurfaceError{surface.behind(point), variance, landmark.distance, landmark.observations,
                      surfaces.size() > 1};
}

/// Compares the landmarks of each keyframe, in the order of keyframes.
std::vector<std::vector<std::optional<SurfaceError>>> surface_errors(
    const fs::path& folder, const Calibration& calibration,
    const std::vector<std::optional<TrueKeyframe>>& keyframes,
    const std::vector<std::vector<PlacedLandmark>>& placed, const Executor& executor) {
  using Errors = std::vector<std::optional<SurfaceError>>;
  const Camera& camera = calibration.camera;
  return executor.map<Errors>(placed.size(), [&](std::size_t i) {
    Errors errors;
    if (placed[i].empty()) return errors;
    const RawDepthImage depth = read_depth(keyframes[i]->depth);
    if (depth.width() != camera.width || depth.height() != camera.height)
      throw InputError({keyframes[i]->depth.string(), 0,
                        fmt::format("{}x{} pixels, as the camera has", camera.width, camera.height),
                        fmt::format("{}x{}", depth.width(), depth.height()), "Simulate the sequence again."});
    for (const PlacedLandmark& landmark : placed[i])
      errors.push_back(surface_error(folder, depth, calibration, *keyframes[i], landmark));
    return errors;
  });
}

/// Collects errors by the class of a figure.
class ClassErrors {
 public:
  /// Sets where classes begin, in ascending order from the smallest figure on; the last has no end.
  explicit ClassErrors(std::vector<double> bounds) : bounds_(std::move(bounds)), errors_(bounds_.size()) {}

  /// Returns the errors of the class of a figure.
  [[nodiscard]] ErrorCollector& operator[](double figure) {
    const auto next = std::upper_bound(bounds_.begin() + 1, bounds_.end(), figure);
    return errors_[static_cast<std::size_t>(next - bounds_.begin()) - 1];
  }

  [[nodiscard]] std::vector<LandmarkClass> assess() const {
    std::vector<LandmarkClass> classes;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      const double to = i + 1 < bounds_.size() ? bounds_[i + 1] : std::numeric_limits<double>::infinity();
      if (const auto assessed = errors_[i].assess()) classes.push_back({bounds_[i], to, *assessed});
    }
    return classes;
  }

 private:
  std::vector<double> bounds_;
  std::vector<ErrorCollector> errors_;
};

/// Collects the errors of all landmarks.
class LandmarkErrors {
 public:
  void add(const SurfaceError& one) {
    const Eigen::Matrix<double, 1, 1> error(one.error), variance(one.variance);
    ErrorCollector& of_place = one.at_edge ? at_edge_ : on_surface_;
    for (ErrorCollector* const errors :
         {&all_, &of_place, &by_distance_[one.distance], &by_observations_[one.observations]})
      errors->add(error, variance);
    distances_.push_back(std::abs(one.error));
  }

  void assess(LandmarkEvaluation& evaluation) const {
    evaluation.judged = all_.count();
    evaluation.at_edges = at_edge_.count();
    evaluation.all = all_.assess();
    evaluation.on_surface = on_surface_.assess();
    evaluation.at_edge = at_edge_.assess();
    evaluation.distances_m = summarize_errors(distances_);
    evaluation.by_distance = by_distance_.assess();
    evaluation.by_observations = by_observations_.assess();
  }

 private:
  ErrorCollector all_, on_surface_, at_edge_;
  ClassErrors by_distance_{{0, 2.5, 5, 10, 20, 40, 80}};
  ClassErrors by_observations_{{1, 3, 5, 9, 17}};
  std::vector<double> distances_;
};

}  // namespace

void LandmarkEvaluationOptions::validate() const {
  require(max_gap_s >= 0, "max_gap_s is not below 0");
}

LandmarkEvaluation evaluate_landmarks(const fs::path& map_folder, const Sequence& sequence,
                                      const LandmarkEvaluationOptions& options, const Executor& executor) {
  options.validate();
  const fs::path folder = require_map_folder(map_folder);
  const StoredMap map(folder);
  expect_depth_truth(sequence);
  expect_same_camera(map_folder, map.info(), sequence);
  const KeyframePairing pairing(map_folder, map, sequence, options.max_gap_s);
  LandmarkEvaluation evaluation;
  evaluation.keyframe_pairs = pairing.pairs.size();
  if (options.alignment != AlignmentMode::none) {
    const Alignment alignment = align_pairs(pairing.pairs, options.alignment == AlignmentMode::sim3);
    evaluation.alignment_status = alignment.status;
    if (alignment.status != AlignmentStatus::ok) return evaluation;
    evaluation.truth_from_map = alignment.target_from_source;
  }
  const PoseErrors errors = absolute_errors(aligned_pairs(evaluation.truth_from_map, pairing.pairs));
  evaluation.keyframe_error_m = median(errors.translation_m);
  evaluation.keyframe_error_deg = median(errors.rotation_deg);
  if (options.alignment == AlignmentMode::none) expect_same_world(map_folder, evaluation, pairing.pairs);
  const auto keyframes = pairing.keyframes(evaluation.truth_from_map, map.poses().size());
  const auto placed = place_landmarks(folder, map, keyframes, evaluation);
  LandmarkErrors collected;
  for (const auto& of_keyframe : surface_errors(folder, sequence.calibration, keyframes, placed, executor))
    for (const auto& error : of_keyframe) error ? collected.add(*error) : void(++evaluation.without_truth);
  collected.assess(evaluation);
  return evaluation;
}

}  // namespace cairn
