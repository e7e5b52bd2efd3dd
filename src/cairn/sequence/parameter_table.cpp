// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace cairn {
namespace {

constexpr std::size_t kLineWidth = 100, kGap = 2;

/// Cuts a text at blanks into lines of at most `width` characters; a longer word has a line of its own.
std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::string& line = lines.back();
    if (line.empty())
      line = word;
    else if (line.size() + 1 + word.size() <= width)
      line.append(" ").append(word);
    else
      lines.emplace_back(word);
  }
  return lines;
}

std::size_t width_of(std::span<const ParameterRow> rows, std::string ParameterRow::*column) {
  std::size_t width = 0;
  for (const ParameterRow& row : rows) width = std::max(width, (row.*column).size());
  return width;
}

}  // namespace

std::string format_as_text(std::span<const ParameterRow> rows) {
  const std::size_t names = width_of(rows, &ParameterRow::name),
                    values = width_of(rows, &ParameterRow::value);
  const std::size_t indent = kGap + names + kGap + values + kGap;
  const std::size_t width = kLineWidth - std::min(indent, kLineWidth / 2);
  std::string text;
  for (const ParameterRow& row : rows) {
    text += fmt::format("{0:{1}}{2:{3}}{0:{1}}{4:{5}}{0:{1}}", "", kGap, row.name, names, row.value, values);
    const std::vector<std::string> lines = wrap(fmt::format("{}. {}", row.accepted, row.meaning), width);
    text += fmt::format("{}\n", fmt::join(lines, fmt::format("\n{:{}}", "", indent)));
  }
  return text;
}

std::string format_as_markdown(std::span<const ParameterRow> rows) {
  std::string text = "| parameter | default | accepts | meaning |\n|---|---:|---|---|\n";
  for (const ParameterRow& row : rows)
    text += fmt::format("| `{}` | {} | {} | {} |\n", row.name, row.value, row.accepted, row.meaning);
  return text;
}

}  // namespace cairn
