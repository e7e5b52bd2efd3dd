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
  x,
  y,
  z,
  qx,
  qy,
  qz,
  qw
};
inline constexpr std::size_t kTableColumns = 24;

/// Three columns that go together.
using ColumnTriple = std::array<TableColumn, 3>;
inline constexpr ColumnTriple kGeodetic{TableColumn::latitude, TableColumn::longitude, TableColumn::height};
inline constexpr ColumnTriple kLocal{TableColumn::east, TableColumn::north, TableColumn::up};
inline constexpr ColumnTriple kAngles{TableColumn::roll, TableColumn::pitch, TableColumn::heading};
inline constexpr ColumnTriple kPlaceDeviations{TableColumn::std_east, TableColumn::std_north,
                                               TableColumn::std_up};
inline constexpr ColumnTriple kAngleDeviations{TableColumn::std_roll, TableColumn::std_pitch,
                                               TableColumn::std_heading};
inline constexpr ColumnTriple kPosition{TableColumn::x, TableColumn::y, TableColumn::z};
inline constexpr std::array<TableColumn, 4> kQuaternion{TableColumn::qx, TableColumn::qy, TableColumn::qz,
                                                        TableColumn::qw};

enum class Quantity : std::uint8_t { time, count, length, angle, none };
enum class ColumnUnit : std::uint8_t {
  none,  ///< the name states none
  second,
  millisecond,
  microsecond,
  nanosecond,
  metre,
  degree,
  radian
};

/// The name that messages and docs/poses.md use.
[[nodiscard]] std::string_view to_string(TableColumn column);
[[nodiscard]] Quantity quantity_of(TableColumn column);
/// Returns nullopt for what is no unit of this quantity. Without text: the unit that docs/poses.md promises,
/// of a time none.
[[nodiscard]] std::optional<ColumnUnit> find_unit(std::string_view text, Quantity quantity);
/// The units of a quantity, for messages: "deg or rad".
[[nodiscard]] std::string unit_choices(Quantity quantity);

/// A column's name without its unit, in lower case with '_' for blanks and other separators.
struct ColumnName {
  std::string base, unit;
};
/// "Latitude (deg)", "latitude [deg]" and "latitude_deg" are one name.
[[nodiscard]] ColumnName split_name(std::string_view written);

struct ColumnMeaning {
  TableColumn column = TableColumn::time;
  double factor = 1;  ///< of the values: -1 for "down"
};
/// Returns nullopt for a name that means nothing here. `base` is that of split_name.
[[nodiscard]] std::optional<ColumnMeaning> find_column(const std::string& base);

/// A quaternion's component that is numbered (q0, quat_3), so that it stays open which one is the scalar.
[[nodiscard]] bool is_numbered_quaternion(const std::string& base);

/// The names of columns of a table in angles, for "did you mean".
[[nodiscard]] std::vector<std::string> table_names();

}  // namespace cairn
