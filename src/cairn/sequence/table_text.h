// SPDX-License-Identifier: Apache-2.0
// Private to this room: tables as spreadsheets and surveyors' programs write them.
#pragma once

#include <string>
#include <string_view>

namespace cairn {

/// Rewrites a table line by line with commas between its values and points in its numbers, if its rows have
/// semicolons between them, or tabs below names that hold blanks, or quotes. Decimal commas become points;
/// other commas within a field become blanks. Lines keep their numbers. Returns any other text as it is.
[[nodiscard]] std::string plain_table_text(std::string contents);

}  // namespace cairn
