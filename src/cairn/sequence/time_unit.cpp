// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/time_unit.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/text.h"

namespace cairn {
namespace {

/// How many decimal digits of the unit are nanoseconds.
std::size_t digits_below(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::millisecond:
      return 6;
    case TimeUnit::microsecond:
      return 3;
    case TimeUnit::nanosecond:
      return 0;
    case TimeUnit::second:
      break;
  }
  return 9;
}

bool is_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool parse_inexact(std::string_view text, double unit_ns, std::int64_t& stamp_ns) {
  constexpr double kLargest = 9e18;
  double value = 0;
  if (!parse_number(text, value) || std::abs(value * unit_ns) > kLargest) return false;
  if (unit_ns == 1 && value != std::floor(value)) return false;
  stamp_ns = std::llround(value * unit_ns);
  return true;
}

}  // namespace

bool parse_stamp_in(TimeUnit unit, std::string_view text, std::int64_t& stamp_ns) {
  if (unit == TimeUnit::second) return parse_stamp(text, stamp_ns);
  const std::size_t digits = digits_below(unit);
  const double unit_ns = std::pow(10.0, static_cast<double>(digits));
  const std::size_t dot = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, dot), fraction = text.substr(std::min(dot + 1, text.size()));
  std::int64_t units = 0;
  if (whole.empty() || !is_digits(whole) || !is_digits(fraction) || !parse_integer(whole, units))
    return parse_inexact(text, unit_ns, stamp_ns);
  constexpr std::int64_t kLargest = 9'000'000'000'000'000'000;
  std::int64_t factor = 1, part = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    factor *= 10;
    part = 10 * part + (i < fraction.size() ? fraction[i] - '0' : 0);
  }
  if (fraction.size() > digits && fraction[digits] >= '5') ++part;
  const bool has_part = fraction.find_first_not_of('0') != std::string_view::npos;
  if (units > kLargest / factor || (digits == 0 && has_part)) return false;
  stamp_ns = units * factor + part;
  return true;
}

TimeUnit infer_time_unit(const std::vector<std::string_view>& stamps) {
  double first = 0, last = 0, largest = 0;
  bool is_whole = true;
  std::size_t count = 0;
  for (const std::string_view text : stamps) {
    double value = 0;
    if (!parse_number(text, value)) continue;
    if (count++ == 0) first = value;
    last = value;
    largest = std::max(largest, std::abs(value));
    is_whole = is_whole && value == std::floor(value);
  }
  if (largest >= 1e17) return TimeUnit::nanosecond;
  if (largest >= 1e14) return TimeUnit::microsecond;
  constexpr double kTooFarApart = 1e5;
  if (is_whole && count > 1 && (last - first) / static_cast<double>(count - 1) >= kTooFarApart)
    return TimeUnit::nanosecond;
  return largest >= 1e11 ? TimeUnit::millisecond : TimeUnit::second;
}

std::string format_seconds(std::int64_t ns) {
  std::string text = format_stamp(ns);
  text.erase(text.find_last_not_of('0') + 1);
  return text.ends_with('.') ? text + '0' : text;
}

}  // namespace cairn
