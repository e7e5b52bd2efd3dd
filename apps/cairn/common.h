// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cairn/core/progress.h"
#include "cairn/sequence/sequence.h"
#include "command_line.h"

namespace cairn::app {

/// Options that every subcommand has.
struct CommonOptions {
  std::string config;                 ///< --config FILE
  std::vector<std::string> settings;  ///< --set key=value
  int threads = 0;                    ///< --threads N; 0: all cores
  std::uint64_t seed = 1;             ///< --seed N
  bool json = false;                  ///< --json
  bool quiet = false;                 ///< --quiet

  [[nodiscard]] int thread_count() const;
};

/// Which of the common options a subcommand really has: an option that would do nothing is not offered.
struct CommonOptionSet {
  bool config = false, threads = false, seed = false, json = true, quiet = true;
};

void add_common_options(CommandLine& app, CommonOptions& options, const CommonOptionSet& offers);
/// --camera, --frames, --without and the patterns of images for whatever reads a sequence.
struct SequenceArguments {
  std::string folder, camera, frames, without, left, right, color, depth;
  [[nodiscard]] SequenceOptions options() const;
};
void add_sequence_options(CommandLine& app, SequenceArguments& arguments);

/// A bar on stderr with rate and time left on a terminal, a line every few seconds elsewhere, nothing with
/// --quiet. Installs the Ctrl-C handler: the first asks to stop, a second ends the program.
[[nodiscard]] std::unique_ptr<Progress> make_progress(const CommonOptions& options);

/// Prints each on stderr as "cairn: ...".
void print_warnings(const std::vector<std::string>& warnings);

/// The most memory that the program has had so far.
[[nodiscard]] double peak_memory_mb();

}  // namespace cairn::app
