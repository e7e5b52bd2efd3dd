// SPDX-License-Identifier: Apache-2.0
#include "common.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "cairn/core/text.h"

namespace cairn::app {
namespace {

std::atomic<bool> interrupted = false;

void on_interrupt(int signal) {
  if (interrupted.exchange(true)) std::_Exit(128 + signal);
}

/// A stop ends the stage it came in; the next one, which writes what was done, begins afresh.
class StoppableProgress : public Progress {
 public:
  void start(std::string_view, std::int64_t, std::string_view) override { interrupted = false; }
  [[nodiscard]] bool stop_requested() const override { return interrupted; }
};

class SilentProgress : public StoppableProgress {
 public:
  void warn(const std::string& message) override { fmt::print(stderr, "cairn: {}\n", message); }
};

class TerminalProgress : public StoppableProgress {
 public:
  void start(std::string_view stage, std::int64_t total, std::string_view unit) override {
    StoppableProgress::start(stage, total, unit);
    stage_ = stage;
    unit_ = unit;
    total_ = total;
    done_ = 0;
    begun_ = shown_ = Clock::now();
  }
  void update(std::int64_t done) override {
    done_ = done;
    const auto now = Clock::now();
    const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000);
    if (now - shown_ < pause) return;
    shown_ = now;
    show();
    visible_ = true;
  }
  void finish() override {
    if (visible_) {
      show();
      if (terminal_) fmt::print(stderr, "\n");
    }
    visible_ = false;
  }
  void warn(const std::string& message) override {
    if (visible_ && terminal_) fmt::print(stderr, "\r\033[K");
    fmt::print(stderr, "cairn: {}\n", message);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void show() const {
    const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    const double rate = seconds > 0 ? static_cast<double>(done_) / seconds : 0;
    const double share = total_ > 0 ? static_cast<double>(done_) / static_cast<double>(total_) : 1;
    const double left = rate > 0 ? static_cast<double>(total_ - done_) / rate : 0;
    const std::string numbers =
        fmt::format("{}/{} {}  {:.1f} {}/s  {:.0f} s left", done_, total_, unit_, rate, unit_, left);
    if (!terminal_) {
      fmt::print(stderr, "{}: {}\n", stage_, numbers);
      return;
    }
    constexpr int kBarWidth = 24;
    const int filled = static_cast<int>(share * kBarWidth);
    fmt::print(stderr, "\r\033[K{:<9} [{:#<{}}{:.<{}}] {}", stage_, "", filled, "", kBarWidth - filled,
               numbers);
    std::fflush(stderr);
  }

  const bool terminal_ = ::isatty(STDERR_FILENO) != 0;
  bool visible_ = false;
  std::string stage_, unit_;
  std::int64_t total_ = 0, done_ = 0;
  Clock::time_point begun_, shown_;
};

}  // namespace

int CommonOptions::thread_count() const {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void add_common_options(CLI::App& app, CommonOptions& options, const Offers& offers) {
  if (offers.config) {
    app.add_option("--config", options.config, "YAML or key=value file with settings")->type_name("FILE");
    app.add_option("--set", options.settings, "one setting, overrides --config; may be repeated")
        ->allow_extra_args(false)  // else it takes what stands behind its value, too: SEQ
        ->type_name("KEY=VALUE");
  }
  if (offers.threads) {
    app.add_option("--threads", options.threads,
                   "threads; the result does not depend on it (default: all cores)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
  }
  if (offers.seed)
    app.add_option("--seed", options.seed, "seed of everything random")
        ->capture_default_str()
        ->type_name("N");
  if (offers.json) app.add_flag("--json", options.json, "one JSON object on stdout, nothing else");
  if (offers.quiet) app.add_flag("--quiet", options.quiet, "no progress");
}

SequenceOptions SequenceArguments::options() const {
  SequenceOptions result;
  result.camera = camera;
  if (!frames.empty()) result.frames = parse_frame_range(frames, "--frames");
  if (!without.empty()) result.without = parse_frame_range(without, "--without");
  return result;
}

void add_sequence_options(CLI::App& app, SequenceArguments& arguments) {
  app.add_option("--camera", arguments.camera,
                 "camera.yaml, or tum-fr1, tum-fr2, tum-fr3 (default: the sequence's own)")
      ->type_name("FILE|NAME");
  app.add_option("--frames", arguments.frames, "only these frames, by position, end excluded")
      ->type_name("A:B[:S]");
  app.add_option("--without", arguments.without, "all but these frames")->type_name("A:B[:S]");
}

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

/// The first argument that looks like an option and is none; empty where there is no such.
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

/// What CLI11 says; where an option is misspelt, which it may be; where one of several subcommands is wanted,
/// which.
std::string complaint(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
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

}  // namespace

CLI::Validator number_in(double low, double high) {
  const auto complaint = [low, high](const std::string& text) -> std::string {
    double value = 0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    if (is_number && value >= low && value <= high) return "";
    return fmt::format("'{}' is no number from {:g} to {:g}", text, low, high);
  };
  return CLI::Validator(complaint, "");
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", app.help("cairn"));
    return 0;
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "cairn {}: {}\n  'cairn {} --help' shows the options and an example.\n",
               app.get_name(), complaint(app, error, argc, argv), app.get_name());
    return 2;
  }
  return std::nullopt;
}

std::unique_ptr<Progress> make_progress(const CommonOptions& options) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (options.quiet || options.json) return std::make_unique<SilentProgress>();
  return std::make_unique<TerminalProgress>();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace cairn::app
