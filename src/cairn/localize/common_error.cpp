// SPDX-License-Identifier: Apache-2.0
#include "cairn/localize/common_error.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "cairn/core/median.h"

namespace cairn {
namespace {

constexpr std::size_t kFewest = 3;  // frames
constexpr std::size_t kNear = 6;    // frames around a keyframe, and as how many the whole map counts

/// Computes the mean squares beyond noise; of a small number of frames, they are raised by as much as the
/// tails of Student's distribution are longer than the normal one's.
CommonError mean_error(std::span<const HeldOutFrame> frames) {
  Vector6d to_map = Vector6d::Zero(), to_given = Vector6d::Zero(), formal = Vector6d::Zero(),
           stated = Vector6d::Zero();
  for (const HeldOutFrame& frame : frames) {
    to_map += frame.to_map.cwiseAbs2();
    to_given += frame.to_given.cwiseAbs2();
    formal += frame.formal;
    stated += frame.stated;
  }
  const auto count = static_cast<double>(frames.size());
  const double tails = 1 + 2 / count;
  const Vector6d map_error = tails * (to_map - formal).cwiseMax(0.0) / count,
                 given_error = tails * (to_given - formal).cwiseMax(0.0) / count;
  // What the map was moved away from the given poses by is their error or its own, not both.
  return {map_error, map_error + (given_error - map_error).cwiseMax(stated / count)};
}

/// Returns the frames with each error cut at three standard deviations, as the median has these: a few places
/// are worse than the whole map is.
std::vector<HeldOutFrame> without_outliers(std::span<const HeldOutFrame> frames) {
  std::vector<HeldOutFrame> cut(frames.begin(), frames.end());
  for (Vector6d HeldOutFrame::*error : {&HeldOutFrame::to_map, &HeldOutFrame::to_given}) {
    for (Eigen::Index i = 0; i < 6; ++i) {
      std::vector<double> sizes;
      for (const HeldOutFrame& frame : frames)
        sizes.push_back(std::max(std::abs((frame.*error)[i]), std::sqrt(frame.formal[i]) / kSigmaPerMedian));
      const double limit = 3 * kSigmaPerMedian * median(std::move(sizes));
      for (HeldOutFrame& frame : cut) (frame.*error)[i] = std::clamp((frame.*error)[i], -limit, limit);
    }
  }
  return cut;
}

}  // namespace

CommonErrors::CommonErrors(std::span<const HeldOutFrame> frames) : frames_(frames.begin(), frames.end()) {
  if (frames_.size() >= kFewest) mean_ = mean_error(without_outliers(frames_));
}

std::optional<CommonError> CommonErrors::near(KeyframeId keyframe) const {
  if (frames_.size() < kFewest) return std::nullopt;
  std::vector<HeldOutFrame> nearest(std::min(kNear, frames_.size()));
  const auto order = [&](const HeldOutFrame& frame) {
    return std::pair(std::abs(frame.keyframe.value - keyframe.value), frame.keyframe);
  };
  std::partial_sort_copy(frames_.begin(), frames_.end(), nearest.begin(), nearest.end(),
                         [&](const HeldOutFrame& a, const HeldOutFrame& b) { return order(a) < order(b); });
  const CommonError local = mean_error(nearest);
  const double share = static_cast<double>(nearest.size()) / static_cast<double>(nearest.size() + kNear);
  return CommonError{share * local.to_map + (1 - share) * mean_.to_map,
                     share * local.to_world + (1 - share) * mean_.to_world};
}

Matrix6d turned(const Vector6d& variances, const Eigen::Quaterniond& to_from) {
  const Eigen::Matrix3d rotation = to_from.toRotationMatrix();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = rotation * variances.head<3>().asDiagonal() * rotation.transpose();
  covariance.bottomRightCorner<3, 3>() = rotation * variances.tail<3>().asDiagonal() * rotation.transpose();
  return covariance;
}

}  // namespace cairn
