// SPDX-License-Identifier: Apache-2.0
// A table of poses of a body with the axes forward, right, down, in surveyors' angles: docs/poses.md.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/geometry/covariance.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/pose_table_header.h"
#include "cairn/sequence/recorded_poses.h"

namespace cairn {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// One row of the table, its fields by the columns' names.
class Row {
 public:
  Row(const TextFile& file, const TextLine& line, const TableHeader& header)
      : file_(file), line_(line), header_(header) {}

  [[nodiscard]] std::int64_t key() const;
  /// The three values, metres or degrees, each within its limit.
  [[nodiscard]] Eigen::Vector3d values(const ColumnTriple& columns, const Eigen::Vector3d& lowest,
                                       const Eigen::Vector3d& highest) const;
  [[nodiscard]] Eigen::Vector3d values(const ColumnTriple& columns, double limit) const {
    return values(columns, Eigen::Vector3d::Constant(-limit), Eigen::Vector3d::Constant(limit));
  }
  [[nodiscard]] Eigen::Vector3d deviations(const ColumnTriple& columns, double limit) const {
    return values(columns, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(limit));
  }

 private:
  [[nodiscard]] std::int64_t stamp(const ColumnPlace& place) const;

  const TextFile& file_;
  const TextLine& line_;
  const TableHeader& header_;
};

std::int64_t Row::stamp(const ColumnPlace& place) const {
  const std::string_view text = line_.fields[place.field];
  std::int64_t stamp_ns = 0;
  const bool in_ns = place.unit == ColumnUnit::nanosecond;
  if (in_ns ? parse_integer(text, stamp_ns) : parse_stamp(text, stamp_ns)) return stamp_ns;
  file_.fail(line_, in_ns ? "a time stamp in whole nanoseconds" : "a time stamp in seconds",
             fmt::format("'{}'", text), "Mend or delete the line.");
}

std::int64_t Row::key() const {
  if (const auto& time = header_.place(TableColumn::time)) return stamp(*time);
  return file_.integer(line_, header_.place(TableColumn::frame)->field, "frame");
}

Eigen::Vector3d Row::values(const ColumnTriple& columns, const Eigen::Vector3d& lowest,
                            const Eigen::Vector3d& highest) const {
  Eigen::Vector3d result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const TableColumn column = columns.at(static_cast<std::size_t>(i));
    const ColumnPlace place = header_.place(column).value();
    const double value = file_.number(line_, place.field, to_string(column));
    result[i] = place.unit == ColumnUnit::radian ? value / kRadian : value;
    if (result[i] >= lowest[i] && result[i] <= highest[i]) continue;
    file_.fail(line_,
               fmt::format("{} from {:g} to {:g} {}", to_string(column), lowest[i], highest[i],
                           place.unit == ColumnUnit::metre ? "m" : "degrees"),
               fmt::format("{:g}", result[i]), "Check the order and the units of the columns.");
  }
  return result;
}

Eigen::Vector3d place_of(const Row& row, bool geodetic) {
  constexpr double kFarthest = 1e12;  // metres; squares stay far from overflow
  if (!geodetic) return row.values(kLocal, kFarthest);
  return row.values(kGeodetic, {-90, -180, -1e6}, {90, 360, 1e6});
}

RecordedPose parse_row(const Row& row, const TableHeader& header) {
  RecordedPose pose;
  pose.key = row.key();
  pose.place = place_of(row, header.has(kGeodetic));
  const Eigen::Vector3d angles = kRadian * row.values(kAngles, {-360, -90, -360}, {360, 90, 360});
  const Attitude ned_from_body{angles[0], angles[1], angles[2]};
  pose.rotation = (enu_from_ned() * rotation_of(ned_from_body)).normalized();
  constexpr double kLargest = 1e6;  // metres; knows nothing
  if (header.has(kPlaceDeviations))
    pose.place_covariance = covariance_of(row.deviations(kPlaceDeviations, kLargest));
  if (header.has(kAngleDeviations)) {
    const Eigen::Matrix3d turn = enu_from_ned().toRotationMatrix() * turn_by_angles(ned_from_body);
    pose.rotation_covariance =
        propagate_covariance(turn, covariance_of(kRadian * row.deviations(kAngleDeviations, 180)));
  }
  return pose;
}

}  // namespace

bool is_pose_table(const std::filesystem::path& path) {
  return find_table_header(path).has_value();
}

RecordedPoses read_pose_table(const std::filesystem::path& path) {
  auto header = find_table_header(path);
  require(header.has_value(), "the file is a table of poses");
  check_table_header(path, *header);
  RecordedPoses recorded;
  recorded.source = path;
  recorded.format = "table";
  recorded.key = header->has(TableColumn::frame) ? PoseKey::number : PoseKey::stamp;
  recorded.subject = PoseSubject::body_forward_right_down;
  recorded.geodetic = header->has(kGeodetic);
  recorded.has_uncertainty = header->has(kPlaceDeviations) || header->has(kAngleDeviations);
  const TextFile file(path, Separator::commas);
  for (const TextLine& line : file.lines()) {
    if (line.number <= header->line) continue;
    file.expect_fields(line, header->names.size(), fmt::format("{}", fmt::join(header->names, ", ")));
    append_pose(file, line, parse_row(Row(file, line, *header), *header), recorded);
  }
  if (recorded.poses.empty()) {
    throw InputError({path.string(), 0, "poses, one a line, below the names of the columns", "none",
                      "Check that this is the right file."});
  }
  return recorded;
}

}  // namespace cairn
