// SPDX-License-Identifier: Apache-2.0
// Smoothed best estimates of trajectory, SBET, as Applanix POSPac and others write them: records of 17
// doubles, least significant byte first, angles in radians.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "records are read as they lie in memory");

/// Values: 0 time, 1 latitude, 2 longitude, 3 altitude, 4 to 6 velocity, 7 roll, 8 pitch, 9 heading from the
/// wander axis, 10 wander angle, 11 to 16 acceleration and rates.
using SbetRecord = std::array<double, 17>;
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kDegrees = 180 / std::numbers::pi;

bool is_within(double value, double limit) {
  return std::abs(value) <= limit;  // false for NaN
}

/// The time is that of the GPS week, which may run on over the week's end, or of the day.
bool is_plausible(const SbetRecord& r) {
  constexpr double kLongest = 2 * 604'800, kHighest = 1e6;
  return r[0] >= 0 && r[0] <= kLongest && is_within(r[1], kTurn / 4) && is_within(r[2], kTurn) &&
         is_within(r[3], kHighest) && is_within(r[7], kTurn) && is_within(r[8], kTurn / 4) &&
         is_within(r[9], 2 * kTurn) && is_within(r[10], 2 * kTurn);
}

SbetRecord record_at(std::string_view contents, std::size_t i) {
  SbetRecord record{};
  std::memcpy(record.data(), contents.data() + i * sizeof record, sizeof record);
  return record;
}

RecordedPose pose_of(const SbetRecord& record) {
  RecordedPose pose;
  pose.key = std::llround(record[0] * 1e9);
  pose.place = {record[1] * kDegrees, record[2] * kDegrees, record[3]};
  pose.rotation = (enu_from_ned() * rotation_of({record[7], record[8], record[9] - record[10]})).normalized();
  return pose;
}

[[noreturn]] void fail(const fs::path& path, std::size_t i, const char* expected, std::string found) {
  throw InputError({path.string(), 0, expected, fmt::format("{} in record {}", found, i + 1),
                    "Export the trajectory again."});
}

}  // namespace

bool is_sbet(const fs::path& path) {
  std::error_code ignored;
  const auto size = fs::file_size(path, ignored);
  if (ignored || size == 0 || size % sizeof(SbetRecord) != 0) return false;
  const std::string contents = read_file(path);
  const bool is_text =
      contents.substr(0, sizeof(SbetRecord)).find_first_of(std::string_view("\0\1\2\3\4\5", 6)) ==
      std::string::npos;
  return !is_text && is_plausible(record_at(contents, 0));
}

RecordedPoses read_sbet(const fs::path& path) {
  const std::string contents = read_file(path);
  RecordedPoses recorded;
  recorded.source = path;
  recorded.format = "SBET";
  recorded.subject = PoseSubject::body_forward_right_down;
  recorded.geodetic = true;
  for (std::size_t i = 0; i < contents.size() / sizeof(SbetRecord); ++i) {
    const SbetRecord record = record_at(contents, i);
    if (!is_plausible(record))
      fail(path, i,
           "time (s), latitude, longitude (rad), altitude (m), roll, pitch, heading, wander angle (rad)",
           fmt::format("{:g}, {:g}, {:g}, {:g}, {:g}, {:g}, {:g}, {:g}", record[0], record[1], record[2],
                       record[3], record[7], record[8], record[9], record[10]));
    const RecordedPose pose = pose_of(record);
    if (!recorded.poses.empty() && pose.key <= recorded.poses.back().key)
      fail(path, i, "times that increase", fmt::format("{} s", record[0]));
    recorded.poses.push_back(pose);
  }
  recorded.first_key = recorded.poses.front().key;
  recorded.warnings.push_back(
      fmt::format("{}: its times are seconds of the GPS week (or of the day), which the file does not name; "
                  "--pose-offset adds what is missing. Heights are taken as above the ellipsoid.",
                  path.string()));
  return recorded;
}

}  // namespace cairn
