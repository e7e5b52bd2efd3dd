// SPDX-License-Identifier: Apache-2.0
// Private to this room: what the names of columns in a file of poses mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Names the columns of a table of poses.
enum class TableColumn : std::uint8_t {
  time,
  frame,
  latitude,
  longitude,
  height,
  east,
  north,
  up,
  roll,
  pitch,
  heading,
  std_east,
  std_north,
  std_up,
  std_roll,
  std_pitch,
  std_heading,
  week,
  x,
  y,
  z,
  qx,
  qy,
  qz,
  qw,
  std_x,
  std_y,
  std_z,
  std_rx,
  std_ry,
  std_rz
};
inline constexpr std::size_t kTableColumns = 31;

/// Three columns that belong together.
using ColumnTriple = std::array<TableColumn, 3>;
inline constexpr ColumnTriple kGeodetic{TableColumn::latitude, TableColumn::longitude, TableColumn::height};
inline constexpr ColumnTriple kLocal{TableColumn::east, TableColumn::north, TableColumn::up};
inline constexpr ColumnTriple kAngles{TableColumn::roll, TableColumn::pitch, TableColumn::heading};
inline constexpr ColumnTriple kPlaceDeviations{TableColumn::std_east, TableColumn::std_north,
                                               TableColumn::std_up};
inline constexpr ColumnTriple kAngleDeviations{TableColumn::std_roll, TableColumn::std_pitch,
                                               TableColumn::std_heading};
inline constexpr ColumnTriple kPosition{TableColumn::x, TableColumn::y, TableColumn::z};
inline constexpr ColumnTriple kPositionDeviations{TableColumn::std_x, TableColumn::std_y, TableColumn::std_z};
inline constexpr ColumnTriple kRotationDeviations{TableColumn::std_rx, TableColumn::std_ry,
                                                  TableColumn::std_rz};
inline constexpr std::array<TableColumn, 4> kQuaternion{TableColumn::qx, TableColumn::qy, TableColumn::qz,
                                                        TableColumn::qw};

/// Names the quantity of a column.
enum class Quantity : std::uint8_t { time, count, length, angle, none };
/// Names the unit of a column.
enum class ColumnUnit : std::uint8_t {
  none,  ///< the name states none
  second,
  millisecond,
  microsecond,
  nanosecond,
  metre,
  centimetre,
  millimetre,
  degree,
  radian
};

/// Returns the name that messages and docs/poses.md use.
[[nodiscard]] std::string_view to_string(TableColumn column);
/// Returns the quantity of a column.
[[nodiscard]] Quantity quantity_of(TableColumn column);
/// Returns the unit that a text names, or nullopt if it is not one of this quantity. Without text: the unit
/// that docs/poses.md promises, of a time none.
[[nodiscard]] std::optional<ColumnUnit> find_unit(std::string_view text, Quantity quantity);
/// Lists the units of a quantity, for messages: "deg or rad".
[[nodiscard]] std::string unit_choices(Quantity quantity);

/// Holds a column's name without its unit, in lower case with '_' for blanks and other separators.
struct ColumnName {
  std::string base, unit;
};
/// Splits a name and its unit: "Latitude (deg)", "latitude [deg]" and "latitude_deg" are one name.
[[nodiscard]] ColumnName split_name(std::string_view written);

/// Describes the meaning of a column's name.
struct ColumnMeaning {
  TableColumn column = TableColumn::time;
  double factor = 1;  ///< factor of the values: -1 for "down"
};
/// Returns the meaning of a name, or nullopt if it has none. `base` is that of split_name.
[[nodiscard]] std::optional<ColumnMeaning> find_column(const std::string& base);

/// Tells whether the name is that of a numbered component of a quaternion (q0, quat_3), so that it is unknown
/// which one is the scalar.
[[nodiscard]] bool is_numbered_quaternion(const std::string& base);

/// Tells whether the name is of a velocity, an acceleration or another rate, or of its deviation.
[[nodiscard]] bool names_rate(const std::string& base);

/// Returns the names of the columns of a table with angles, for "did you mean".
[[nodiscard]] std::vector<std::string> table_names();

}  // namespace cairn
