// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/settings.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <limits>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"

namespace cairn {
namespace {

std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// A line without its comment, its semicolon and the blanks around.
std::string_view content_of(std::string_view line) {
  line = trim(line.substr(0, line.find('#')));
  if (line.ends_with(';')) line = trim(line.substr(0, line.size() - 1));
  return line;
}

/// The first line with contents tells: `name: value` is YAML, `name=value` is none.
bool is_yaml(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = content_of(text.substr(begin, end - begin));
    if (!line.empty()) return std::min(line.find(": "), line.find('{')) <= line.find('=');
    begin = end + 1;
  }
  return true;
}

std::optional<Setting> split(std::string_view line, const std::string& source, int number) {
  const std::size_t sign = line.find('=');
  if (sign == std::string_view::npos || trim(line.substr(0, sign)).empty()) return std::nullopt;
  return Setting{std::string(trim(line.substr(0, sign))), std::string(trim(line.substr(sign + 1))), source,
                 number};
}

std::vector<Setting> read_lines(std::string_view text, const std::string& source) {
  std::vector<Setting> settings;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = content_of(text.substr(begin, end - begin));
    ++number;
    begin = end + 1;
    if (line.empty()) continue;
    const auto setting = split(line, source, number);
    if (!setting)
      throw InputError({source, number, "key=value", fmt::format("'{}'", line), "Mend or delete the line."});
    settings.push_back(*setting);
  }
  return settings;
}

std::vector<Setting> read_yaml(const std::string& text, const std::string& source) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError({source, error.mark.line + 1, "YAML, or lines key=value", error.msg, "Mend the line."});
  }
  if (root.IsNull()) return {};
  if (!root.IsMap())
    throw InputError(
        {source, 1, "a mapping of names to values", "another kind of YAML", "Write name: value."});
  std::vector<Setting> settings;
  for (const auto& item : root) {
    const int line = item.first.Mark().line + 1;
    const std::string& key = item.first.Scalar();  // empty for a list or a mapping
    if (!item.second.IsScalar()) {
      throw InputError({source, line, fmt::format("a plain value for '{}'", key),
                        "a list, a mapping or nothing", "Write name: value."});
    }
    settings.push_back({key, item.second.Scalar(), source, line});
  }
  return settings;
}

bool parse_bool(std::string text, bool& value) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const auto is = [&](std::initializer_list<const char*> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
  };
  const bool yes = is({"yes", "true", "on", "1"});
  if (!yes && !is({"no", "false", "off", "0"})) return false;
  value = yes;
  return true;
}

bool parse_int(const std::string& text, int& value) {
  std::int64_t wide = 0;
  if (!parse_integer(text, wide) || wide < std::numeric_limits<int>::min() ||
      wide > std::numeric_limits<int>::max())
    return false;
  value = static_cast<int>(wide);
  return true;
}

/// `parse` into a copy, so that the field keeps its value where the text is of another kind.
template <class T, class Field, class Parse>
bool assign(const std::string& text, Field& field, Parse parse) {
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

}  // namespace

std::vector<Setting> read_settings(const std::filesystem::path& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors write it before UTF-8
  std::string text = read_file(path);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return is_yaml(text) ? read_yaml(text, path.string()) : read_lines(text, path.string());
}

Setting parse_setting(const std::string& text, const std::string& option) {
  const auto setting = split(text, option, 0);
  if (!setting)
    throw InputError(
        {option, 0, "key=value", fmt::format("'{}'", text), "For example --set min_inliers=30."});
  return *setting;
}

void SettingTable::bind(const std::string& name, double& field) {
  entries_.push_back({name, "a number",
                      [&field](const std::string& text) { return assign<double>(text, field, parse_number); },
                      [&field] { return std::optional(fmt::format("{}", field)); }});
}

void SettingTable::bind(const std::string& name, int& field) {
  entries_.push_back({name, "a whole number",
                      [&field](const std::string& text) { return assign<int>(text, field, parse_int); },
                      [&field] { return std::optional(fmt::format("{}", field)); }});
}

void SettingTable::bind(const std::string& name, bool& field) {
  entries_.push_back({name, "yes or no",
                      [&field](const std::string& text) { return parse_bool(text, field); },
                      [&field] { return std::optional(std::string(field ? "yes" : "no")); }});
}

void SettingTable::bind(const std::string& name, std::string& field) {
  entries_.push_back({name, "a text", [&field](const std::string& text) { return field = text, true; },
                      [&field] { return field.empty() ? std::nullopt : std::optional(in_quotes(field)); }});
}

void SettingTable::bind(const std::string& name, std::optional<double>& field) {
  entries_.push_back({name, "a number",
                      [&field](const std::string& text) { return assign<double>(text, field, parse_number); },
                      [&field] { return field ? std::optional(fmt::format("{}", *field)) : std::nullopt; }});
}

void SettingTable::bind(const std::string& name, std::optional<std::int64_t>& field) {
  entries_.push_back(
      {name, "a whole number",
       [&field](const std::string& text) { return assign<std::int64_t>(text, field, parse_integer); },
       [&field] { return field ? std::optional(fmt::format("{}", *field)) : std::nullopt; }});
}

void SettingTable::apply(const Setting& setting) const {
  const auto entry =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == setting.key; });
  if (entry == entries_.end()) {
    std::vector<std::string> names;
    for (const Entry& known : entries_) names.push_back(known.name);
    throw InputError({setting.source, setting.line, "the name of a parameter",
                      fmt::format("'{}'", setting.key),
                      fmt::format("Did you mean '{}'?", nearest_name(setting.key, names))});
  }
  if (entry->set(setting.value)) return;
  throw InputError({setting.source, setting.line, fmt::format("{} for '{}'", entry->expected, setting.key),
                    fmt::format("'{}'", setting.value), "Mend the value."});
}

std::string SettingTable::format() const {
  std::string text;
  for (const Entry& entry : entries_) {
    if (const auto value = entry.value()) text += fmt::format("{}: {}\n", entry.name, *value);
  }
  return text;
}

}  // namespace cairn
