// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Returns the text with the letters A to Z in lower case, whatever the locale.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Holds one non-empty line of a text file, split into fields: views into the TextFile.
struct TextLine {
  int number = 0;  ///< 1-based
  std::vector<std::string_view> fields;
};

/// Names the separator of a line's fields: white space; commas, with blanks around a field left out; or any
/// run of white space, commas and semicolons.
enum class Separator { blanks, commas, any };

/// Throws InputError that says what the contents are and what to do unless they are text: a picture, UTF-16
/// ...
void expect_text(const std::filesystem::path& path, std::string_view contents);

/// Holds a text file; empty lines and what follows a '#' are left out. Field accessors throw InputError that
/// names file and line.
class TextFile {
 public:
  /// Reads the file. Throws InputError if it cannot be read or holds no text.
  explicit TextFile(const std::filesystem::path& path, Separator separator = Separator::blanks);
  /// Takes `contents` as those of the file `path`.
  TextFile(std::filesystem::path path, std::string contents, Separator separator);

  [[nodiscard]] const std::vector<TextLine>& lines() const { return lines_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Returns the field as a finite number. `what` names it in the message ("tx").
  [[nodiscard]] double number(const TextLine& line, std::size_t field, std::string_view what) const;
  /// Returns the field as an integer. `what` names it in the message.
  [[nodiscard]] std::int64_t integer(const TextLine& line, std::size_t field, std::string_view what) const;
  /// Throws InputError unless the line has `count` fields; `layout` names them ("t tx ty tz qx qy qz qw").
  void expect_fields(const TextLine& line, std::size_t count, std::string_view layout) const;
  /// Throws InputError for this line.
  [[noreturn]] void fail(const TextLine& line, std::string expected, std::string found,
                         std::string remedy) const;

 private:
  std::filesystem::path path_;
  std::string contents_;
  std::vector<TextLine> lines_;
};

/// Converts decimal seconds ("1305031453.359684") to nanoseconds, exactly unless the text has an exponent or
/// a minus sign. Returns false if it is not a number.
[[nodiscard]] bool parse_stamp(std::string_view text, std::int64_t& stamp_ns);
/// Parses the whole of `text` as a finite number. Returns false if it is none.
[[nodiscard]] bool parse_number(std::string_view text, double& value);
/// Parses the whole of `text` as an integer. Returns false if it is none.
[[nodiscard]] bool parse_integer(std::string_view text, std::int64_t& value);
/// Formats nanoseconds as seconds with nine decimals.
[[nodiscard]] std::string format_stamp(std::int64_t stamp_ns);

/// Orders names as people count: runs of digits compare as numbers of any length, all else byte by byte, so
/// that "cam0_2.png" comes before "cam0_10.png". Of names that differ only by leading zeros, the one with the
/// most zeros comes first. A strict weak order in which two different names are never equal.
[[nodiscard]] bool comes_naturally_before(std::string_view a, std::string_view b);

/// Computes the number of letters to insert, delete, replace or exchange with the next until one word is the
/// other (Damerau 1964, each letter once).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the element of `known` with the smallest edit distance to `word`, for "did you mean".
[[nodiscard]] std::string nearest_name(std::string_view word, const std::vector<std::string>& known);

}  // namespace cairn
