// SPDX-License-Identifier: Apache-2.0
// Private to this room: which of the recorded poses a frame lies between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {

/// Names the two recorded poses that a frame lies between; both are the same if it has a pose of its own.
struct PoseSpan {
  std::size_t before = 0, after = 0;
  double weight_after = 0;  ///< weight of the pose after, 0 to 1
};

using PoseSpans = std::vector<std::optional<PoseSpan>>;

/// Adds the offset that the options name to the poses' stamps and returns it, nanoseconds. Warns of the
/// offset that aligns the first stamps. Throws InputError if a stamp leaves the range of an int64.
std::int64_t shift_stamps(const Sequence& sequence, const GivenPosesOptions& options,
                          RecordedPoses& recorded);

/// Finds for each frame the poses that it lies between, as read_given_poses describes. `shifted_s` was added
/// to the stamps. Throws InputError with a remedy if no frame gets one.
[[nodiscard]] PoseSpans spans_of_frames(const Sequence& sequence, const RecordedPoses& recorded,
                                        const GivenPosesOptions& options, double shifted_s);

}  // namespace cairn
