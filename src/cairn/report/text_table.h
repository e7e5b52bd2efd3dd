// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace cairn {

/// Holds the cells of one row of a table; each row of a table has the same number of them.
using TableRow = std::vector<std::string>;

/// Returns the rows as lines in which the columns stand one below the other, two blanks apart: the first
/// column to the left, the others to the right; no blanks at the ends of lines. PreconditionError for no rows
/// and for rows of another number of cells than the first.
[[nodiscard]] std::string format_table(const std::vector<TableRow>& rows);

}  // namespace cairn
