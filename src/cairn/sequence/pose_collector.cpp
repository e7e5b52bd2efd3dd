// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/pose_collector.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/pose_jumps.h"

namespace cairn {
namespace {

/// Numbers as they were read; q and -q are one rotation.
bool is_same_pose(const RecordedPose& a, const RecordedPose& b) {
  constexpr double kRounding = 1e-12;
  return a.place == b.place && std::abs(a.rotation.dot(b.rotation)) > 1 - kRounding &&
         a.place_covariance == b.place_covariance && a.rotation_covariance == b.rotation_covariance;
}

double distance_m(const RecordedPoses& recorded, const RecordedPose& a, const RecordedPose& b) {
  return recorded.geodetic ? geodetic_distance(a.place, b.place) : (a.place - b.place).norm();
}

}  // namespace

std::string PoseCollector::describe(std::int64_t key) const {
  return recorded_.key == PoseKey::stamp ? format_stamp(key) : fmt::format("{}", key);
}

void PoseCollector::note(const TextFile& file, const TextLine& line, std::string detail,
                         Oddities& oddities) const {
  if (oddities.count++ > 0) return;
  oddities.first = fmt::format("{}:{}", file.path().string(), line.number);
  oddities.detail = std::move(detail);
}

void PoseCollector::add(const TextFile& file, const TextLine& line, const RecordedPose& pose) {
  if (!recorded_.first_key) recorded_.first_key = pose.key;
  if (recorded_.poses.empty() || pose.key > recorded_.poses.back().key) {
    check_speed(file, line, pose);
    recorded_.poses.push_back(pose);
    return;
  }
  const RecordedPose& last = recorded_.poses.back();
  if (pose.key < last.key) {
    const bool by_time = recorded_.key == PoseKey::stamp;
    file.fail(line, fmt::format("a {} after {}", by_time ? "time stamp" : "frame number", describe(last.key)),
              describe(pose.key), by_time ? "Sort the file by time." : "Sort the file by number.");
  }
  if (!is_same_pose(last, pose))
    note(file, line,
         fmt::format("a second pose, {:.3g} m away, at {}", distance_m(recorded_, last, pose),
                     describe(pose.key)),
         repeated_);
}

void PoseCollector::leave_out(const TextFile& file, const TextLine& line, std::int64_t key) {
  if (!recorded_.first_key) recorded_.first_key = key;
  note(file, line, describe(key), left_out_);
}

void PoseCollector::check_speed(const TextFile& file, const TextLine& line, const RecordedPose& pose) {
  if (recorded_.key != PoseKey::stamp || recorded_.poses.empty()) return;
  const RecordedPose& last = recorded_.poses.back();
  const double seconds = 1e-9 * (static_cast<double>(pose.key) - static_cast<double>(last.key));
  const double metres = distance_m(recorded_, last, pose);
  if (is_jump(metres, seconds)) note(file, line, describe_jump(metres, seconds, describe(pose.key)), jumps_);
}

void PoseCollector::finish() {
  constexpr const char* kNoFix = "no position (0 north and 0 east, empty or no number)";
  if (recorded_.poses.empty() && left_out_.count > 0) {
    throw InputError({recorded_.source.string(), 0, "rows with a position",
                      fmt::format("{} with {}", left_out_.count, kNoFix),
                      "Record once the receiver has a fix, or correct the columns."});
  }
  if (left_out_.count > 0) {
    const std::size_t rows = recorded_.poses.size() + static_cast<std::size_t>(left_out_.count);
    recorded_.warnings.push_back(fmt::format("{}: {} of {} rows left out, from {} on: {}.", left_out_.first,
                                             left_out_.count, rows, left_out_.detail, kNoFix));
  }
  if (repeated_.count > 0) {
    recorded_.warnings.push_back(fmt::format("{}: {}; {} such line{} left out, the first pose counts.",
                                             repeated_.first, repeated_.detail, repeated_.count,
                                             repeated_.count == 1 ? "" : "s"));
  }
  if (jumps_.count > 0)
    recorded_.warnings.push_back(
        describe_jumps(fmt::format("{}: {}", jumps_.first, jumps_.detail), jumps_.count));
}

}  // namespace cairn
