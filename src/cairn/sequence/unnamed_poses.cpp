// SPDX-License-Identifier: Apache-2.0
// Poses in rows of numbers whose columns no line names: which layout it is, their number and the first row
// tell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/sequence/pose_collector.h"
#include "cairn/sequence/recorded_poses.h"
#include "cairn/sequence/table_row.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTum = "t tx ty tz qx qy qz qw";
constexpr std::size_t kTumFields = 8, kMatrix = 12, kWholeMatrix = 16;

RecordedPoses empty_poses(const fs::path& source, const char* format) {
  RecordedPoses recorded;
  recorded.source = source;
  recorded.format = format;
  return recorded;
}

bool begins_with_number(const TextLine& line) {
  double value = 0;
  return parse_number(line.fields.front(), value);
}

/// Lines before the first number are no poses. Returns all lines if none begins with a number.
std::vector<TextLine> rows_of_numbers(const TextFile& file) {
  const auto& lines = file.lines();
  const auto first = std::find_if(lines.begin(), lines.end(), begins_with_number);
  return first == lines.end() ? lines : std::vector<TextLine>(first, lines.end());
}

std::vector<std::string_view> first_fields(const std::vector<TextLine>& rows) {
  std::vector<std::string_view> fields;
  for (const TextLine& line : rows) fields.push_back(line.fields.front());
  return fields;
}

bool are_whole(const std::vector<std::string_view>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](std::string_view text) {
    std::int64_t number = 0;
    return parse_integer(text, number);
  });
}

// ---- the file as a whole ----

[[noreturn]] void fail_whole(const TextFile& file, std::string found) {
  throw InputError(
      {file.path().string(), 0,
       fmt::format("poses: 8 values a line, {} (TUM), 12 of a 3x4 matrix (KITTI), or a first line that "
                   "names the columns",
                   kTum),
       std::move(found),
       "Name the columns in a first line such as time,x,y,z,qx,qy,qz,qw (docs/poses.md), or name another "
       "file."});
}

/// Says of rows that are all alike and no poses what they are.
void expect_poses(const TextFile& file, const std::vector<TextLine>& rows) {
  if (rows.empty()) {
    throw InputError({file.path().string(), 0, fmt::format("poses, one a line: {}", kTum), "none",
                      "Check that this is the right file."});
  }
  if (rows.size() < 2) return;
  if (std::none_of(rows.begin(), rows.end(), begins_with_number))
    fail_whole(file, fmt::format("{} lines, none of which begins with a number", rows.size()));
  const std::size_t count = rows.front().fields.size();
  const bool are_alike = std::all_of(rows.begin(), rows.end(),
                                     [&](const TextLine& line) { return line.fields.size() == count; });
  if (are_alike && count < kTumFields)
    fail_whole(file,
               fmt::format("{} value{} in each of {} lines", count, count == 1 ? "" : "s", rows.size()));
}

// ---- one row ----

/// The line without its first fields.
TextLine without_first(const TextLine& line, std::size_t count) {
  return {line.number, {line.fields.begin() + static_cast<std::ptrdiff_t>(count), line.fields.end()}};
}

/// Returns whether so many fields from `first` on are a vector of length 1.
bool is_unit(const TextLine& line, std::size_t first, std::size_t count) {
  double squared = 0;
  for (std::size_t field = first; field < first + count; ++field) {
    double value = 0;
    if (!parse_number(line.fields[field], value)) return false;
    squared += value * value;
  }
  constexpr double kMaxDeviation = 0.02;  // rounding passes, other columns do not
  return std::abs(squared - 1) <= kMaxDeviation;
}

/// Returns whether the fields from `first` on are a matrix, perhaps one that mirrors, rather than TUM's with
/// more behind; what is neither is taken for a matrix, whose reader says why it is none.
bool is_matrix(const TextLine& line, std::size_t first) {
  const bool has_unit_rows =
      is_unit(line, first, 3) && is_unit(line, first + 4, 3) && is_unit(line, first + 8, 3);
  return has_unit_rows || !is_unit(line, 4, 4);
}

WorldFromCamera parse_whole_matrix(const TextFile& file, const TextLine& line) {
  const double last[] = {file.number(line, 12, "the pose"), file.number(line, 13, "the pose"),
                         file.number(line, 14, "the pose"), file.number(line, 15, "the pose")};
  if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
    file.fail(line, "a last row 0 0 0 1", "another",
              "Check that the matrix is written by rows, the translation in the last column.");
  return parse_matrix_pose(file, {line.number, {line.fields.begin(), line.fields.begin() + kMatrix}});
}

/// Describes the rows of one file.
struct RowLayout {
  std::size_t fields = kTumFields;
  bool has_key = true;  ///< a stamp or a number in the first column
  bool is_matrix = false;
};

RowLayout layout_of(const TextLine& line) {
  RowLayout layout;
  layout.fields = line.fields.size();
  const std::size_t key = layout.fields % 4;  // 12, 13, 16, 17
  const bool may_be_matrix =
      key < 2 && (layout.fields - key == kMatrix || layout.fields - key == kWholeMatrix);
  layout.is_matrix = may_be_matrix && is_matrix(line, key);
  layout.has_key = !layout.is_matrix || key == 1;
  if (!layout.is_matrix && layout.fields < kTumFields) layout.fields = kTumFields;
  return layout;
}

std::string describe(const RowLayout& layout) {
  if (!layout.is_matrix) return std::string(kTum) + (layout.fields > kTumFields ? ", more behind" : "");
  const std::string matrix =
      fmt::format("{}x4 world_from_camera by rows", layout.fields < kWholeMatrix ? 3 : 4);
  return layout.has_key ? "a number or a stamp and " + matrix : matrix;
}

Rigid3 parse_matrix(const TextFile& file, const TextLine& line) {
  return line.fields.size() == kMatrix ? parse_matrix_pose(file, line) : parse_whole_matrix(file, line);
}

RecordedPose parse_row(const TextFile& file, const TextLine& line, const RowLayout& layout, bool by_number,
                       TimeUnit unit) {
  if (!layout.is_matrix) {
    const auto [stamp_ns, pose] = parse_tum_pose(file, line, 0, unit);
    return recorded_pose(by_number ? file.integer(line, 0, "the number") : stamp_ns, pose);
  }
  std::int64_t key = 0;
  if (by_number) {
    key = file.integer(line, 0, "the number");
  } else if (!parse_stamp_in(unit, line.fields[0], key)) {
    file.fail(line, "a time stamp", fmt::format("'{}'", line.fields[0]), "Correct or delete the line.");
  }
  return recorded_pose(key, parse_matrix(file, without_first(line, 1)));
}

// ---- all rows ----

RecordedPoses read_by_position(const TextFile& file, const std::vector<TextLine>& rows,
                               const RowLayout& layout) {
  RecordedPoses recorded = empty_poses(file.path(), "KITTI");
  recorded.key = PoseKey::position;
  for (const TextLine& line : rows) {
    file.expect_fields(line, layout.fields, describe(layout));
    const auto position = static_cast<std::int64_t>(recorded.poses.size());
    recorded.poses.push_back(recorded_pose(position, parse_matrix(file, line)));
  }
  return recorded;
}

/// Matrices behind whole numbers belong to frames; TUM's rows only if they may.
RecordedPoses read_by_key(const TextFile& file, const std::vector<TextLine>& rows, const RowLayout& layout,
                          bool may_have_numbers) {
  RecordedPoses recorded = empty_poses(file.path(), layout.is_matrix ? "KITTI" : "TUM");
  const std::vector<std::string_view> keys = first_fields(rows);
  const TimeUnit unit = infer_time_unit(keys);
  const bool by_number =
      (may_have_numbers || layout.is_matrix) && unit == TimeUnit::second && are_whole(keys);
  if (by_number) recorded.key = PoseKey::number;
  PoseCollector collector(recorded);
  for (const TextLine& line : rows) {
    file.expect_fields(line, layout.fields, describe(layout));
    collector.add(file, line, parse_row(file, line, layout, by_number, unit));
  }
  collector.finish();
  if (!layout.is_matrix && separator_of_rows(file.path()) == Separator::commas)
    recorded.warnings.push_back(
        fmt::format("{}: no line names its columns: taken as {}.", file.path().string(), kTum));
  return recorded;
}

// ---- g2o ----

bool is_graph(const TextFile& file) {
  return std::any_of(file.lines().begin(), file.lines().end(), [](const TextLine& line) {
    return line.fields[0] == "VERTEX_SE3:QUAT" || line.fields[0] == "VERTEX_SE2";
  });
}

Rigid3 parse_planar(const TextFile& file, const TextLine& line) {
  file.expect_fields(line, 5, "VERTEX_SE2 id x y theta");
  const Eigen::AngleAxisd turn(file.number(line, 4, "theta"), Eigen::Vector3d::UnitZ());
  return {Eigen::Quaterniond(turn), {file.number(line, 2, "x"), file.number(line, 3, "y"), 0}};
}

Rigid3 parse_vertex(const TextFile& file, const TextLine& line) {
  if (line.fields[0] == "VERTEX_SE2") return parse_planar(file, line);
  file.expect_fields(line, 9, "VERTEX_SE3:QUAT id x y z qx qy qz qw");
  TextLine pose = without_first(line, 1);
  pose.fields[0] = "0";  // the id, which may be larger than any stamp
  return parse_tum_pose(file, pose, 0).world_from_camera;
}

RecordedPoses read_graph(const TextFile& file) {
  RecordedPoses recorded = empty_poses(file.path(), "g2o");
  recorded.key = PoseKey::number;
  for (const TextLine& line : file.lines()) {
    if (!line.fields[0].starts_with("VERTEX_SE")) continue;
    const Rigid3 pose = parse_vertex(file, line);
    recorded.poses.push_back(recorded_pose(file.integer(line, 1, "the vertex id"), pose));
  }
  auto& poses = recorded.poses;
  std::sort(poses.begin(), poses.end(),
            [](const RecordedPose& a, const RecordedPose& b) { return a.key < b.key; });
  const auto twice =
      std::adjacent_find(poses.begin(), poses.end(),
                         [](const RecordedPose& a, const RecordedPose& b) { return a.key == b.key; });
  if (twice != poses.end()) {
    throw InputError({file.path().string(), 0, "each vertex once",
                      fmt::format("vertex {} a second time", twice->key), "Delete one."});
  }
  return recorded;
}

/// EuRoC's rows begin with whole nanoseconds; with decimal seconds between commas, eight values are TUM's.
bool is_asl(const fs::path& path, const std::vector<TextLine>& rows) {
  if (separator_of_rows(path) != Separator::commas) return false;
  const auto is_decimal = [](const TextLine& line) {
    return line.fields.size() == kTumFields && line.fields[0].find('.') != std::string_view::npos;
  };
  return rows.empty() || !std::all_of(rows.begin(), rows.end(), is_decimal);
}

}  // namespace

RecordedPose recorded_pose(std::int64_t key, const Rigid3& world_from_subject) {
  RecordedPose pose;
  pose.key = key;
  pose.place = world_from_subject.translation;
  pose.rotation = world_from_subject.rotation;
  return pose;
}

RecordedPoses read_unnamed_poses(const fs::path& path, bool may_have_numbers) {
  const TextFile file(path, Separator::any);
  if (is_graph(file)) return read_graph(file);
  const std::vector<TextLine> rows = rows_of_numbers(file);
  if (is_asl(path, rows)) return read_unnamed_asl_poses(path);
  expect_poses(file, rows);
  const RowLayout layout = layout_of(rows.front());
  return layout.has_key ? read_by_key(file, rows, layout, may_have_numbers)
                        : read_by_position(file, rows, layout);
}

}  // namespace cairn
