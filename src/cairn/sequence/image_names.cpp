// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/image_names.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "cairn/core/text.h"
#include "cairn/sequence/time_unit.h"

namespace cairn {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t end_of_digits(std::string_view text, std::size_t begin) {
  while (begin < text.size() && is_digit(text[begin])) ++begin;
  return begin;
}

/// Tells whether the digits before and behind the separator are one number: "12.5", or seconds and
/// nanoseconds as "1403636579_763555584".
bool is_fraction(std::string_view whole, char separator, std::string_view rest) {
  constexpr std::size_t kSecondDigits = 10, kNanosecondDigits = 9;
  if (rest.empty()) return false;
  if (separator == '.') return true;
  return (separator == '_' || separator == '-') && whole.size() == kSecondDigits &&
         rest.size() == kNanosecondDigits;
}

/// Returns the numbers in a name, without sign, in their order.
std::vector<std::string> numbers_in(std::string_view name) {
  std::vector<std::string> numbers;
  for (std::size_t begin = 0; begin < name.size();) {
    if (!is_digit(name[begin])) {
      ++begin;
      continue;
    }
    std::size_t end = end_of_digits(name, begin);
    std::string number(name.substr(begin, end - begin));
    if (end + 1 < name.size()) {
      const std::size_t rest_end = end_of_digits(name, end + 1);
      const std::string_view rest = name.substr(end + 1, rest_end - end - 1);
      if (is_fraction(number, name[end], rest)) {
        number.append(".").append(rest);
        end = rest_end;
      }
    }
    numbers.push_back(std::move(number));
    begin = end;
  }
  return numbers;
}

struct ReadName {
  SeriesFile file;
  std::vector<std::string> numbers;
};

/// Leaves out names with a sign, repeated ones, and those with another count of numbers than most.
std::vector<ReadName> read_names(std::span<const SeriesFile> files) {
  std::vector<ReadName> names;
  std::map<std::size_t, std::size_t> counts;
  std::set<std::string_view> known;
  for (const SeriesFile& file : files) {
    if (file.name.starts_with('-') || !known.insert(file.name).second) continue;
    names.push_back({file, numbers_in(file.name)});
    ++counts[names.back().numbers.size()];
  }
  const auto most = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (counts.empty()) return names;
  std::erase_if(names, [&](const ReadName& name) { return name.numbers.size() != most->first; });
  std::sort(names.begin(), names.end(), [](const ReadName& a, const ReadName& b) {
    return comes_naturally_before(a.file.name, b.file.name);
  });
  return names;
}

/// Returns whether the numbers are stamps, by their size, their spacing or a fraction.
bool are_stamps(const std::vector<std::string_view>& numbers, TimeUnit unit) {
  constexpr double kSecondsSince1970 = 1e8;
  if (unit != TimeUnit::second) return true;
  const bool has_fraction = std::any_of(numbers.begin(), numbers.end(), [](std::string_view text) {
    return text.find('.') != std::string_view::npos;
  });
  double last = 0;
  return has_fraction || (parse_number(numbers.back(), last) && last >= kSecondsSince1970);
}

/// Returns the series keyed by the numbers at one place of the names, if these increase.
std::optional<KeyedSeries> keyed_by(const std::vector<ReadName>& names, std::size_t place) {
  std::vector<std::string_view> numbers;
  numbers.reserve(names.size());
  for (const ReadName& name : names) numbers.push_back(name.numbers[place]);
  const TimeUnit unit = infer_time_unit(numbers);
  KeyedSeries series;
  series.kind = are_stamps(numbers, unit) ? SeriesKey::stamp : SeriesKey::number;
  for (const ReadName& name : names) {
    std::int64_t key = 0;
    const std::string& number = name.numbers[place];
    const bool is_read =
        series.kind == SeriesKey::stamp ? parse_stamp_in(unit, number, key) : parse_integer(number, key);
    if (!is_read || (!series.files.empty() && key <= series.files.back().key)) return std::nullopt;
    series.files.push_back({key, name.file});
  }
  return series;
}

}  // namespace

KeyedSeries read_series(std::span<const SeriesFile> files) {
  const std::vector<ReadName> names = files.empty() ? std::vector<ReadName>{} : read_names(files);
  if (names.empty()) return {};
  std::optional<KeyedSeries> chosen;
  for (std::size_t place = 0; place < names.front().numbers.size(); ++place) {
    auto series = keyed_by(names, place);
    if (!series) continue;
    const bool has_stamps = series->kind == SeriesKey::stamp;
    if (!chosen || has_stamps) chosen = std::move(series);
    if (has_stamps) break;
  }
  if (chosen) return *chosen;
  KeyedSeries series;
  for (const ReadName& name : names)
    series.files.push_back({static_cast<std::int64_t>(series.files.size()), name.file});
  return series;
}

}  // namespace cairn
