// SPDX-License-Identifier: Apache-2.0
// Private to this room: the columns of a table of poses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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
  std_heading
};
inline constexpr std::size_t kTableColumns = 17;

/// Three columns that go together.
using ColumnTriple = std::array<TableColumn, 3>;
inline constexpr ColumnTriple kGeodetic{TableColumn::latitude, TableColumn::longitude, TableColumn::height};
inline constexpr ColumnTriple kLocal{TableColumn::east, TableColumn::north, TableColumn::up};
inline constexpr ColumnTriple kAngles{TableColumn::roll, TableColumn::pitch, TableColumn::heading};
inline constexpr ColumnTriple kPlaceDeviations{TableColumn::std_east, TableColumn::std_north,
                                               TableColumn::std_up};
inline constexpr ColumnTriple kAngleDeviations{TableColumn::std_roll, TableColumn::std_pitch,
                                               TableColumn::std_heading};

[[nodiscard]] std::string_view to_string(TableColumn column);

enum class ColumnUnit { none, second, nanosecond, metre, degree, radian };

struct ColumnPlace {
  std::size_t field = 0;
  ColumnUnit unit = ColumnUnit::none;
};

/// The line that names the columns, the first of the file, perhaps behind a '#'.
struct TableHeader {
  int line = 0;
  std::vector<std::string> names;  ///< as written
  std::array<std::optional<ColumnPlace>, kTableColumns> places;

  [[nodiscard]] const std::optional<ColumnPlace>& place(TableColumn column) const {
    return places.at(static_cast<std::size_t>(column));
  }
  [[nodiscard]] bool has(TableColumn column) const { return place(column).has_value(); }
  [[nodiscard]] bool has(const ColumnTriple& triple) const { return has(triple[0]); }
};

/// Nothing where the first line is none: numbers, or no commas.
[[nodiscard]] std::optional<TableHeader> find_table_header(const std::filesystem::path& path);

/// Complete: a time or a frame, a place, the angles; InputError where something is missing, there twice, of
/// an unknown unit, or where an unknown name may be a misspelt one.
void check_table_header(const std::filesystem::path& path, TableHeader& header);

}  // namespace cairn
