// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/asl_poses.h"

#include <fmt/format.h>

#include <cmath>

#include "cairn/sequence/asl_sensor.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

Rigid3 parse_pose(const TextFile& file, const TextLine& line) {
  constexpr std::string_view kLayout = "stamp, px, py, pz, qw, qx, qy, qz, ...";
  const std::size_t given = line.fields.size();
  if (given < 8) file.expect_fields(line, 8, kLayout);
  const auto value = [&](std::size_t i, std::string_view name) { return file.number(line, i, name); };
  const Eigen::Quaterniond rotation(value(4, "qw"), value(5, "qx"), value(6, "qy"), value(7, "qz"));
  constexpr double kMaxDeviation = 0.01;  // rounding passes, another layout of the columns does not
  if (!(std::abs(rotation.norm() - 1.0) <= kMaxDeviation)) {
    file.fail(line, "a quaternion of length 1", fmt::format("one of length {:.4g}", rotation.norm()),
              fmt::format("Check the order of the columns: {}.", kLayout));
  }
  return {rotation.normalized(), {value(1, "px"), value(2, "py"), value(3, "pz")}};
}

}  // namespace

std::int64_t parse_asl_stamp(const TextFile& file, const TextLine& line, const std::int64_t* before) {
  std::int64_t stamp_ns = 0;
  if (!parse_integer(line.fields[0], stamp_ns)) {
    file.fail(line, "a time stamp in whole nanoseconds", fmt::format("'{}'", line.fields[0]),
              "Mend or delete the line.");
  }
  if (before != nullptr && stamp_ns <= *before) {
    file.fail(line, fmt::format("a time stamp after {}", *before), fmt::format("{}", stamp_ns),
              "Sort the file by time and remove double stamps.");
  }
  return stamp_ns;
}

std::vector<StampedBodyPose> read_asl_poses(const fs::path& data_csv) {
  const fs::path sensor = data_csv.parent_path() / "sensor.yaml";
  const Rigid3 tracked_from_body = fs::exists(sensor) ? read_body_from_sensor(sensor).inverse() : Rigid3{};
  const TextFile file(data_csv, Separator::commas);
  std::vector<StampedBodyPose> poses;
  for (const TextLine& line : file.lines()) {
    const std::int64_t stamp_ns =
        parse_asl_stamp(file, line, poses.empty() ? nullptr : &poses.back().stamp_ns);
    poses.push_back({stamp_ns, parse_pose(file, line) * tracked_from_body});
  }
  return poses;
}

}  // namespace cairn
