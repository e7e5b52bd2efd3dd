// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/parameter_file.h"

#include <fmt/format.h>

#include <vector>

#include "cairn/core/error.h"
#include "cairn/sequence/settings.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

ParameterFileSearch judge(const fs::path& path, const SettingTable& table) {
  std::vector<Setting> settings;
  try {
    settings = read_settings(path);
  } catch (const InputError&) {
    return {path, false, "its lines are not all key=value; --config says which one"};
  }
  for (const Setting& setting : settings) {
    if (!table.knows(setting.key))
      return {path, false, fmt::format("'{}' in line {} is no parameter", setting.key, setting.line)};
  }
  if (settings.empty()) return {path, false, "it sets nothing"};
  return {path, true, ""};
}

}  // namespace

ParameterFileSearch find_parameters(const fs::path& folder, const SettingTable& table) {
  constexpr const char* kName = "parameters.txt";
  for (const fs::path& path : {folder / kName, fs::path(kName)})
    if (fs::is_regular_file(path)) return judge(path, table);
  return {};
}

}  // namespace cairn
