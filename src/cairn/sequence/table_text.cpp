// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/table_text.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "cairn/core/text.h"

namespace cairn {
namespace {

/// Splits outside of quotes and takes the quotes away.
std::vector<std::string> split_fields(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == separator && !is_quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  }
  return fields;
}

std::string with_point(std::string field) {
  std::string number = field;
  const std::size_t comma = number.find(',');
  if (comma == std::string::npos) return field;
  number[comma] = '.';
  const std::size_t begin = std::min(number.find_first_not_of(' '), number.size());
  double value = 0;
  if (parse_number(std::string_view(number).substr(begin, number.find_last_not_of(' ') + 1 - begin), value))
    return number;
  std::replace(field.begin(), field.end(), ',', ' ');
  return field;
}

bool is_row(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t\"");
  if (begin == std::string_view::npos) return false;
  const std::string_view rest = line.substr(begin);
  std::string first(rest.substr(0, rest.find_first_of(" ;\t\"\r")));
  first = first.substr(0, first.find(','));
  double value = 0;
  return parse_number(first, value);
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

/// Between tabs, a name that holds blanks: "East Std Dev (m)".
bool names_with_blanks(std::string_view line) {
  const std::vector<std::string> fields = split_fields(line, '\t');
  return fields.size() > 1 && std::any_of(fields.begin(), fields.end(), [](const std::string& field) {
           const std::size_t begin = field.find_first_not_of("# ");
           return begin != std::string::npos && field.find(' ', begin) < field.find_last_not_of(' ');
         });
}

/// Returns nullopt if the text needs no change.
std::optional<char> separator_of(const std::vector<std::string_view>& lines) {
  const auto row = std::find_if(lines.begin(), lines.end(), is_row);
  if (row == lines.end()) return std::nullopt;
  if (row->find(';') != std::string_view::npos) return ';';
  const bool has_tabs = row->find('\t') != std::string_view::npos;
  if (has_tabs && std::any_of(lines.begin(), row, names_with_blanks)) return '\t';
  if (row->find('"') == std::string_view::npos) return std::nullopt;
  return has_tabs ? '\t' : ',';
}

}  // namespace

std::string plain_table_text(std::string contents) {
  const std::vector<std::string_view> lines = lines_of(contents);
  const std::optional<char> separator = separator_of(lines);
  if (!separator) return contents;
  std::string plain;
  for (const std::string_view line : lines) {
    bool begins = true;
    for (std::string& field : split_fields(line, *separator)) {
      if (!begins) plain += ',';
      begins = false;
      plain += with_point(std::move(field));
    }
    plain += '\n';
  }
  return plain;
}

}  // namespace cairn
