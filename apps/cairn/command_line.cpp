// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "cairn/core/text.h"

namespace cairn::app {
namespace {

/// Every option of a command and of its subcommands, as they are written.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const CLI::App* command : app.get_subcommands({}))
    for (std::string& name : option_names(*command)) names.push_back(std::move(name));
  return names;
}

/// Returns the first argument that looks like an option and is none; an empty text if there is no such.
std::string unknown_option(const CLI::App& app, int argc, char** argv) {
  const std::vector<std::string> names = option_names(app);
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    std::string name = argument.substr(0, argument.find('='));
    if (name.rfind("--", 0) == 0 && name.size() > 2 &&
        std::find(names.begin(), names.end(), name) == names.end())
      return name;
  }
  return "";
}

/// Says what is wrong in CLI11's words; of a misspelt option which it may be; if one of several commands is
/// wanted, which.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  if (const std::string name = unknown_option(app, argc, argv); !name.empty()) {
    const std::string nearest = nearest_name(name, option_names(app));
    const bool alike = edit_distance(name, nearest) <= name.size() / 3;
    return fmt::format("there is no option {}.{}", name,
                       alike ? fmt::format(" Did you mean {}?", nearest) : "");
  }
  if (app.get_require_subcommand_min() == 0 || !app.get_subcommands().empty()) return error.what();
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return fmt::format("expected one of {}, found {}", fmt::join(names, ", "),
                     argc > 1 ? fmt::format("'{}'", argv[1]) : "nothing");
}

/// CLI11 gives all names to a first positional of any number, so that its usage is written by hand.
class FixedUsage : public CLI::Formatter {
 public:
  explicit FixedUsage(std::string usage) : usage_(std::move(usage)) {}
  std::string make_option_usage(const CLI::Option*) const override { return usage_; }

 private:
  std::string usage_;
};

/// One value for each time an option is given: a greedy one would swallow the positional that follows.
Option list_option(CLI::Option& option) {
  if (!option.get_positional()) option.allow_extra_args(false);
  return Option(option);
}

}  // namespace

NumberRange number_in(double low, double high) {
  return {low, high, ""};
}

NumberRange number_in_or(double low, double high, std::string word) {
  return {low, high, std::move(word)};
}

Choices one_of(std::vector<std::string> names) {
  return {std::move(names), false};
}

Choices one_of_any_case(std::vector<std::string> names) {
  return {std::move(names), true};
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::check(const NumberRange& range) {
  const auto complain = [range](const std::string& text) -> std::string {
    double value = 0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    if (is_number && value >= range.low && value <= range.high) return "";
    if (!range.word.empty() && text == range.word) return "";
    return fmt::format("'{}' is no number from {:g} to {:g}{}", text, range.low, range.high,
                       range.word.empty() ? "" : fmt::format(", nor '{}'", range.word));
  };
  option_->check(CLI::Validator(complain, ""));
  return *this;
}

Option& Option::check(const Choices& choices) {
  option_->check(choices.ignores_case ? CLI::IsMember(choices.names, CLI::ignore_case)
                                      : CLI::IsMember(choices.names));
  return *this;
}

Option& Option::check(const FileEnding& ending) {
  const auto complain = [ending](const std::string& text) -> std::string {
    const std::string found = CLI::detail::to_lower(std::filesystem::path(text).extension().string());
    return found == ending.ending ? "" : fmt::format("'{}' does not end in {}", text, ending.ending);
  };
  option_->check(CLI::Validator(complain, ""));
  return *this;
}

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::help_text(const std::string& text) {
  option_->option_text(text);
  return *this;
}

Option& Option::delimiter(char character) {
  option_->delimiter(character);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : owned_(std::make_unique<CLI::App>(description, name)), app_(owned_.get()) {}

CommandLine::CommandLine(CLI::App& command) : app_(&command) {}

CommandLine::~CommandLine() = default;

Option CommandLine::add_option(const std::string& names, std::string& value, const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, double& value, const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, int& value, const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::uint64_t& value,
                               const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::optional<std::int64_t>& value,
                               const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::vector<std::string>& value,
                               const std::string& description) {
  return list_option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::vector<double>& value,
                               const std::string& description) {
  return list_option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::array<double, 2>& value,
                               const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_option(const std::string& names, std::array<double, 3>& value,
                               const std::string& description) {
  return Option(*app_->add_option(names, value, description));
}

Option CommandLine::add_flag(const std::string& names, bool& value, const std::string& description) {
  return Option(*app_->add_flag(names, value, description));
}

Option CommandLine::add_report(const std::string& names, const std::string& description,
                               std::function<std::string(const std::string&)> text) {
  const auto report = [text = std::move(text)](const std::string& value) {
    throw CLI::CallForVersion(text(value), 0);  // CLI11's way to end with a text before all else is looked at
  };
  return Option(*app_->add_option_function<std::string>(names, report, description));
}

void CommandLine::split_last(std::vector<std::string>& values, std::string& last, const std::string& name,
                             const std::string& usage) {
  app_->formatter(std::make_shared<FixedUsage>(usage));
  app_->callback([&values, &last, name] {
    if (values.size() < 2) throw CLI::RequiredError(name);
    last = values.back();
    values.pop_back();
  });
}

void CommandLine::footer(const std::string& text) {
  app_->footer(text);
}

void CommandLine::footer(std::function<std::string()> text) {
  app_->footer(std::move(text));
}

CommandLine& CommandLine::add_command(const std::string& name, const std::string& description) {
  app_->require_subcommand(1);
  commands_.emplace_back(new CommandLine(*app_->add_subcommand(name, description)));
  return *commands_.back();
}

bool CommandLine::parsed() const {
  return app_->parsed();
}

std::size_t CommandLine::count(const std::string& option) const {
  return app_->count(option);
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app_->help("cairn"));
    return 0;
  } catch (const CLI::CallForVersion& report) {
    fmt::print("{}", report.what());
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "cairn {}: {}\n  'cairn {} --help' shows the options and an example.\n",
               app_->get_name(), usage_error(*app_, error, argc, argv), app_->get_name());
    return 2;
  }
  return std::nullopt;
}

}  // namespace cairn::app
