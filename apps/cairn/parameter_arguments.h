// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cairn/core/parameter.h"
#include "cairn/sequence/parameter_table.h"
#include "cairn/sequence/setting_table.h"
#include "common.h"

namespace cairn::app {

/// Returns the table of a command's parameters, bound to the fields of `parameters`, which must live as long.
template <class Parameters>
[[nodiscard]] SettingTable table_of(Parameters& parameters) {
  SettingTable table;
  visit(parameters, table);
  return table;
}

/// Returns a row with the default, the range and the meaning of each parameter of a command.
template <class Parameters>
[[nodiscard]] std::vector<ParameterRow> default_rows() {
  Parameters parameters;
  return table_of(parameters).rows();
}

/// Adds --parameters FORMAT, which prints the rows as a table and ends the program, and ends --help with
/// `examples` and the same rows.
void add_parameter_help(CommandLine& app, const std::string& examples, std::vector<ParameterRow> (*rows)());

/// Names the file of parameters that lies where the RGB-D tutorial has it, parameters.txt in the sequence's
/// folder or where the program runs, if --config names none and its lines are parameters of `table`. One line
/// on stderr says which it is, or why one that lies there is not taken.
void find_parameter_file(const std::string& folder, const SettingTable& table, CommonOptions& options);

/// Applies the settings of --config, then those of --set. Each use of the former name of a parameter, or of a
/// retired one, is a warning on stderr. Throws InputError as SettingTable::apply and read_settings do.
void apply_settings(const CommonOptions& options, const SettingTable& table);

}  // namespace cairn::app
