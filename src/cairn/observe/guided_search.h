// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/observe/prediction.h"

namespace cairn {

/// A feature of the frame shows a point.
struct GuidedMatch {
  std::size_t point = 0;      ///< the number under which it was added
  std::int32_t feature = -1;  ///< of the frame
  float distance = 0;         ///< of the descriptors
};

/// Looks for known points in a frame: each near the pixel where the pose of the frame has it, by its
/// descriptor in an earlier frame.
class GuidedSearch {
 public:
  /// `radius_px` is that of the window at the lowest pyramid level, see predict_window. The frame outlives
  /// the search.
  GuidedSearch(const PosedFrame& frame, double radius_px) : frame_(frame), radius_px_(radius_px) {}

  /// Adds a point, with its number for the matches and the pixels by which its window is wider than that of
  /// others. A point that the frame should not show is left out. The descriptors of the appearance outlive
  /// the search.
  void add(std::size_t number, const Eigen::Vector3d& point_in_world, const Appearance& appearance,
           double extra_px = 0);

  /// Matches the points with the features in their windows: a feature goes to one point at most, the nearest
  /// by descriptor within descriptor_limit, which is clearly nearer than the second if `max_ratio` is above
  /// 0. Ordered as the points were added. The same bits at any number of threads.
  [[nodiscard]] std::vector<GuidedMatch> match(double max_ratio = 0,
                                               const Executor& executor = Executor()) const;

 private:
  PosedFrame frame_;
  double radius_px_;
  std::vector<std::size_t> numbers_;
  std::vector<SearchWindow> windows_;
  std::vector<Appearance> appearances_;
};

}  // namespace cairn
