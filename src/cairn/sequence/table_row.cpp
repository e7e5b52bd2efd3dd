// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/table_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/geometry/unit_rotation.h"
#include "cairn/sequence/gps_time.h"
#include "cairn/sequence/table_text.h"

namespace cairn {
namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr const char* kRemedy = "Correct or delete the line.";

std::string_view name_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::millisecond:
      return "milliseconds";
    case TimeUnit::microsecond:
      return "microseconds";
    case TimeUnit::nanosecond:
      return "whole nanoseconds";
    case TimeUnit::second:
      break;
  }
  return "seconds";
}

std::optional<TimeUnit> time_unit_of(ColumnUnit unit) {
  switch (unit) {
    case ColumnUnit::second:
      return TimeUnit::second;
    case ColumnUnit::millisecond:
      return TimeUnit::millisecond;
    case ColumnUnit::microsecond:
      return TimeUnit::microsecond;
    case ColumnUnit::nanosecond:
      return TimeUnit::nanosecond;
    default:
      return std::nullopt;
  }
}

std::size_t key_field(const TableHeader& header) {
  const auto& time = header.place(TableColumn::time);
  return time ? time->field : header.place(TableColumn::frame).value().field;
}

std::vector<std::string_view> keys_in(const TableHeader& header, const std::vector<TextLine>& rows) {
  const std::size_t field = key_field(header);
  std::vector<std::string_view> keys;
  for (const TextLine& line : rows)
    if (field < line.fields.size()) keys.push_back(line.fields[field]);
  return keys;
}

/// Empty, NaN or infinite.
bool says_nothing(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::string lower = lower_case(text);
  return lower.empty() || lower == "nan" || lower == "inf" || lower == "infinity" || lower == "na" ||
         lower == "null" || lower == "none";
}

/// One more than the last column that is read.
std::size_t needed_fields(const TableHeader& header) {
  std::size_t count = 0;
  for (const auto& place : header.places)
    if (place) count = std::max(count, place->field + 1);
  return count;
}

bool has_good_count(const TableHeader& header, const TextLine& line, std::size_t first_count) {
  const std::size_t given = line.fields.size(), named = header.names.size();
  if (given == named || (header.open_ended && given > named)) return true;
  if (given < named) return given == first_count && given >= needed_fields(header);
  return std::all_of(line.fields.begin() + static_cast<std::ptrdiff_t>(named), line.fields.end(),
                     [](std::string_view field) { return field.empty(); });
}

}  // namespace

Separator separator_of_rows(const std::filesystem::path& path) {
  const TextFile file(path, plain_table_text(read_file(path)), Separator::commas);
  const auto& lines = file.lines();
  const auto begins_with_number = [](const TextLine& line) {
    double value = 0;
    const std::string_view first = line.fields.front();
    return parse_number(first.substr(0, first.find_first_of(" \t")), value);
  };
  auto row = std::find_if(lines.begin(), lines.end(), begins_with_number);
  if (row == lines.end()) row = lines.begin();
  return row != lines.end() && row->fields.size() > 1 ? Separator::commas : Separator::blanks;
}

std::vector<TextLine> rows_below(const TableHeader& header, const TextFile& file) {
  std::vector<TextLine> rows;
  for (const TextLine& line : file.lines())
    if (line.number > header.line) rows.push_back(line);
  return rows;
}

RowKeys keys_of_rows(const TableHeader& header, const std::vector<TextLine>& rows) {
  const TimeUnit inferred = infer_time_unit(keys_in(header, rows));
  const auto& time = header.place(TableColumn::time);
  if (!time) return {inferred != TimeUnit::second, inferred};
  return {true, time_unit_of(time->unit).value_or(inferred)};
}

bool hold_frame_numbers(const TableHeader& header, const std::vector<TextLine>& rows) {
  const auto& time = header.place(TableColumn::time);
  if (time && time->unit != ColumnUnit::none) return false;
  const std::vector<std::string_view> keys = keys_in(header, rows);
  const bool are_whole = std::all_of(keys.begin(), keys.end(), [](std::string_view text) {
    std::int64_t number = 0;
    return parse_integer(text, number);
  });
  return are_whole && infer_time_unit(keys) == TimeUnit::second;
}

std::string_view TableRow::field(TableColumn column) const {
  return line_.fields.at(header_.place(column).value().field);
}

double TableRow::number(TableColumn column) const {
  const ColumnSource place = header_.place(column).value();
  const double value = place.factor * file_.number(line_, place.field, to_string(column));
  switch (place.unit) {
    case ColumnUnit::radian:
      return value / kRadian;
    case ColumnUnit::millimetre:
      return value / 1000;
    case ColumnUnit::centimetre:
      return value / 100;
    default:
      return value;
  }
}

std::int64_t TableRow::key(const RowKeys& keys) const {
  const std::size_t field = key_field(header_);
  if (!keys.are_times) return file_.integer(line_, field, header_.has(TableColumn::time) ? "time" : "frame");
  const std::string_view text = line_.fields[field];
  std::int64_t stamp_ns = 0;
  if (parse_stamp_in(keys.unit, text, stamp_ns))
    return header_.has(TableColumn::week) ? utc_from_gps(week(), of_week(stamp_ns)) : stamp_ns;
  file_.fail(line_, fmt::format("a time stamp in {}", name_of(keys.unit)), fmt::format("'{}'", text),
             kRemedy);
}

std::int64_t TableRow::week() const {
  constexpr std::int64_t kLastWeek = 6000;
  const std::int64_t week = file_.integer(line_, header_.place(TableColumn::week).value().field, "week");
  if (week >= 0 && week <= kLastWeek) return week;
  file_.fail(line_, fmt::format("a GPS week from 0 to {}", kLastWeek), fmt::format("{}", week), kRemedy);
}

std::int64_t TableRow::of_week(std::int64_t stamp_ns) const {
  constexpr std::int64_t kTwoWeeksNs = 2 * 604'800'000'000'000;  // programs may count on over a week's end
  if (stamp_ns >= 0 && stamp_ns <= kTwoWeeksNs) return stamp_ns;
  file_.fail(line_, "seconds of the GPS week beside its number", format_seconds(stamp_ns),
             "Delete the column of weeks if the times are complete, or correct the line.");
}

bool TableRow::lacks(const ColumnTriple& columns) const {
  return std::any_of(columns.begin(), columns.end(),
                     [&](TableColumn column) { return says_nothing(field(column)); });
}

Eigen::Vector3d TableRow::values(const ColumnTriple& columns, const Eigen::Vector3d& lowest,
                                 const Eigen::Vector3d& highest) const {
  Eigen::Vector3d result;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const TableColumn column = columns.at(static_cast<std::size_t>(i));
    result[i] = number(column);
    if (result[i] >= lowest[i] && result[i] <= highest[i]) continue;
    file_.fail(line_,
               fmt::format("{} from {:g} to {:g} {}", to_string(column), lowest[i], highest[i],
                           quantity_of(column) == Quantity::length ? "m" : "degrees"),
               fmt::format("{:g}", result[i]), "Check the order and the units of the columns.");
  }
  return result;
}

Eigen::Vector3d TableRow::deviations(const ColumnTriple& columns, double limit) const {
  return values(columns, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(limit));
}

Eigen::Quaterniond TableRow::quaternion() const {
  const Eigen::Quaterniond rotation(number(TableColumn::qw), number(TableColumn::qx), number(TableColumn::qy),
                                    number(TableColumn::qz));
  constexpr double kMaxDeviation = 0.01;  // rounding passes, another layout of the columns does not
  if (std::abs(rotation.norm() - 1.0) <= kMaxDeviation) return unit_rotation(rotation);
  file_.fail(line_, "a quaternion of length 1", fmt::format("one of length {:.4g}", rotation.norm()),
             fmt::format("Check the order of the columns: {}.", fmt::join(header_.names, ", ")));
}

void expect_columns(const TextFile& file, const TableHeader& header, const std::vector<TextLine>& rows) {
  for (const TextLine& line : rows) {
    if (has_good_count(header, line, rows.front().fields.size())) continue;
    file.fail(line, fmt::format("{} values ({})", header.names.size(), fmt::join(header.names, ", ")),
              fmt::format("{}", line.fields.size()),
              &line == rows.data() ? "Correct the names of the columns, or the line." : kRemedy);
  }
}

}  // namespace cairn
