// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/observe/prediction.h"

namespace cairn {

/// Says that a feature of the frame shows a point.
struct GuidedMatch {
  std::size_t point = 0;      ///< number under which the point was added
  std::int32_t feature = -1;  ///< feature of the frame
  float distance = 0;         ///< distance of the descriptors
};

/// Searches a frame for known points: each near the pixel where the frame's pose predicts it, by its
/// descriptor in an earlier frame.
class GuidedSearch {
 public:
  /// Sets the radius of the windows at the finest scale, see predict_window. The observations and the rig of
  /// `frame` must outlive the search.
  GuidedSearch(const PosedFrame& frame, double radius_px) : frame_(frame), radius_px_(radius_px) {}

  /// Adds a point, with its number for the matches and the pixels by which its window is enlarged. Leaves out
  /// a point that the frame should not show (predict_window). The descriptors of the appearance must outlive
  /// the search.
  void add(std::size_t number, const Eigen::Vector3d& point_in_world, const Appearance& appearance,
           double extra_px = 0);

  /// Matches the points with the features in their windows. A feature goes to one point at most, the nearest
  /// by descriptor within descriptor_limit; if `max_ratio` is above 0, it must be clearly nearer than the
  /// second. Returns the matches in the order in which the points were added. The same bits at any number of
  /// threads.
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
