// SPDX-License-Identifier: Apache-2.0
#include "parameter_arguments.h"

#include <fmt/format.h>

#include "cairn/sequence/parameter_file.h"
#include "cairn/sequence/settings.h"

namespace cairn::app {
namespace {

void apply(const SettingTable& table, const Setting& setting) {
  if (const std::string warning = table.apply(setting); !warning.empty()) print_warnings({warning});
}

}  // namespace

void add_parameter_help(CommandLine& app, const std::string& examples, std::vector<ParameterRow> (*rows)()) {
  app.add_report(
         "--parameters",
         "print all parameters with default, range and meaning, as text or as the markdown table of the "
         "documents, and end",
         [rows](const std::string& format) {
           return format == "text" ? format_as_text(rows()) : format_as_markdown(rows());
         })
      .check(one_of({"text", "markdown"}))
      .type_name("FORMAT");
  app.footer([examples, rows] {
    return fmt::format(
        "{}\nParameters for --set and --config: name, default, accepted values and meaning\n\n{}", examples,
        format_as_text(rows()));
  });
}

void find_parameter_file(const std::string& folder, const SettingTable& table, CommonOptions& options) {
  if (!options.config.empty()) return;
  const ParameterFileSearch found = find_parameters(folder, table);
  if (found.path.empty()) return;
  const std::string path = found.path.string();
  if (!found.is_taken) return print_warnings({fmt::format("{} is not taken: {}", path, found.reason)});
  print_warnings({fmt::format("{} is taken for --config", path)});
  options.config = path;
}

void apply_settings(const CommonOptions& options, const SettingTable& table) {
  if (!options.config.empty()) {
    for (const Setting& setting : read_settings(options.config)) apply(table, setting);
  }
  for (const std::string& text : options.settings) apply(table, parse_setting(text, "--set"));
}

}  // namespace cairn::app
