// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/yaml_mapping.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/suggestion.h"

namespace cairn {

YAML::Node load_yaml(const std::filesystem::path& path) {
  std::string text = read_file(path);
  if (text.starts_with("%YAML:")) text.replace(0, std::min(text.find('\n'), text.size()), "");
  if (text.starts_with("{")) std::replace(text.begin(), text.end(), '\t', ' ');
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError({path.string(), error.mark.line + 1, "YAML", error.msg, "Correct the line."});
  }
  if (!root.IsNull()) return root;
  throw InputError({path.string(), 0, "a calibration", "an empty file", "See the README, \"Calibration\"."});
}

YamlMapping::YamlMapping(std::string file, std::string name, const YAML::Node& node,
                         const std::vector<std::string>& known)
    : file_(std::move(file)), name_(std::move(name)), node_(node) {
  if (!node_.IsMap())
    fail(node_, fmt::format("a mapping for '{}'", name_), describe(node_),
         "See the README, \"Calibration\".");
  check_keys(known);
}

void YamlMapping::check_keys(const std::vector<std::string>& known) const {
  std::set<std::string> seen;
  for (const auto& item : node_) {
    const std::string key = item.first.IsScalar() ? item.first.Scalar() : "a list or mapping";
    if (!known.empty() && std::find(known.begin(), known.end(), key) == known.end()) {
      fail(item.first, fmt::format("a known key in '{}'", name_), fmt::format("'{}'", key),
           suggestion(key, known, fmt::format("Known are {}.", fmt::join(known, ", "))));
    }
    if (!seen.insert(key).second)
      fail(item.first, fmt::format("one '{}' in '{}'", key, name_), "two", "Delete one.");
  }
}

void YamlMapping::expect(const std::string& key, const std::string& kind) const {
  if (has(key)) return;
  fail(node_, fmt::format("'{}' in '{}' ({})", key, name_, kind), "none", fmt::format("Add '{}'.", key));
}

double YamlMapping::number(const std::string& key) const {
  const auto value = get<double>(key, "a number");
  check(std::isfinite(value), key, "a finite number");
  return value;
}

double YamlMapping::positive(const std::string& key) const {
  const double value = number(key);
  check(value > 0, key, "a number above 0");
  return value;
}

std::vector<double> YamlMapping::numbers(const std::string& key, std::size_t count,
                                         const std::string& kind) const {
  auto values = get<std::vector<double>>(key, kind);
  check(values.size() == count, key, kind);
  const bool finite = std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  check(finite, key, "finite numbers");
  return values;
}

YamlMapping YamlMapping::sub(const std::string& key, const std::vector<std::string>& known) const {
  return {file_, key, node_[key], known};
}

void YamlMapping::check(bool holds, const std::string& key, const std::string& expected) const {
  const YAML::Node value = node_[key];
  if (!holds) fail(value, fmt::format("{} for '{}'", expected, key), describe(value), "Correct the value.");
}

std::string YamlMapping::describe(const YAML::Node& value) {
  if (value.IsScalar()) return fmt::format("'{}'", value.Scalar());
  if (value.IsSequence()) return fmt::format("a list of {}", value.size());
  return value.IsMap() ? "a mapping" : "nothing";
}

void YamlMapping::fail(const YAML::Node& at, std::string expected, std::string found,
                       std::string remedy) const {
  throw InputError({file_, at.Mark().line + 1, std::move(expected), std::move(found), std::move(remedy)});
}

}  // namespace cairn
