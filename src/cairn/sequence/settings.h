// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cairn {

/// Holds one `key = value` of a configuration and its location.
struct Setting {
  std::string key;
  std::string value;
  std::string source;  ///< file, or the option it was given by
  int line = 0;        ///< 1-based, 0 if there is no file
  /// True for a line `key=value`, in which words may follow a number, a truth or a name.
  bool may_have_remark = false;
};

/// Returns the location of the setting, for messages: "params.yaml:3", "--set".
[[nodiscard]] std::string place_of(const Setting& setting);

/// Reads a YAML mapping of names to plain values, also with OpenCV's first line `%YAML:1.0`, or lines
/// `key=value`: comments begin with # or //, or with ; at the beginning of a line; a semicolon may end the
/// value, and words may follow a number, a truth or a name. Throws InputError that names the line of anything
/// else.
[[nodiscard]] std::vector<Setting> read_settings(const std::filesystem::path& path);
/// Parses "key=value" as given by `option`. Throws InputError for anything else.
[[nodiscard]] Setting parse_setting(const std::string& text, const std::string& option);

}  // namespace cairn
