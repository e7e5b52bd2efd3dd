// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/trajectory.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

constexpr std::string_view kLayout = "t tx ty tz qx qy qz qw";

StampedPose parse_pose(const TextFile& file, const TextLine& line) {
  file.expect_fields(line, 8, kLayout);
  StampedPose pose;
  if (!parse_stamp(line.fields[0], pose.stamp_ns)) {
    file.fail(line, "a time stamp in seconds", fmt::format("'{}'", line.fields[0]),
              "Mend or delete the line.");
  }
  const auto value = [&](std::size_t i, std::string_view what) { return file.number(line, i, what); };
  pose.world_from_camera.translation = {value(1, "tx"), value(2, "ty"), value(3, "tz")};
  Eigen::Quaterniond& q = pose.world_from_camera.rotation;
  q = Eigen::Quaterniond(value(7, "qw"), value(4, "qx"), value(5, "qy"), value(6, "qz"));
  const double length = q.norm();
  constexpr double kMaxDeviation =
      0.01;  // rounding to three digits passes, another layout of the columns does not
  if (!(std::abs(length - 1.0) <= kMaxDeviation)) {
    file.fail(line, "a quaternion of length 1", fmt::format("one of length {:.4g}", length),
              fmt::format("Check the order of the columns: {}.", kLayout));
  }
  q.normalize();
  return pose;
}

}  // namespace

Trajectory read_tum_trajectory(const std::filesystem::path& path) {
  const TextFile file(path);
  Trajectory trajectory;
  trajectory.reserve(file.lines().size());
  for (const TextLine& line : file.lines()) {
    const StampedPose pose = parse_pose(file, line);
    if (!trajectory.empty() && pose.stamp_ns <= trajectory.back().stamp_ns) {
      file.fail(line, fmt::format("a time stamp after {}", format_stamp(trajectory.back().stamp_ns)),
                format_stamp(pose.stamp_ns), "Sort the file by time and remove double stamps.");
    }
    trajectory.push_back(pose);
  }
  if (trajectory.empty()) {
    throw InputError({path.string(), 0, fmt::format("poses, one a line: {}", kLayout), "none",
                      "Check that this is the right file."});
  }
  return trajectory;
}

std::string format_tum_trajectory(const Trajectory& trajectory) {
  std::string text = "# t tx ty tz qx qy qz qw  (seconds, metres; world_from_camera)\n";
  for (const auto& [stamp_ns, pose] : trajectory) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    text += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", format_stamp(stamp_ns),
                        t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace cairn
