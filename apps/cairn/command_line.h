// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11's own name
class App;
class Option;
}  // namespace CLI

namespace cairn::app {

/// Numbers that an option accepts, both ends included, and never NaN.
struct NumberRange {
  double low, high;
  std::string word;  ///< accepted as well, unless empty
};
/// Words that an option accepts.
struct Choices {
  std::vector<std::string> names;
  bool ignores_case = false;
};

/// The ending of the file names that an option accepts, with its point, in small letters or capitals.
struct FileEnding {
  std::string ending;
};

[[nodiscard]] NumberRange number_in(double low, double high);
[[nodiscard]] NumberRange number_in_or(double low, double high, std::string word);
[[nodiscard]] Choices one_of(std::vector<std::string> names);
/// As one_of, in capitals or not; the value stays as it was written.
[[nodiscard]] Choices one_of_any_case(std::vector<std::string> names);

/// Stands for one option or positional argument of a CommandLine, which lives as long.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  Option& check(const NumberRange& range);
  Option& check(const Choices& choices);
  Option& check(const FileEnding& ending);
  /// Shows this name for the value in --help.
  Option& type_name(const std::string& name);
  /// Shows the variable's value as the default in --help.
  Option& show_default();
  /// Shows this text instead of "REQUIRED" and the like in --help.
  Option& help_text(const std::string& text);
  /// Takes lists of values with this character between them.
  Option& delimiter(char character);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// The command line of one command: what it takes, and how it is parsed. Hides CLI11, whose header costs each
/// source that includes it some seconds of compiler.
class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Adds an option ("-o,--output") or a positional argument ("SEQ") that sets `value`, whose value before is
  /// the default. An option with a list takes one value each time it is given, a positional one all that are
  /// left; one with an array takes as many as that holds.
  Option add_option(const std::string& names, std::string& value, const std::string& description);
  Option add_option(const std::string& names, double& value, const std::string& description);
  Option add_option(const std::string& names, int& value, const std::string& description);
  Option add_option(const std::string& names, std::uint64_t& value, const std::string& description);
  Option add_option(const std::string& names, std::optional<std::int64_t>& value,
                    const std::string& description);
  Option add_option(const std::string& names, std::vector<std::string>& value,
                    const std::string& description);
  Option add_option(const std::string& names, std::vector<double>& value, const std::string& description);
  Option add_option(const std::string& names, std::array<double, 2>& value, const std::string& description);
  Option add_option(const std::string& names, std::array<double, 3>& value, const std::string& description);
  Option add_flag(const std::string& names, bool& value, const std::string& description);

  /// Adds an option with a value that makes parse() print `text` of that value and end the program with 0,
  /// whatever else is given or missing.
  Option add_report(const std::string& names, const std::string& description,
                    std::function<std::string(const std::string&)> text);

  /// Makes the last of the positional arguments `values` the argument `last`, named `name` in messages;
  /// `usage` is what --help shows of them.
  void split_last(std::vector<std::string>& values, std::string& last, const std::string& name,
                  const std::string& usage);

  /// Sets what ends the text of --help; the function is called only when it is shown.
  void footer(const std::string& text);
  void footer(std::function<std::string()> text);

  /// Adds a command of this command, of which exactly one must be given.
  CommandLine& add_command(const std::string& name, const std::string& description);
  /// Whether this command was given.
  [[nodiscard]] bool parsed() const;
  /// How many times an option was given.
  [[nodiscard]] std::size_t count(const std::string& option) const;

  /// Parses; returns an exit code if the program is to end here (0 after --help, 2 after wrong usage, which
  /// is explained on stderr).
  [[nodiscard]] std::optional<int> parse(int argc, char** argv);

 private:
  explicit CommandLine(CLI::App& command);

  std::unique_ptr<CLI::App> owned_;  ///< none: a command of another one
  CLI::App* app_;
  std::vector<std::unique_ptr<CommandLine>> commands_;
};

}  // namespace cairn::app
