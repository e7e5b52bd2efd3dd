// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/setting_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/suggestion.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

bool parse_bool(std::string_view text, bool& value) {
  const auto is = [word = lower_case(text)](std::initializer_list<const char*> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  const bool yes = is({"yes", "true", "on", "1"});
  if (!yes && !is({"no", "false", "off", "0"})) return false;
  value = yes;
  return true;
}

bool parse_int(std::string_view text, int& value) {
  std::int64_t wide = 0;
  if (!parse_integer(text, wide) || wide < std::numeric_limits<int>::min() ||
      wide > std::numeric_limits<int>::max())
    return false;
  value = static_cast<int>(wide);
  return true;
}

/// Parses into a copy, so that the field keeps its value if the text is of another kind.
template <class T, class Field>
bool assign(const std::string& text, Field& field, bool (*parse)(std::string_view, T&)) {
  T value{};
  if (!parse(text, value)) return false;
  field = value;
  return true;
}

std::string in_quotes(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return fmt::format("\"{}\"", result);
}

/// Tells whether two values mean the same: equal texts, or both yes, or both no.
bool means_the_same(const std::string& a, const std::string& b) {
  bool truth_of_a = false, truth_of_b = false;
  const bool are_truths = parse_bool(a, truth_of_a) && parse_bool(b, truth_of_b);
  return a == b || (are_truths && truth_of_a == truth_of_b);
}

/// Returns the value of a line without the words that follow it; the whole value if a number follows.
std::string without_remark(const std::string& value) {
  const auto ends = [](char c) { return c == ' ' || c == '\t' || c == ';' || (c & '\x80') != 0; };
  const auto begins_number = [](char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  };
  const auto end = std::find_if(value.begin(), value.end(), ends);
  const auto next = std::find_if(end, value.end(), [](char c) { return c != ' ' && c != '\t' && c != ';'; });
  return next != value.end() && begins_number(*next) ? value : std::string(value.begin(), end);
}

template <class T>
std::string format_optional(const std::optional<T>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

SettingTable::Entry& SettingTable::add(const Parameter& parameter, const std::string& expected,
                                       std::function<bool(const std::string&)> set,
                                       std::function<std::string()> value) {
  const std::string accepted = parameter.range.describe();
  Entry& entry = entries_.emplace_back();
  entry.row = {parameter.name, "", accepted.empty() ? expected : accepted, parameter.meaning};
  entry.former_name = parameter.former_name;
  entry.expected = expected;
  entry.set = std::move(set);
  entry.value = std::move(value);
  return entry;
}

void SettingTable::parameter(const Parameter& parameter, double& value) {
  add(
      parameter, "a number", [&value](const std::string& text) { return assign(text, value, parse_number); },
      [&value] { return fmt::format("{}", value); });
}

void SettingTable::parameter(const Parameter& parameter, int& value) {
  add(
      parameter, "a whole number",
      [&value](const std::string& text) { return assign(text, value, parse_int); },
      [&value] { return fmt::format("{}", value); });
}

void SettingTable::parameter(const Parameter& parameter, bool& value) {
  add(
      parameter, "yes or no", [&value](const std::string& text) { return parse_bool(text, value); },
      [&value] { return std::string(value ? "yes" : "no"); });
}

void SettingTable::parameter(const Parameter& parameter, std::string& value) {
  Entry& entry = add(
      parameter, "a text", [&value](const std::string& text) { return value = text, true; },
      [&value] { return value; });
  entry.is_text = true;
  entry.is_word = parameter.range.unit == std::string_view("a name") ||
                  parameter.range.unit == std::string_view("a file extension");
}

void SettingTable::parameter(const Parameter& parameter, std::optional<double>& value) {
  add(
      parameter, "a number", [&value](const std::string& text) { return assign(text, value, parse_number); },
      [&value] { return format_optional(value); });
}

void SettingTable::parameter(const Parameter& parameter, std::optional<std::int64_t>& value) {
  add(
      parameter, "a whole number",
      [&value](const std::string& text) { return assign(text, value, parse_integer); },
      [&value] { return format_optional(value); });
}

void SettingTable::retired(const RetiredParameter& parameter) {
  retired_.push_back({parameter.name, parameter.accepted, parameter.reason});
}

const SettingTable::Entry* SettingTable::find(const std::string& name) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.row.name == name || (!name.empty() && entry.former_name == name);
  });
  return found == entries_.end() ? nullptr : &*found;
}

const SettingTable::Retired* SettingTable::find_retired(const std::string& name) const {
  const auto found = std::find_if(retired_.begin(), retired_.end(),
                                  [&](const Retired& retired) { return retired.name == name; });
  return found == retired_.end() ? nullptr : &*found;
}

/// A misspelt former name is answered with the present one.
void SettingTable::fail_unknown(const Setting& setting) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_) names.push_back(entry.row.name);
  for (const Entry& entry : entries_)
    if (!entry.former_name.empty()) names.push_back(entry.former_name);
  const std::string name = nearest_name(setting.key, names);
  const Entry* nearest = are_alike(setting.key, name) ? find(name) : nullptr;
  throw InputError({setting.source, setting.line, "the name of a parameter", fmt::format("'{}'", setting.key),
                    nearest == nullptr ? "--help lists all parameters."
                                       : fmt::format("Did you mean '{}'?", nearest->row.name)});
}

bool SettingTable::knows(const std::string& name) const {
  return find(name) != nullptr || find_retired(name) != nullptr;
}

/// A text of several words, as the path of a folder, has no remark.
bool SettingTable::set(const Entry& entry, const Setting& setting) {
  if (setting.may_have_remark && (entry.is_word || !entry.is_text) &&
      entry.set(without_remark(setting.value)))
    return true;
  return entry.set(setting.value);
}

std::string SettingTable::apply_retired(const Retired& retired, const Setting& setting) {
  const std::string place = place_of(setting);
  if (retired.accepted.empty())
    return fmt::format("{}: '{}' changes nothing: {}.", place, setting.key, retired.reason);
  const std::string value = setting.may_have_remark ? without_remark(setting.value) : setting.value;
  if (means_the_same(value, retired.accepted))
    return fmt::format("{}: '{}' was removed, as {}; '{}' is accepted and changes nothing.", place,
                       setting.key, retired.reason, value);
  throw InputError({setting.source, setting.line,
                    fmt::format("'{}' for '{}', which was removed", retired.accepted, setting.key),
                    fmt::format("'{}'", value),
                    fmt::format("Leave it out: it was removed, as {}.", retired.reason)});
}

std::string SettingTable::apply(const Setting& setting) const {
  if (const Retired* retired = find_retired(setting.key)) return apply_retired(*retired, setting);
  const Entry* entry = find(setting.key);
  if (entry == nullptr) fail_unknown(setting);
  if (!set(*entry, setting))
    throw InputError({setting.source, setting.line, fmt::format("{} for '{}'", entry->expected, setting.key),
                      fmt::format("'{}'", setting.value), "Correct the value."});
  if (entry->row.name == setting.key) return "";
  return fmt::format("{}: '{}' is now called '{}'; both are accepted.", place_of(setting), setting.key,
                     entry->row.name);
}

std::string SettingTable::format() const {
  std::string text;
  for (const Entry& entry : entries_) {
    const std::string value = entry.value();
    if (!value.empty())
      text += fmt::format("{}: {}\n", entry.row.name, entry.is_text ? in_quotes(value) : value);
  }
  return text;
}

std::vector<ParameterRow> SettingTable::rows() const {
  std::vector<ParameterRow> rows;
  for (const Entry& entry : entries_) {
    rows.push_back(entry.row);
    rows.back().value = entry.value();
  }
  return rows;
}

}  // namespace cairn
