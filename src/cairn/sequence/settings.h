// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
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

/// Returns where the setting stands, for messages: "params.yaml:3", "--set".
[[nodiscard]] std::string place_of(const Setting& setting);

/// A YAML mapping of names to plain values, or lines `key=value` (comments with #, a semicolon at the end
/// tolerated). InputError names the line of what is neither.
[[nodiscard]] std::vector<Setting> read_settings(const std::filesystem::path& path);
/// "key=value" as given by `option`.
[[nodiscard]] Setting parse_setting(const std::string& text, const std::string& option);

}  // namespace cairn
