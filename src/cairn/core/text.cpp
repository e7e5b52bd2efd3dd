// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors write it before UTF-8

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> fields;
  if (trimmed(text).empty()) return fields;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    fields.push_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::vector<std::string_view> split_at_any(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = text.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    fields.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return fields;
}

std::vector<std::string_view> split(std::string_view line, Separator separator) {
  switch (separator) {
    case Separator::commas:
      return split_at_commas(line);
    case Separator::any:
      return split_at_any(line, " \t\r\v\f,;");
    case Separator::blanks:
      break;
  }
  return split_at_any(line, kBlanks);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Cuts a run of digits, or one other byte, off the front of `rest`, which is not empty.
std::string_view take_piece(std::string_view& rest) {
  const auto* const end = std::find_if_not(rest.begin(), rest.end(), is_digit);
  const auto length = std::max<std::size_t>(1, static_cast<std::size_t>(end - rest.begin()));
  const std::string_view piece = rest.substr(0, length);
  rest.remove_prefix(length);
  return piece;
}

std::string_view without_leading_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

/// Below 0, 0 or above: two runs of digits by their value, else by their bytes.
int compare_pieces(std::string_view a, std::string_view b) {
  if (!is_digit(a[0]) || !is_digit(b[0])) return a.compare(b);
  const std::string_view value_a = without_leading_zeros(a), value_b = without_leading_zeros(b);
  if (value_a.size() != value_b.size()) return value_a.size() < value_b.size() ? -1 : 1;
  return value_a.compare(value_b);
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

void expect_text(const std::filesystem::path& path, std::string_view contents) {
  struct Kind {
    std::string_view begin, name, remedy;
  };
  constexpr std::string_view kOther = "Name the text file instead.";
  constexpr std::string_view kConvert = "Save it as UTF-8: iconv -f UTF-16 -t UTF-8 IN > OUT.";
  constexpr Kind kKinds[] = {
      {"\xFF\xFE", "text in UTF-16", kConvert},
      {"\xFE\xFF", "text in UTF-16", kConvert},
      {"\x89PNG", "a picture (PNG)", kOther},
      {"\xFF\xD8\xFF", "a picture (JPEG)", kOther},
      {"%PDF", "a PDF document", kOther},
      {"PK\x03\x04", "an archive or a spreadsheet (zip)", "Unpack it, or save it as CSV."},
      {"#ROSBAG", "a ROS 1 bag", "Write its topic as text: rostopic echo -b FILE -p TOPIC."},
      {"SQLite format 3", "a database (SQLite; a ROS 2 bag is one)", kOther}};
  const auto fail = [&](std::string_view found, std::string_view remedy) {
    throw InputError({path.string(), 0, "a text file", std::string(found), std::string(remedy)});
  };
  for (const Kind& kind : kKinds)
    if (contents.starts_with(kind.begin)) fail(kind.name, kind.remedy);
  const std::size_t zero = contents.find('\0');
  if (zero == std::string_view::npos) return;
  const bool is_wide = contents.size() > 3 && zero < 2 && contents[zero + 2] == '\0';
  is_wide ? fail("text in UTF-16", kConvert) : fail("binary data", kOther);
}

TextFile::TextFile(const std::filesystem::path& path, Separator separator)
    : TextFile(path, read_file(path), separator) {}

TextFile::TextFile(std::filesystem::path path, std::string contents, Separator separator)
    : path_(std::move(path)), contents_(std::move(contents)) {
  expect_text(path_, contents_);
  std::string_view all = contents_;
  if (all.starts_with(kByteOrderMark)) all.remove_prefix(kByteOrderMark.size());
  int number = 0;
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = std::min(all.find('\n', begin), all.size());
    ++number;
    std::string_view line = all.substr(begin, end - begin);
    line = line.substr(0, line.find('#'));
    auto fields = split(line, separator);
    if (!fields.empty()) lines_.push_back({number, std::move(fields)});
    begin = end + 1;
  }
}

void TextFile::fail(const TextLine& line, std::string expected, std::string found, std::string remedy) const {
  throw InputError({path_.string(), line.number, std::move(expected), std::move(found), std::move(remedy)});
}

void TextFile::expect_fields(const TextLine& line, std::size_t count, std::string_view layout) const {
  if (line.fields.size() == count) return;
  fail(line, fmt::format("{} values ({})", count, layout), fmt::format("{}", line.fields.size()),
       "Correct or delete the line.");
}

double TextFile::number(const TextLine& line, std::size_t field, std::string_view what) const {
  double value = 0;
  if (field < line.fields.size() && parse_number(line.fields[field], value)) return value;
  fail(line, fmt::format("a number for {}", what),
       field < line.fields.size() ? fmt::format("'{}'", line.fields[field]) : "nothing",
       "Correct or delete the line.");
}

std::int64_t TextFile::integer(const TextLine& line, std::size_t field, std::string_view what) const {
  std::int64_t value = 0;
  if (field < line.fields.size() && parse_integer(line.fields[field], value)) return value;
  fail(line, fmt::format("a whole number for {}", what),
       field < line.fields.size() ? fmt::format("'{}'", line.fields[field]) : "nothing",
       "Correct or delete the line.");
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_stamp(std::string_view text, std::int64_t& stamp_ns) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  constexpr std::int64_t kMaxSeconds = 9'000'000'000;
  const std::size_t dot = text.find('.');
  const std::string_view whole = text.substr(0, dot);
  const std::string_view fraction = dot == std::string_view::npos ? "" : text.substr(dot + 1);
  std::int64_t seconds = 0;
  const bool plain =
      !whole.empty() && whole[0] != '-' && parse_integer(whole, seconds) && fraction.size() <= 18 &&
      std::all_of(fraction.begin(), fraction.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!plain) {  // an exponent or a sign: a double is exact enough for what writes stamps so
    double value = 0;
    if (!parse_number(text, value) || std::abs(value) > static_cast<double>(kMaxSeconds)) return false;
    stamp_ns = std::llround(value * 1e9);
    return true;
  }
  if (seconds > kMaxSeconds) return false;
  std::int64_t nanoseconds = 0;
  for (std::size_t i = 0; i < 9; ++i)
    nanoseconds = 10 * nanoseconds + (i < fraction.size() ? fraction[i] - '0' : 0);
  if (fraction.size() > 9 && fraction[9] >= '5') ++nanoseconds;
  stamp_ns = seconds * kNanosecondsPerSecond + nanoseconds;
  return true;
}

std::string format_stamp(std::int64_t stamp_ns) {
  const std::uint64_t magnitude =
      stamp_ns < 0 ? 0 - static_cast<std::uint64_t>(stamp_ns) : static_cast<std::uint64_t>(stamp_ns);
  return fmt::format("{}{}.{:09}", stamp_ns < 0 ? "-" : "", magnitude / 1'000'000'000,
                     magnitude % 1'000'000'000);
}

bool comes_naturally_before(std::string_view a, std::string_view b) {
  std::optional<bool> more_zeros;  // where they differ first
  while (!a.empty() && !b.empty()) {
    const std::string_view piece_a = take_piece(a), piece_b = take_piece(b);
    const int order = compare_pieces(piece_a, piece_b);
    if (order != 0) return order < 0;
    if (!more_zeros && piece_a.size() != piece_b.size()) more_zeros = piece_a.size() > piece_b.size();
  }
  return a.empty() && b.empty() ? more_zeros.value_or(false) : a.empty() && !b.empty();
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> last(b.size() + 1), row(b.size() + 1), before_last;
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + (a[i] == b[j] ? 0 : 1), row[j] + 1, last[j + 1] + 1});
      const bool are_exchanged = i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j];
      if (are_exchanged) row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 1);
    }
    before_last = std::exchange(last, row);
  }
  return last.back();
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& known) {
  require(!known.empty(), "nearest_name needs names to choose from");
  return *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
}

}  // namespace cairn
