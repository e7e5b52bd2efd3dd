// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/settings.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

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
  if (line.starts_with(';') || line.starts_with("//")) return {};
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

Setting setting_of(std::string_view line, const std::string& source, int number) {
  auto setting = split(line, source, number);
  if (!setting)
    throw InputError({source, number, "key=value", fmt::format("'{}'", line), "Correct or delete the line."});
  return *std::move(setting);
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
    settings.push_back(setting_of(line, source, number));
    settings.back().may_have_remark = true;
  }
  return settings;
}

std::vector<Setting> read_yaml(const std::string& text, const std::string& source) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(
        {source, error.mark.line + 1, "YAML, or lines key=value", error.msg, "Correct the line."});
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

}  // namespace

std::string place_of(const Setting& setting) {
  return setting.line > 0 ? fmt::format("{}:{}", setting.source, setting.line) : setting.source;
}

std::vector<Setting> read_settings(const std::filesystem::path& path) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors write it before UTF-8
  constexpr std::string_view kOpenCvDirective = "%YAML:";
  std::string text = read_file(path);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (text.starts_with(kOpenCvDirective)) text[0] = '#';  // no YAML, which wants a blank and a line ---
  return is_yaml(text) ? read_yaml(text, path.string()) : read_lines(text, path.string());
}

Setting parse_setting(const std::string& text, const std::string& option) {
  const auto setting = split(text, option, 0);
  if (!setting)
    throw InputError(
        {option, 0, "key=value", fmt::format("'{}'", text), "For example --set min_inliers=30."});
  return *setting;
}

}  // namespace cairn
