// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/trajectory.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/unit_rotation.h"

namespace cairn {
namespace {

constexpr std::string_view kLayout = "t tx ty tz qx qy qz qw";

double parse_coordinate(const TextFile& file, const TextLine& line, std::size_t field,
                        std::string_view name) {
  constexpr double kFarthest = 1e12;  // metres; beyond the planets, and squares stay far from overflow
  const double value = file.number(line, field, name);
  if (std::abs(value) <= kFarthest) return value;
  file.fail(line, fmt::format("{} of at most 1e12 metres", name), fmt::format("{:g}", value),
            fmt::format("Check the order of the columns: {}.", kLayout));
}

}  // namespace

StampedPose parse_tum_pose(const TextFile& file, const TextLine& line, std::size_t first, TimeUnit unit) {
  StampedPose pose;
  if (!parse_stamp_in(unit, line.fields.at(first), pose.stamp_ns)) {
    file.fail(line, "a time stamp in seconds", fmt::format("'{}'", line.fields[first]),
              "Correct or delete the line.");
  }
  const auto place = [&](std::size_t i, std::string_view name) {
    return parse_coordinate(file, line, first + i, name);
  };
  const auto value = [&](std::size_t i, std::string_view name) { return file.number(line, first + i, name); };
  pose.world_from_camera.translation = {place(1, "tx"), place(2, "ty"), place(3, "tz")};
  Eigen::Quaterniond& q = pose.world_from_camera.rotation;
  q = Eigen::Quaterniond(value(7, "qw"), value(4, "qx"), value(5, "qy"), value(6, "qz"));
  const double length = q.norm();
  constexpr double kMaxDeviation =
      0.01;  // rounding to three digits passes, another layout of the columns does not
  if (!(std::abs(length - 1.0) <= kMaxDeviation)) {
    file.fail(line, "a quaternion of length 1", fmt::format("one of length {:.4g}", length),
              fmt::format("Check the order of the columns: {}.", kLayout));
  }
  q = unit_rotation(q);
  return pose;
}

WorldFromCamera parse_matrix_pose(const TextFile& file, const TextLine& line) {
  file.expect_fields(line, 12, "3x4 world_from_camera by rows");
  Eigen::Matrix<double, 3, 4> m;
  for (int i = 0; i < 12; ++i) m(i / 4, i % 4) = file.number(line, static_cast<std::size_t>(i), "the pose");
  const Eigen::Matrix3d r = m.leftCols<3>();
  constexpr double kMaxDeviation = 0.01;  // rounding passes, another layout does not
  const double deviation = deviation_from_rotation(r);
  if (deviation > kMaxDeviation) {
    file.fail(line, "a rotation in columns 1-3, 5-7, 9-11",
              std::isinf(deviation)
                  ? "a matrix that mirrors"
                  : fmt::format("a matrix that is none (R^T R differs from 1 by {:.2g})", deviation),
              "Check the layout: r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz.");
  }
  return WorldFromCamera({nearest_rotation(r), m.col(3)});
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
