// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace cairn {

/// Describes one parameter for people.
struct ParameterRow {
  std::string name;      ///< "tracking.map_radius_px"
  std::string value;     ///< present value; empty: none
  std::string accepted;  ///< "pixels above 0"
  std::string meaning;   ///< sentences on one line
};

/// Formats the rows in columns for a terminal, lines of at most 100 characters.
[[nodiscard]] std::string format_as_text(std::span<const ParameterRow> rows);
/// Formats the rows as a table in Markdown, a line each.
[[nodiscard]] std::string format_as_markdown(std::span<const ParameterRow> rows);

}  // namespace cairn
