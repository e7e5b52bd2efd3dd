// SPDX-License-Identifier: Apache-2.0
// Poses with quaternions in columns: named ones in any order, and EuRoC's without names.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/asl_sensor.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/recorded_poses.h"
#include "cairn/sequence/table_row.h"
#include "cairn/sequence/table_text.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kFarthest = 1e12;  // metres; squares stay far from overflow

/// Where the body is on what the poses are of: a sensor.yaml beside them says which sensor was tracked.
Rigid3 tracked_from_body(const fs::path& path) {
  const fs::path sensor = path.parent_path() / "sensor.yaml";
  return fs::exists(sensor) ? read_body_from_sensor(sensor).inverse() : Rigid3{};
}

/// EuRoC's own names say that the poses are of its body, "p_RS_R_x"; so do its folders.
bool is_of_asl_layout(const fs::path& path, const TableHeader& header) {
  const bool by_names = std::any_of(header.names.begin(), header.names.end(), [](const std::string& name) {
    return name.find("_RS_") != std::string::npos;
  });
  return by_names || path.filename() == "data.csv" || fs::exists(path.parent_path() / "sensor.yaml");
}

/// Sets the covariances of independent errors along and about the axes of the world.
void read_deviations(const TableRow& row, const TableHeader& header, RecordedPose& pose) {
  constexpr double kLargest = 1e6;  // metres; knows nothing
  if (header.has(kPositionDeviations))
    pose.place_covariance = covariance_of(row.deviations(kPositionDeviations, kLargest));
  if (header.has(kRotationDeviations))
    pose.rotation_covariance =
        covariance_of(std::numbers::pi / 180 * row.deviations(kRotationDeviations, 180));
}

RecordedPose parse_row(const TableRow& row, const RowKeys& keys, const Rigid3& tracked_from_subject) {
  const Rigid3 world_from_subject =
      Rigid3{row.quaternion(), row.values(kPosition, kFarthest)} * tracked_from_subject;
  RecordedPose pose;
  pose.key = row.key(keys);
  pose.place = world_from_subject.translation;
  pose.rotation = world_from_subject.rotation;
  return pose;
}

void read_rows(const TextFile& file, const TableHeader& header, const RowKeys& keys,
               const std::vector<TextLine>& rows, RecordedPoses& recorded) {
  recorded.key = keys.are_times ? PoseKey::stamp : PoseKey::number;
  const bool of_body = recorded.subject == PoseSubject::body_of_sensor;
  const Rigid3 tracked_from_subject = of_body ? tracked_from_body(file.path()) : Rigid3{};
  PoseCollector collector(recorded);
  for (const TextLine& line : rows) {
    const TableRow row(file, line, header);
    if (row.lacks(kPosition)) {
      collector.leave_out(file, line, row.key(keys));
      continue;
    }
    RecordedPose pose = parse_row(row, keys, tracked_from_subject);
    if (recorded.has_uncertainty) read_deviations(row, header, pose);
    collector.add(file, line, pose);
  }
  collector.finish();
}

void expect_some(const fs::path& path, const std::vector<TextLine>& rows) {
  if (!rows.empty()) return;
  throw InputError({path.string(), 0, "poses, one a line, below the names of the columns", "none",
                    "Check that this is the right file."});
}

/// EuRoC's columns, for files that name none.
TableHeader asl_header() {
  TableHeader header;
  header.names = {"stamp", "px", "py", "pz", "qw", "qx", "qy", "qz"};
  header.separator = Separator::commas;
  header.open_ended = true;
  const auto put = [&](TableColumn column, std::size_t field, ColumnUnit unit) {
    header.places.at(static_cast<std::size_t>(column)) = ColumnSource{field, unit};
  };
  put(TableColumn::time, 0, ColumnUnit::nanosecond);
  for (std::size_t i = 0; i < 3; ++i) put(kPosition.at(i), 1 + i, ColumnUnit::metre);
  for (std::size_t i = 0; i < 4; ++i) put(kQuaternion.at(i), 4 + (i + 1) % 4, ColumnUnit::none);
  return header;
}

/// Lines before the first number are no poses.
std::vector<TextLine> rows_of_numbers(const TextFile& file) {
  double value = 0;
  const auto& lines = file.lines();
  const auto first = std::find_if(lines.begin(), lines.end(),
                                  [&](const TextLine& line) { return parse_number(line.fields[0], value); });
  return first == lines.end() ? lines : std::vector<TextLine>(first, lines.end());
}

void expect_asl_columns(const TextFile& file, const TableHeader& header, const std::vector<TextLine>& rows) {
  const std::string layout = fmt::format("{}, ...", fmt::join(header.names, ", "));
  const auto is_short = [&](const TextLine& line) { return line.fields.size() < header.names.size(); };
  const auto first = std::find_if(rows.begin(), rows.end(), is_short);
  if (first == rows.end()) return;
  const std::string found = fmt::format("{}", first->fields.size());
  if (!std::all_of(rows.begin(), rows.end(), is_short))
    file.fail(*first, fmt::format("8 values ({})", layout), found, "Correct or delete the line.");
  file.fail(*first, fmt::format("8 values ({}), or a first line that names the columns", layout), found,
            "Add a line with the names of the columns (docs/poses.md).");
}

}  // namespace

RecordedPoses read_quaternion_table(const fs::path& path, TableHeader header, bool may_have_numbers) {
  check_quaternion_header(path, header);
  RecordedPoses recorded;
  recorded.source = path;
  const TextFile file(path, plain_table_text(read_file(path)), separator_of_rows(path));
  const bool has_blanks = header.separator == Separator::blanks;
  if (is_of_asl_layout(path, header)) {
    recorded.format = "EuRoC";
    recorded.subject = PoseSubject::body_of_sensor;
  } else {
    recorded.format = has_blanks ? "TUM" : "table";
    recorded.subject = has_blanks ? PoseSubject::camera : PoseSubject::not_stated;
    recorded.has_uncertainty = header.has(kPositionDeviations) || header.has(kRotationDeviations);
  }
  const std::vector<TextLine> rows = rows_below(header, file);
  expect_some(path, rows);
  expect_columns(file, header, rows);
  RowKeys keys = keys_of_rows(header, rows);
  if (may_have_numbers && has_blanks && hold_frame_numbers(header, rows)) keys.are_times = false;
  read_rows(file, header, keys, rows, recorded);
  return recorded;
}

RecordedPoses read_unnamed_asl_poses(const fs::path& path) {
  const TextFile file(path, Separator::commas);
  const TableHeader header = asl_header();
  const std::vector<TextLine> rows = rows_of_numbers(file);
  expect_some(path, rows);
  expect_asl_columns(file, header, rows);
  RecordedPoses recorded;
  recorded.source = path;
  recorded.format = "EuRoC";
  recorded.subject = PoseSubject::body_of_sensor;
  read_rows(file, header, {true, TimeUnit::nanosecond}, rows, recorded);
  return recorded;
}

}  // namespace cairn
