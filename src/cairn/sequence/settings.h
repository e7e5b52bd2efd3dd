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
};

/// Returns the location of the setting, for messages: "params.yaml:3", "--set".
[[nodiscard]] std::string place_of(const Setting& setting);

/// Reads a YAML mapping of names to plain values, or lines `key=value` (comments with #, a semicolon at the
/// end tolerated). Throws InputError that names the line of anything else.
[[nodiscard]] std::vector<Setting> read_settings(const std::filesystem::path& path);
/// Parses "key=value" as given by `option`. Throws InputError for anything else.
[[nodiscard]] Setting parse_setting(const std::string& text, const std::string& option);

}  // namespace cairn
