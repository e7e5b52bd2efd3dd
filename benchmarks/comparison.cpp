// SPDX-License-Identifier: Apache-2.0
#include "comparison.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>

namespace cairn::bench {
namespace {

constexpr const char* kOurs = "/cairn";
constexpr const char* kPeers = "/peer";

/// Collects the medians and prints nothing meanwhile but a line per benchmark.
class MedianReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.aggregate_name != "median") continue;
      const bool wall = run.run_name.time_type == "real_time";
      const double ms = (wall ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime());
      median_ms_[run.run_name.function_name] = ms;
      fmt::print(stderr, "{:<60} {:10.3f} ms\n", run.run_name.function_name, ms);
    }
  }

  [[nodiscard]] std::optional<double> median_ms(const std::string& name) const {
    const auto found = median_ms_.find(name);
    return found == median_ms_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::map<std::string, double> median_ms_;
};

std::string name_of(const TimedComparison& comparison, const char* whose) {
  return fmt::format("{}, {} thread{}{}", comparison.work, comparison.threads,
                     comparison.threads > 1 ? "s" : "", whose);
}

void register_work(const std::string& name, const Work& work, int threads) {
  auto* registered = benchmark::RegisterBenchmark(name.c_str(), [work](benchmark::State& state) {
    for ([[maybe_unused]] auto iteration : state) work();
  });
  registered->Unit(benchmark::kMillisecond);
  if (threads > 1) registered->UseRealTime();
}

const char* verdict(bool held) {
  return held ? "yes" : "NO";
}

std::string limit_of(const TimedComparison& comparison) {
  if (comparison.threads > 1) return "";
  if (comparison.at_most_ms) return fmt::format("{} ms", *comparison.at_most_ms);
  return comparison.at_most_share ? fmt::format("1/{:.3g}", 1 / *comparison.at_most_share) : "";
}

/// One row; whether its limit holds.
bool print_row(const TimedComparison& comparison, const MedianReporter& medians) {
  const auto ours = medians.median_ms(name_of(comparison, kOurs));
  const auto peers = medians.median_ms(name_of(comparison, kPeers));
  if (!ours) return true;  // filtered out
  const std::string limit = limit_of(comparison);
  bool held = true;
  if (comparison.at_most_ms) held = *ours <= *comparison.at_most_ms;
  if (comparison.at_most_share && peers) held = held && *ours <= *comparison.at_most_share * *peers;
  fmt::print("| {} | {} | {:.3g} | {} | {} | {} | {} |\n", comparison.work, comparison.threads, *ours,
             peers ? fmt::format("{:.3g}", *peers) : "", peers ? fmt::format("1/{:.1f}", *peers / *ours) : "",
             limit, limit.empty() ? "" : verdict(held));
  return held || limit.empty();
}

bool print_row(const QualityComparison& comparison) {
  bool held = true;
  std::string limit;
  if (comparison.at_least_share) {
    held = comparison.ours >= *comparison.at_least_share * comparison.peers;
    limit = fmt::format("at least {:.0f} % of the peer's", 100 * *comparison.at_least_share);
  }
  if (comparison.at_most) {
    held = held && comparison.ours <= *comparison.at_most;
    limit = fmt::format("at most {}", *comparison.at_most);
  }
  fmt::print("| {} | {:.4g} | {} | {} | {} |\n", comparison.work, comparison.ours,
             comparison.at_least_share ? fmt::format("{:.4g}", comparison.peers) : "", limit,
             limit.empty() ? "" : verdict(held));
  return held;
}

/// Google Benchmark's arguments: ours first, so that the user's go before them.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> all{argv[0], "--benchmark_repetitions=11", "--benchmark_min_time=0.05",
                               "--benchmark_enable_random_interleaving=true"};
  all.insert(all.end(), argv + 1, argv + argc);
  return all;
}

}  // namespace

int run(const Comparisons& comparisons, int argc, char** argv) {
  auto all = arguments(argc, argv);
  std::vector<char*> pointers;
  for (std::string& argument : all) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 1;
  for (const TimedComparison& comparison : comparisons.timed) {
    register_work(name_of(comparison, kOurs), comparison.ours, comparison.threads);
    if (comparison.peers) register_work(name_of(comparison, kPeers), comparison.peers, comparison.threads);
  }
  MedianReporter medians;
  benchmark::RunSpecifiedBenchmarks(&medians);
  int missed = 0;
  fmt::print(
      "| work | threads | cairn, ms | peer, ms | share | at most | held "
      "|\n|---|--:|--:|--:|--:|--:|---|\n");
  for (const TimedComparison& comparison : comparisons.timed)
    if (!print_row(comparison, medians)) ++missed;
  fmt::print("\n| quality | cairn | peer | limit | held |\n|---|--:|--:|---|---|\n");
  for (const QualityComparison& comparison : comparisons.quality)
    if (!print_row(comparison)) ++missed;
  return missed;
}

}  // namespace cairn::bench
