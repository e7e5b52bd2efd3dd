// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// One line of a text file that holds something, split into fields. Views into the TextFile it came from.
struct TextLine {
  int number = 0;  ///< 1-based
  std::vector<std::string_view> fields;
};

/// What stands between the fields of a line: white space, or commas, where blanks around a field are left
/// out.
enum class Separator { blanks, commas };

/// A text file read whole; empty lines and what follows a '#' are left out. Field accessors throw InputError
/// that names file and line.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& path, Separator separator = Separator::blanks);

  [[nodiscard]] const std::vector<TextLine>& lines() const { return lines_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// The field as a finite number. `what` names it in the message ("tx").
  [[nodiscard]] double number(const TextLine& line, std::size_t field, std::string_view what) const;
  [[nodiscard]] std::int64_t integer(const TextLine& line, std::size_t field, std::string_view what) const;
  /// InputError unless the line has `count` fields; `layout` names them ("t tx ty tz qx qy qz qw").
  void expect_fields(const TextLine& line, std::size_t count, std::string_view layout) const;
  [[noreturn]] void fail(const TextLine& line, std::string expected, std::string found,
                         std::string remedy) const;

 private:
  std::filesystem::path path_;
  std::string contents_;
  std::vector<TextLine> lines_;
};

/// Decimal seconds ("1305031453.359684") to nanoseconds, exact to the nanosecond; false where it is no
/// number.
[[nodiscard]] bool parse_stamp(std::string_view text, std::int64_t& stamp_ns);
/// The whole of `text` as a finite double or an integer; false where it is none.
[[nodiscard]] bool parse_number(std::string_view text, double& value);
[[nodiscard]] bool parse_integer(std::string_view text, std::int64_t& value);
/// Nanoseconds as seconds with nine decimals.
[[nodiscard]] std::string format_stamp(std::int64_t stamp_ns);

/// Orders names as people count: runs of digits compare as numbers of any length, all else byte by byte, so
/// that "cam0_2.png" comes before "cam0_10.png". Names that differ by leading zeros only come with the most
/// zeros first. A strict weak order, and two different names are never equal.
[[nodiscard]] bool comes_naturally_before(std::string_view a, std::string_view b);

/// Letters to put in, take out or replace until one word is the other (Levenshtein).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The element of `known` with the smallest edit distance to `word`, for "did you mean".
[[nodiscard]] std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

}  // namespace cairn
