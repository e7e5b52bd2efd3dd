// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/sequence/setting_table.h"

namespace cairn {

/// Holds what a search for a file of parameters found.
struct ParameterFileSearch {
  std::filesystem::path path;  ///< empty: there is none
  bool is_taken = false;       ///< it has parameters, and only such that are known
  std::string reason;          ///< why it is not taken, a clause with the line
};

/// Looks for parameters.txt in the folder of a sequence, then in the folder where the program runs. The first
/// that is there is taken if each line sets a parameter of `table`: other programs have files of that name.
[[nodiscard]] ParameterFileSearch find_parameters(const std::filesystem::path& folder,
                                                  const SettingTable& table);

}  // namespace cairn
