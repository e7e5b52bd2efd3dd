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
#include <filesystem>
#include <thread>

#include "cairn/sequence/frame_list.h"

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

void add_common_options(CommandLine& app, CommonOptions& options, const CommonOptionSet& offers) {
  if (offers.config) {
    app.add_option("--config", options.config, "YAML or key=value file with settings").type_name("FILE");
    app.add_option("--set", options.settings, "one setting, overrides --config; may be repeated")
        .type_name("KEY=VALUE");
  }
  if (offers.threads) {
    app.add_option("--threads", options.threads,
                   "threads; the result does not depend on it (default: all cores)")
        .check(number_in(1, 1024))
        .type_name("N");
  }
  if (offers.seed)
    app.add_option("--seed", options.seed, "seed of everything random").show_default().type_name("N");
  if (offers.json) app.add_flag("--json", options.json, "one JSON object on stdout, nothing else");
  if (offers.quiet) app.add_flag("--quiet", options.quiet, "no progress");
}

SequenceOptions SequenceArguments::options() const {
  SequenceOptions result;
  result.camera = camera;
  result.left = left;
  result.right = right;
  result.color = color;
  result.depth = depth;
  if (std::filesystem::is_regular_file(frames))
    result.frame_numbers = read_frame_list(frames);
  else if (!frames.empty())
    result.frames = parse_frame_range(frames, "--frames");
  if (!without.empty()) result.without = parse_frame_range(without, "--without");
  return result;
}

void add_sequence_options(CommandLine& app, SequenceArguments& arguments) {
  app.add_option("--camera", arguments.camera,
                 "camera.yaml or the calibration of another program (OpenCV, ROS, Kalibr, COLMAP, RealSense, "
                 "Open3D), or tum-fr1, tum-fr2, tum-fr3, or a pinhole camera's numbers, pixels and units of "
                 "depth in a metre (default: the sequence's own)")
      .type_name("FILE|NAME|fx,fy,cx,cy[,scale]");
  const auto add_images = [&](const char* option, std::string& images, const char* meaning) {
    app.add_option(option, images, meaning).type_name("PATTERN");
  };
  add_images("--left", arguments.left, "left images, 'left/*.png' or a folder, in SEQ or from here");
  add_images("--right", arguments.right, "right images, paired by the stamps or numbers in the names");
  add_images("--color", arguments.color, "colour images of RGB-D, a pattern or a folder");
  add_images("--depth", arguments.depth, "depth images of RGB-D, a pattern or a folder");
  app.add_option(
         "--frames", arguments.frames,
         "only these frames, by position, end excluded; or those that a file as keyframe.txt lists by "
         "number, the last one of each line")
      .type_name("A:B[:S]|FILE");
  app.add_option("--without", arguments.without, "all but these frames").type_name("A:B[:S]");
}

std::unique_ptr<Progress> make_progress(const CommonOptions& options) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (options.quiet || options.json) return std::make_unique<SilentProgress>();
  return std::make_unique<TerminalProgress>();
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) fmt::print(stderr, "cairn: {}\n", warning);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace cairn::app
