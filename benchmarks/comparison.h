// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cairn::bench {

using Work = std::function<void()>;

/// The same work done by cairn and by a peer, timed in one process with the repetitions of both interleaved.
/// The limits are those of one thread.
struct TimedComparison {
  std::string work;  ///< "ORB 1000, 640x480"
  int threads = 1;   ///< 1: processor time is compared; more: wall time
  Work ours;
  Work peers;                           ///< may be empty where there is a limit alone
  std::optional<double> at_most_share;  ///< of the peer's time
  std::optional<double> at_most_ms;
};

/// A figure of quality of cairn and of a peer, computed once.
struct QualityComparison {
  std::string work;  ///< "ORB 1000, redkitchen 0 and 10: correct matches"
  double ours = 0;
  double peers = 0;
  std::optional<double> at_least_share;  ///< of the peer's figure
  std::optional<double> at_most;         ///< absolute limit of ours
};

/// What a benchmark run consists of, in the order of its tables.
struct Comparisons {
  std::vector<TimedComparison> timed;
  std::vector<QualityComparison> quality;
};

/// Runs the timed ones whose name matches the filter, prints both tables in Markdown, and returns how many
/// rows miss their limit. argc and argv are Google Benchmark's.
int run(const Comparisons& comparisons, int argc, char** argv);

}  // namespace cairn::bench
