// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// One `key = value` of a configuration, and where it stands.
struct Setting {
  std::string key;
  std::string value;
  std::string source;  ///< file, or the option it was given by
  int line = 0;        ///< 0 where there is no file
};

/// A YAML mapping of names to plain values, or lines `key=value` (comments with #, a semicolon at the end
/// tolerated). InputError names the line of what is neither.
[[nodiscard]] std::vector<Setting> read_settings(const std::filesystem::path& path);
/// "key=value" as given by `option`.
[[nodiscard]] Setting parse_setting(const std::string& text, const std::string& option);

/// Names bound to the fields of option structs: one place that reads them, checks their type and writes them
/// back.
class SettingTable {
 public:
  void bind(const std::string& name, double& field);
  void bind(const std::string& name, int& field);
  void bind(const std::string& name, bool& field);  ///< yes, no, true, false, on, off, 1, 0
  void bind(const std::string& name, std::string& field);
  void bind(const std::string& name, std::optional<double>& field);
  void bind(const std::string& name, std::optional<std::int64_t>& field);

  /// InputError with file and line for an unknown name, naming the nearest known one, and for a value of
  /// another type.
  void apply(const Setting& setting) const;
  /// All names with their present values as YAML, fields without a value left out: a file that read_settings
  /// reads.
  [[nodiscard]] std::string format() const;

 private:
  struct Entry {
    std::string name;
    std::string expected;                         // the kind of value, for messages
    std::function<bool(const std::string&)> set;  // false: not of that kind
    std::function<std::optional<std::string>()> value;
  };
  std::vector<Entry> entries_;
};

}  // namespace cairn
