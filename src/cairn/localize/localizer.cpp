// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/localizer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cairn/core/error.h"
#include "cairn/geometry/pnp_ransac.h"
#include "cairn/localize/retrieval.h"

namespace cairn {
namespace {

/// Holds the correspondences from which the pose is estimated.
struct MatchedPoints {
  std::vector<Eigen::Vector3d> points_in_world;
  std::vector<Observation> observations;
  std::vector<Eigen::Matrix3d> covariances;

  [[nodiscard]] Correspondences correspondences() const {
    return {points_in_world, observations, covariances};
  }
};

MatchedPoints points_of(const std::vector<LandmarkMatch>& matches) {
  MatchedPoints matched;
  for (const LandmarkMatch& match : matches) {
    matched.points_in_world.push_back(match.point_in_world);
    matched.observations.push_back(match.seen);
    matched.covariances.push_back(match.covariance);
  }
  return matched;
}

/// Returns the observation with the landmark's own uncertainty added, as it appears from the distance at
/// which the keyframe saw it: RANSAC has no pose yet to do better.
Observation with_landmark_noise(const Rig& rig, const LandmarkMatch& match) {
  const double sigma = std::sqrt(match.covariance.trace() / 3) / match.distance;  // radians
  Observation noisy = match.seen;
  noisy.sigma_px = std::hypot(noisy.sigma_px, sigma * rig.fx);
  noisy.sigma_d_px = std::hypot(noisy.sigma_d_px, sigma * rig.disparity(match.distance));
  return noisy;
}

PnpResult ransac(const Rig& rig, const std::vector<LandmarkMatch>& matches, FrameId frame,
                 const LocalizeOptions& options) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Observation> seen;
  for (const LandmarkMatch& match : matches) {
    points.push_back(match.point_in_world);
    seen.push_back(with_landmark_noise(rig, match));
  }
  RansacOptions ransac;
  ransac.max_iterations = options.ransac_iterations;
  ransac.seed = options.seed;
  ransac.item = static_cast<std::uint64_t>(frame.value);
  return solve_pnp_ransac(rig, points, seen, ransac, false);
}

int count_cells(const Localization& found, const QueryCamera& camera) {
  constexpr int kCells = 4;
  const auto cell = [](double at, int size) {
    return std::clamp(static_cast<int>(std::floor((at + 0.5) * kCells / size)), 0, kCells - 1);
  };
  std::set<int> cells;
  for (const std::int32_t i : found.inliers) {
    const Observation& seen = found.matches[static_cast<std::size_t>(i)].seen;
    cells.insert(cell(seen.v, camera.height) * kCells + cell(seen.u, camera.width));
  }
  return static_cast<int>(cells.size());
}

/// Counts the inliers whose match is also among the first ones, which were made by descriptor.
int count_independent(const Localization& found, const std::vector<LandmarkMatch>& by_descriptor) {
  int count = 0;
  for (const std::int32_t i : found.inliers) {
    const LandmarkMatch& match = found.matches[static_cast<std::size_t>(i)];
    const auto same = std::lower_bound(
        by_descriptor.begin(), by_descriptor.end(), match.feature,
        [](const LandmarkMatch& other, std::int32_t feature) { return other.feature < feature; });
    count +=
        same != by_descriptor.end() && same->feature == match.feature && same->landmark == match.landmark;
  }
  return count;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return "none";
    case Verdict::weak:
      return "weak";
    case Verdict::good:
      return "good";
  }
  return "";
}

std::string_view to_string(Weakness weakness) {
  switch (weakness) {
    case Weakness::nothing:
      return "";
    case Weakness::few_inliers:
      return "few inliers";
    case Weakness::bad_geometry:
      return "bad geometry";
    case Weakness::large_covariance:
      return "large covariance";
    case Weakness::inconsistent_with_motion:
      return "inconsistent with the motion";
  }
  return "";
}

Localizer::Localizer(const StoredMap& map, const QueryCamera& camera, const LocalizeOptions& options)
    : map_(map), camera_(camera), options_(options), common_errors_(map.held_out()) {
  options.validate();
  require(camera.width > 0 && camera.height > 0 && camera.rig.fx > 0 && camera.rig.fy > 0,
          "the size and the focal lengths of the images are known");
}

Keyframes Localizer::load(const std::vector<KeyframeId>& ids) const {
  Keyframes keyframes;
  for (const KeyframeId id : ids) keyframes.push_back(map_.keyframe(id));
  return keyframes;
}

Localization Localizer::localize(const ObservedFrame& observed,
                                 const std::optional<WorldFromCamera>& prior) const {
  if (!prior) return localize_anywhere(observed);
  Localization near = localize_near(observed, *prior);
  if (near.verdict == Verdict::good) return near;
  Localization anywhere = localize_anywhere(observed);
  return near.verdict >= anywhere.verdict ? near : anywhere;
}

Localization Localizer::localize_near(const ObservedFrame& observed, const WorldFromCamera& prior) const {
  const Keyframes keyframes =
      load(keyframes_near(map_, prior, static_cast<std::size_t>(options_.nearby_keyframes)));
  const auto matches = match_predicted_landmarks(map_, keyframes, {camera_.rig, observed, prior.inverse()},
                                                 options_.prior_radius_px);
  Localization found = refine(observed, matches, keyframes);
  found.from_prior = true;
  return found;
}

Localization Localizer::localize_anywhere(const ObservedFrame& observed) const {
  const auto most =
      static_cast<std::size_t>(options_.keyframes) + static_cast<std::size_t>(options_.more_keyframes);
  const auto places = find_places(map_, observed.features.descriptors, most);
  Localization best;
  for (std::size_t begin = 0; begin < places.size() && best.verdict != Verdict::good;
       begin += static_cast<std::size_t>(options_.keyframes)) {
    std::vector<KeyframeId> ids;
    for (std::size_t i = begin;
         i < std::min(places.size(), begin + static_cast<std::size_t>(options_.keyframes)); ++i)
      ids.push_back({places[i].id});
    const Keyframes keyframes = load(ids);
    Localization found =
        refine(observed, match_keyframes(map_, keyframes, observed, options_.max_ratio), keyframes);
    if (found.verdict > best.verdict) best = std::move(found);
  }
  return best;
}

/// Estimates and judges the pose from first matches, which come from `keyframes`.
Localization Localizer::refine(const ObservedFrame& observed, const std::vector<LandmarkMatch>& matches,
                               Keyframes keyframes) const {
  Localization found;
  found.matches = matches;
  const PnpResult first = ransac(camera_.rig, matches, observed.frame, options_);
  if (!first.found()) return found;
  found.camera_from_world = first.camera_from_world;
  const Keyframes nearby = load(keyframes_near(map_, first.camera_from_world.inverse(),
                                               static_cast<std::size_t>(options_.nearby_keyframes)));
  for (const auto& keyframe : nearby)
    if (std::find(keyframes.begin(), keyframes.end(), keyframe) == keyframes.end())
      keyframes.push_back(keyframe);
  found.matches = match_predicted_landmarks(map_, keyframes, {camera_.rig, observed, first.camera_from_world},
                                            options_.radius_px);
  const MatchedPoints matched = points_of(found.matches);
  const PoseEstimate pose =
      estimate_pose(camera_.rig, matched.correspondences(), first.camera_from_world, {.keep_pixels = false});
  if (!pose.found()) return found;
  found.camera_from_world = pose.camera_from_world;
  found.inliers = pose.inliers;
  found.variance_factor = pose.variance_factor;
  found.rms_px = pose.rms_px;
  const auto common = common_error_near(pose.camera_from_world);
  // Of few inliers the factor is known badly, and frames with fewer were not held out.
  const bool is_measured = common && pose.inliers.size() >= kFewestHeldOutInliers;
  found.precision = assess_precision(camera_.rig, matched.correspondences(), pose,
                                     is_measured ? NoiseScale::as_residuals : NoiseScale::at_least_stated);
  if (common) cairn::add_common_error(common->error, common->camera_from_keyframe, found.precision);
  found.independent = count_independent(found, matches);
  found.cells = count_cells(found, camera_);
  judge(found);
  return found;
}

std::optional<Localizer::PlacedError> Localizer::common_error_near(
    const CameraFromWorld& camera_from_world) const {
  const auto nearest = keyframes_near(map_, camera_from_world.inverse(), 1);
  if (nearest.empty()) return std::nullopt;
  const auto error = common_errors_.near(nearest.front());
  if (!error) return std::nullopt;
  const Eigen::Quaterniond world_from_keyframe = map_.poses()[nearest.front().index()].rotation;
  return PlacedError{*error, camera_from_world.rotation * world_from_keyframe};
}

void Localizer::judge(Localization& found) const {
  const TrustOptions& trust = options_.trust;
  const double max_angle = trust.max_angle_deg * std::numbers::pi / 180;
  const auto& protection = found.precision.protection;
  found.weakness = Weakness::nothing;
  if (static_cast<int>(found.inliers.size()) < trust.min_inliers || found.independent < trust.min_independent)
    found.weakness = Weakness::few_inliers;
  else if (found.cells < trust.min_cells || !(found.precision.gdop <= trust.max_gdop))
    found.weakness = Weakness::bad_geometry;
  else if (!(protection.tail<3>().maxCoeff() <= trust.max_position) ||
           !(protection.head<3>().maxCoeff() <= max_angle))
    found.weakness = Weakness::large_covariance;
  found.verdict = found.weakness == Weakness::nothing ? Verdict::good : Verdict::weak;
}

}  // namespace cairn
