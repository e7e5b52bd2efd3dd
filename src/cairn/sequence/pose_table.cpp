// SPDX-License-Identifier: Apache-2.0
// A table of poses of a body with the axes forward, right, down, in surveyors' angles: docs/poses.md.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/geometry/covariance.h"
#include "cairn/sequence/attitude.h"
#include "cairn/sequence/geodetic.h"
#include "cairn/sequence/gps_time.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/recorded_poses.h"
#include "cairn/sequence/table_row.h"
#include "cairn/sequence/table_text.h"

namespace cairn {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

Eigen::Vector3d place_of(const TableRow& row, bool geodetic) {
  constexpr double kFarthest = 1e12;  // metres; squares stay far from overflow
  if (!geodetic) return row.values(kLocal, kFarthest);
  return row.values(kGeodetic, {-90, -180, -1e6}, {90, 360, 1e6});
}

bool has_fix(const TableRow& row, bool geodetic) {
  if (row.lacks(geodetic ? kGeodetic : kLocal) || row.lacks(kAngles)) return false;
  return !geodetic || !is_without_fix(place_of(row, true));
}

RecordedPose parse_row(const TableRow& row, const RowKeys& keys, const TableHeader& header) {
  RecordedPose pose;
  pose.key = row.key(keys);
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

/// Says what the names leave open.
void warn_of_assumptions(const TableHeader& header, RecordedPoses& recorded) {
  if (header.heading_by_yaw)
    recorded.warnings.push_back(fmt::format("{}:{}: yaw is taken as the heading, clockwise from north.",
                                            recorded.source.string(), header.line));
  if (!header.has(TableColumn::week)) return;
  const int leap = leap_seconds_at(recorded.poses.front().key);
  recorded.warnings.push_back(fmt::format(
      "{}:{}: GPS time less {} leap seconds is UTC; if the frames have GPS time, add --pose-offset {}.",
      recorded.source.string(), header.line, leap, leap));
}

}  // namespace

RecordedPoses read_pose_table(const std::filesystem::path& path, TableHeader header) {
  check_table_header(path, header);
  RecordedPoses recorded;
  recorded.source = path;
  recorded.format = "table";
  recorded.subject = PoseSubject::body_forward_right_down;
  recorded.geodetic = header.has(kGeodetic);
  recorded.has_uncertainty = header.has(kPlaceDeviations) || header.has(kAngleDeviations);
  const TextFile file(path, plain_table_text(read_file(path)), separator_of_rows(path));
  const std::vector<TextLine> rows = rows_below(header, file);
  if (rows.empty()) {
    throw InputError({path.string(), 0, "poses, one a line, below the names of the columns", "none",
                      "Check that this is the right file."});
  }
  expect_columns(file, header, rows);
  const RowKeys keys = keys_of_rows(header, rows);
  recorded.key = keys.are_times ? PoseKey::stamp : PoseKey::number;
  PoseCollector collector(recorded);
  for (const TextLine& line : rows) {
    const TableRow row(file, line, header);
    has_fix(row, recorded.geodetic) ? collector.add(file, line, parse_row(row, keys, header))
                                    : collector.leave_out(file, line, row.key(keys));
  }
  collector.finish();
  warn_of_assumptions(header, recorded);
  return recorded;
}

}  // namespace cairn
