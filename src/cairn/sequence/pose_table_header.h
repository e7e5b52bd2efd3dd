// SPDX-License-Identifier: Apache-2.0
// Private to this room: the line that names the columns of a file of poses.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/sequence/pose_columns.h"

namespace cairn {

/// Describes a column of a file: its position, unit and factor.
struct ColumnSource {
  std::size_t field = 0;
  ColumnUnit unit = ColumnUnit::none;
  double factor = 1;  ///< factor of the values
};

/// Describes the last line before the poses that names columns, perhaps behind a '#'.
struct TableHeader {
  int line = 0;
  std::vector<std::string> names;           ///< as written
  Separator separator = Separator::blanks;  ///< between the names; the rows may have another one
  bool open_ended = false;                  ///< "..." follows the names
  bool heading_by_yaw = false;              ///< set by check_table_header
  std::array<std::optional<ColumnSource>, kTableColumns> places;  ///< set by check_table_header

  /// Returns the source of a column, nullopt if the table lacks it.
  [[nodiscard]] const std::optional<ColumnSource>& place(TableColumn column) const {
    return places.at(static_cast<std::size_t>(column));
  }
  [[nodiscard]] bool has(TableColumn column) const { return place(column).has_value(); }
  [[nodiscard]] bool has(const ColumnTriple& triple) const { return has(triple[0]); }
};

/// Finds the header. Returns nullopt if no line before the first row of numbers names columns. A line without
/// '#' that has commas names columns even if none of the names is known, unless the rows have more values.
[[nodiscard]] std::optional<TableHeader> find_table_header(const std::filesystem::path& path);

/// Tells whether the names are of poses with quaternions, by whatever names, complete or not, or of positions
/// alone.
[[nodiscard]] bool names_quaternions(const TableHeader& header);

/// Finds the columns of a table with angles: a time or a frame, a position, the angles. Throws InputError if
/// a column is missing, occurs twice or has an unknown unit, or if an unknown name may be a misspelt one.
void check_table_header(const std::filesystem::path& path, TableHeader& header);

/// Finds the columns of a table with quaternions: a time or a frame, x, y, z, qx, qy, qz, qw, and perhaps
/// standard deviations std_x, std_y, std_z and std_rx, std_ry, std_rz. Leaves out other columns. Throws
/// InputError if a column is missing, occurs twice or has an unknown unit, or if the quaternion's components
/// are numbered.
void check_quaternion_header(const std::filesystem::path& path, TableHeader& header);

}  // namespace cairn
