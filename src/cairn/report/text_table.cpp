// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/text_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/error.h"

namespace cairn {
namespace {

std::vector<std::size_t> column_widths(const std::vector<TableRow>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const TableRow& row : rows) {
    require(row.size() == widths.size(), "all rows of a table have the same number of cells");
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  return widths;
}

}  // namespace

std::string format_table(const std::vector<TableRow>& rows) {
  require(!rows.empty() && !rows.front().empty(), "a table has rows and columns");
  const std::vector<std::size_t> widths = column_widths(rows);
  std::string text;
  for (const TableRow& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) line += fmt::format("  {:>{}}", row[k], widths[k]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace cairn
