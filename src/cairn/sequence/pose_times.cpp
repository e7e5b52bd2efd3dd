// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {
namespace {

/// How far in time a pose may be from a frame.
struct TimeRules {
  std::uint64_t max_gap_ns = 0;    ///< between the poses before and after
  std::uint64_t tolerance_ns = 0;  ///< to the nearest pose, whatever the gap
};

TimeRules rules_for(const Sequence& sequence, const RecordedPoses& recorded,
                    const GivenPosesOptions& options) {
  constexpr std::uint64_t kRoundedStampNs = 1'000'000;
  const bool exact = recorded.key != PoseKey::stamp || (recorded.format == "truth" && !has_clock(sequence));
  if (!exact) return {static_cast<std::uint64_t>(std::llround(options.max_gap_s * 1e9)), kRoundedStampNs};
  if (options.time_offset_s == 0 && !options.align_first_stamps) return {};
  throw InputError({"time_offset_s", 0, "0, as these poses belong to frames by their numbers",
                    options.align_first_stamps ? "start" : fmt::format("{}", options.time_offset_s),
                    "Leave it out."});
}

/// a + b, or the int64 nearest to it: stamps that far off are refused when they are shifted.
std::int64_t saturated_sum(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return b < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
}

/// From the first pose's stamp to that of the recording's first frame.
std::int64_t offset_of_starts(const Sequence& sequence, const RecordedPoses& recorded) {
  const std::int64_t frame = sequence.first_stamp_ns.value_or(sequence.frames.front().stamp_ns);
  return saturated_sum(frame, -recorded.first_key.value_or(recorded.poses.front().key));
}

std::int64_t key_of(const FrameFiles& files, PoseKey key) {
  switch (key) {
    case PoseKey::stamp:
      return files.stamp_ns;
    case PoseKey::number:
      return files.number;
    case PoseKey::position:
      break;
  }
  return files.position;
}

/// b - a for a <= b, where an int64 might overflow.
std::uint64_t distance(std::int64_t a, std::int64_t b) {
  return static_cast<std::uint64_t>(b) - static_cast<std::uint64_t>(a);
}

std::optional<PoseSpan> find_span(const std::vector<RecordedPose>& poses, std::int64_t key,
                                  const TimeRules& rules) {
  const auto found = std::lower_bound(poses.begin(), poses.end(), key,
                                      [](const RecordedPose& pose, std::int64_t k) { return pose.key < k; });
  const auto after = static_cast<std::size_t>(found - poses.begin());
  if (found != poses.end() && found->key == key) return PoseSpan{after, after, 0};
  const auto alone = [&](std::size_t i, std::uint64_t away) {
    return away <= rules.tolerance_ns ? std::optional(PoseSpan{i, i, 0}) : std::nullopt;
  };
  if (found == poses.begin()) return alone(0, distance(key, poses.front().key));
  if (found == poses.end()) return alone(poses.size() - 1, distance(poses.back().key, key));
  const std::uint64_t from_before = distance(poses[after - 1].key, key), to_after = distance(key, found->key);
  const std::uint64_t gap = distance(poses[after - 1].key, found->key);
  if (gap <= rules.max_gap_ns)
    return PoseSpan{after - 1, after, static_cast<double>(from_before) / static_cast<double>(gap)};
  return from_before <= to_after ? alone(after - 1, from_before) : alone(after, to_after);
}

/// What to do where the poses are of other times than the frames. `shifted_s` was added to their stamps.
std::string remedy_for_times(const Sequence& sequence, const RecordedPoses& recorded, double shifted_s) {
  const auto& frames = sequence.frames;
  const auto& poses = recorded.poses;
  if (poses.front().key <= frames.back().stamp_ns && poses.back().key >= frames.front().stamp_ns)
    return "The times overlap: raise --pose-gap, or check that the poses belong to this sequence.";
  const std::int64_t offset_ns =
      saturated_sum(offset_of_starts(sequence, recorded), std::llround(shifted_s * 1e9));
  return fmt::format(
      "If only the clocks differ, add --pose-offset {}, or --pose-offset start, which align the first "
      "stamps; "
      "else check that the poses belong to this sequence and share its clock.",
      format_seconds(offset_ns));
}

[[noreturn]] void fail_without_poses(const Sequence& sequence, const RecordedPoses& recorded,
                                     const GivenPosesOptions& options, double shifted_s) {
  if (recorded.key == PoseKey::number)
    throw InputError({recorded.source.string(), 0, "poses of the sequence's frame numbers", "none",
                      "Check that the poses belong to this sequence."});
  throw InputError(
      {recorded.source.string(), 0,
       fmt::format("poses within the time of the frames, {} to {}, at most {} s apart",
                   format_stamp(sequence.frames.front().stamp_ns),
                   format_stamp(sequence.frames.back().stamp_ns), options.max_gap_s),
       fmt::format("{} from {} to {}", recorded.poses.size(), format_stamp(recorded.poses.front().key),
                   format_stamp(recorded.poses.back().key)),
       remedy_for_times(sequence, recorded, shifted_s)});
}

}  // namespace

std::int64_t shift_stamps(const Sequence& sequence, const GivenPosesOptions& options,
                          RecordedPoses& recorded) {
  const bool by_starts = options.align_first_stamps;
  const std::int64_t offset_ns =
      by_starts ? offset_of_starts(sequence, recorded) : std::llround(options.time_offset_s * 1e9);
  for (RecordedPose& pose : recorded.poses) {
    if (!__builtin_add_overflow(pose.key, offset_ns, &pose.key)) continue;
    throw InputError({"time_offset_s", 0, "an offset that leaves the stamps within 292 years of 1970",
                      fmt::format("{}", options.time_offset_s), "Correct the value."});
  }
  if (recorded.first_key) recorded.first_key = saturated_sum(*recorded.first_key, offset_ns);
  if (by_starts)
    recorded.warnings.push_back(fmt::format("{}: the first stamps are aligned by an offset of {} s.",
                                            recorded.source.string(), format_seconds(offset_ns)));
  return offset_ns;
}

PoseSpans spans_of_frames(const Sequence& sequence, const RecordedPoses& recorded,
                          const GivenPosesOptions& options, double shifted_s) {
  const TimeRules rules = rules_for(sequence, recorded, options);
  PoseSpans spans;
  for (const FrameFiles& files : sequence.frames)
    spans.push_back(find_span(recorded.poses, key_of(files, recorded.key), rules));
  const bool has_some =
      std::any_of(spans.begin(), spans.end(), [](const auto& span) { return span.has_value(); });
  if (!has_some) fail_without_poses(sequence, recorded, options, shifted_s);
  return spans;
}

}  // namespace cairn
