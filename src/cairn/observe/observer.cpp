// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/observer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cairn/core/median.h"
#include "cairn/matching/stereo_matching.h"

namespace cairn {
namespace {

/// Looks at the depths around a feature.
class DepthWindow {
 public:
  DepthWindow(const DepthImage& depth, const Keypoint& keypoint, const Rig& rig, const DepthNoise& noise)
      : depth_(depth), focal_baseline_(static_cast<float>(rig.fx * rig.baseline)) {
    u_ = static_cast<int>(std::lround(keypoint.u));
    v_ = static_cast<int>(std::lround(keypoint.v));
    const int radius =
        static_cast<int>(std::lround(noise.jump_radius * static_cast<double>(keypoint.sigma_px)));
    left_ = std::max(0, u_ - radius);
    right_ = std::min(depth.width() - 1, u_ + radius);
    top_ = std::max(0, v_ - radius);
    bottom_ = std::min(depth.height() - 1, v_ + radius);
  }

  /// Returns the depth in the middle, metres; 0 if there is none.
  [[nodiscard]] double depth() const {
    return depth_.contains(u_, v_) ? static_cast<double>(depth_(u_, v_)) : 0;
  }

  /// Returns whether a disparity differs from the middle's by more than `limit_px`.
  [[nodiscard]] bool differs_by_more_than(double limit_px) const {
    const float middle = focal_baseline_ / depth_(u_, v_), limit = static_cast<float>(limit_px);
    for (int y = top_; y <= bottom_; ++y) {
      const float* row = depth_.row(y);
      float largest = 0;
      for (int x = left_; x <= right_; ++x) {
        const float d = row[x] > 0 ? focal_baseline_ / row[x] : middle;
        largest = std::max(largest, std::abs(d - middle));
      }
      if (largest > limit) return true;
    }
    return false;
  }

  /// Returns the standard deviation of a disparity, pixels, by the median second difference along the rows,
  /// which neither a slope nor one outline changes much; 0 if too few depths are known.
  [[nodiscard]] double scatter() const {
    std::vector<double> differences;
    constexpr int kReach = 4;  // pixels: 63 second differences
    for (int y = std::max(top_, v_ - kReach); y <= std::min(bottom_, v_ + kReach); ++y) {
      const float* row = depth_.row(y);
      for (int x = std::max(left_, u_ - kReach) + 1; x < std::min(right_, u_ + kReach); ++x) {
        if (!(row[x - 1] > 0 && row[x] > 0 && row[x + 1] > 0)) continue;
        const float second = 1 / row[x - 1] - 2 / row[x] + 1 / row[x + 1];
        differences.push_back(static_cast<double>(focal_baseline_ * std::abs(second)));
      }
    }
    constexpr std::size_t kFewest = 10;
    constexpr double kPerSecondDifference = 1 / 2.449;  // 1 / sqrt(1 + 4 + 1)
    return differences.size() < kFewest
               ? 0
               : kPerSecondDifference * kSigmaPerMedian * median(std::move(differences));
  }

 private:
  const DepthImage& depth_;
  float focal_baseline_;
  int u_, v_, left_, right_, top_, bottom_;
};

/// Tells whether the depth around a feature jumps: by many standard deviations, which are the largest of a
/// Kinect's, those that are stated, and those of the neighbourhood.
bool jumps(const DepthWindow& window, const Rig& rig, const DepthNoise& noise) {
  const double sigma = std::max(kKinectNoise.sigma_px, noise.stated.at(rig, rig.disparity(window.depth())));
  if (!window.differs_by_more_than(noise.jump_sigmas * sigma)) return false;
  const double scatter = window.scatter();
  return scatter <= sigma || window.differs_by_more_than(noise.jump_sigmas * scatter);
}

/// Returns the depth at the nearest pixel, metres; 0 if unknown, out of range, or at a jump of the depth: a
/// corner on an outline belongs to one side, its depth may come from the other, and the inliers among these
/// shorten the motion by 1 to 2 %.
double depth_at(const DepthImage& depth, const Keypoint& keypoint, const Rig& rig, const DepthNoise& noise) {
  const DepthWindow window(depth, keypoint, rig, noise);
  const double z = window.depth();
  const bool is_usable = z >= noise.min_depth && z <= noise.max_depth && !jumps(window, rig, noise);
  return is_usable ? z : 0;
}

Observation make_observation(const Rig& rig, const Eigen::Vector2d& ray, const Keypoint& keypoint,
                             double depth, const DepthNoise& noise) {
  Observation seen;
  seen.u = rig.fx * ray.x() + rig.cx;
  seen.v = rig.fy * ray.y() + rig.cy;
  seen.sigma_px = static_cast<double>(keypoint.sigma_px);
  if (depth > 0) seen.d = rig.disparity(depth);
  seen.sigma_d_px = depth > 0 ? noise.at_start().at(rig, seen.d) : noise.at_start().sigma_px;
  return seen;
}

/// Returns a frame without features.
ObservedFrame begin_frame(const Frame& frame) {
  return {frame.id, frame.stamp_ns, {}, {}, {}};
}

void add(const Rig& rig, const Observation& seen, const Keypoint& keypoint, ObservedFrame& observed) {
  observed.features.keypoints.push_back(keypoint);
  observed.features.keypoints.back().u = static_cast<float>(seen.u);
  observed.features.keypoints.back().v = static_cast<float>(seen.v);
  observed.observations.push_back(seen);
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  observed.points_in_camera.push_back(seen.has_disparity() ? rig.point_at(seen.u, seen.v, rig.depth(seen.d))
                                                           : none);
}

}  // namespace

Rig rig_of(const Calibration& calibration, const DepthNoise& noise) {
  const Camera& camera = calibration.camera;
  return {camera.fx, camera.fy, camera.cx, camera.cy, calibration.baseline.value_or(noise.baseline)};
}

Observer::Observer(const Calibration& calibration, const ObserverOptions& options)
    : camera_(calibration.camera),
      rig_(rig_of(calibration, options.depth_noise)),
      depth_(options.depth_noise),
      stereo_(options.stereo_noise),
      correction_(calibration.right_correction.value_or(StereoCorrection{})),
      extractor_(make_extractor(options.features)) {}

ObservedFrame Observer::observe(const Frame& frame) const {
  return frame.right.empty() ? observe_rgbd(frame) : observe_stereo(frame);
}

ObservedFrame Observer::observe_rgbd(const Frame& frame) const {
  const Features all = extractor_->extract(frame.gray);
  ObservedFrame observed = begin_frame(frame);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.keypoints.size(); ++i) {
    const Keypoint& keypoint = all.keypoints[i];
    const auto ray = camera_.unproject({static_cast<double>(keypoint.u), static_cast<double>(keypoint.v)});
    if (!ray) continue;
    const double depth = depth_at(frame.depth, keypoint, rig_, depth_);
    kept.push_back(i);
    add(rig_, make_observation(rig_, *ray, keypoint, depth, depth_), keypoint, observed);
  }
  observed.features.descriptors = select(all.descriptors, kept);
  return observed;
}

ObservedFrame Observer::observe_stereo(const Frame& frame) const {
  Features left = extractor_->extract(frame.gray);
  const Features right = extractor_->extract(frame.right);
  StereoMatchOptions matching;
  matching.min_depth = stereo_.min_depth;
  matching.min_correlation = stereo_.min_correlation;
  matching.search_images = stereo_.search_images;
  const auto matches = match_stereo(rig_, {left, frame.gray}, {right, frame.right}, matching);
  ObservedFrame observed = begin_frame(frame);
  for (std::size_t i = 0; i < left.keypoints.size(); ++i) {
    const Keypoint& keypoint = left.keypoints[i];
    Observation seen{static_cast<double>(keypoint.u), static_cast<double>(keypoint.v)};
    seen.sigma_px = static_cast<double>(keypoint.sigma_px);
    if (matches[i] && matches[i]->measured) {
      const double sigma = std::hypot(matches[i]->sigma_disparity_px, stereo_.sigma_floor_px);
      const double disparity = correction_.corrected(rig_, seen.u, matches[i]->disparity);
      if (disparity > stereo_.min_disparity_sigmas * sigma) {
        seen.d = disparity;
        seen.sigma_d_px = sigma;
      }
    }
    add(rig_, seen, keypoint, observed);
  }
  observed.features.descriptors = std::move(left.descriptors);
  return observed;
}

}  // namespace cairn
