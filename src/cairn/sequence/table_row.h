// SPDX-License-Identifier: Apache-2.0
// Private to this room: rows of a file of poses whose columns are known.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/sequence/pose_table_header.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {

/// Describes how the rows of one file are assigned to frames.
struct RowKeys {
  bool are_times = true;                 ///< false: numbers of frames
  TimeUnit unit = TimeUnit::nanosecond;  ///< of times
};

/// Finds the separator of the values by the first row of numbers or, without one, by the first line.
[[nodiscard]] Separator separator_of_rows(const std::filesystem::path& path);

/// Returns the non-empty lines below the header.
[[nodiscard]] std::vector<TextLine> rows_below(const TableHeader& header, const TextFile& file);

/// Infers what the first column holds: a time by its name or by the size of its stamps. A number of a frame
/// that is as large as a stamp since 1970 is a time, too ("frame_id" of 4Seasons).
[[nodiscard]] RowKeys keys_of_rows(const TableHeader& header, const std::vector<TextLine>& rows);

/// Tells whether the first column holds whole numbers of an unstated unit, too small for stamps in
/// nanoseconds.
[[nodiscard]] bool hold_frame_numbers(const TableHeader& header, const std::vector<TextLine>& rows);

/// Reads one row by the columns' names. Throws InputError with the line if a value is invalid.
class TableRow {
 public:
  TableRow(const TextFile& file, const TextLine& line, const TableHeader& header)
      : file_(file), line_(line), header_(header) {}

  /// Returns the row's key: nanoseconds, or the number of a frame.
  [[nodiscard]] std::int64_t key(const RowKeys& keys) const;
  /// Tells whether one of these columns is empty or not finite, as programs write if they know no pose.
  [[nodiscard]] bool lacks(const ColumnTriple& columns) const;
  /// Returns the three values, metres or degrees, each within its limits.
  [[nodiscard]] Eigen::Vector3d values(const ColumnTriple& columns, const Eigen::Vector3d& lowest,
                                       const Eigen::Vector3d& highest) const;
  [[nodiscard]] Eigen::Vector3d values(const ColumnTriple& columns, double limit) const {
    return values(columns, Eigen::Vector3d::Constant(-limit), Eigen::Vector3d::Constant(limit));
  }
  /// Returns three standard deviations, metres or degrees, in [0, limit].
  [[nodiscard]] Eigen::Vector3d deviations(const ColumnTriple& columns, double limit) const;
  /// Returns the quaternion, normalised; its length must be 1 within a hundredth.
  [[nodiscard]] Eigen::Quaterniond quaternion() const;

 private:
  [[nodiscard]] std::string_view field(TableColumn column) const;
  [[nodiscard]] double number(TableColumn column) const;
  [[nodiscard]] std::int64_t week() const;
  [[nodiscard]] std::int64_t of_week(std::int64_t stamp_ns) const;

  const TextFile& file_;
  const TextLine& line_;
  const TableHeader& header_;
};

/// Throws InputError unless all rows have as many values as the header has names. Fewer pass if every row has
/// as many and the columns that are read are among them; more if they are empty.
void expect_columns(const TextFile& file, const TableHeader& header, const std::vector<TextLine>& rows);

}  // namespace cairn
