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

/// Between which two recorded poses a frame lies; of one pose both are the same.
struct PoseSpan {
  std::size_t before = 0, after = 0;
  double weight_after = 0;
};

using PoseSpans = std::vector<std::optional<PoseSpan>>;

/// Adds the offset that the options name to the poses' stamps and returns it, nanoseconds. Warns of the one
/// by which first stamps are aligned. InputError if a stamp leaves the range.
std::int64_t shift_stamps(const Sequence& sequence, const GivenPosesOptions& options,
                          RecordedPoses& recorded);

/// Finds for each frame the poses that it lies between, as read_given_poses says. `shifted_s` was added to
/// the stamps. InputError that says what to do if no frame gets one.
[[nodiscard]] PoseSpans spans_of_frames(const Sequence& sequence, const RecordedPoses& recorded,
                                        const GivenPosesOptions& options, double shifted_s);

}  // namespace cairn
