// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/slam/slam.h"
#include "slam_parameters.h"

namespace cairn::app {

/// Which of the large outputs are wanted.
struct SlamOutputs {
  bool cloud = true;
  bool octree = true;
};

/// What was written, for the summary.
struct SlamSummary {
  std::int64_t cloud_points = 0;
  std::int64_t occupied_voxels = 0, free_voxels = 0;
  bool fused = false;  ///< cloud and octree, as far as wanted, were written
  double fusion_seconds = 0;
  double total_seconds = 0;
  int threads = 1;
  std::uint64_t seed = 1;
  bool odometry = false;
  std::optional<double> ate_m;  ///< RMSE after SE(3) alignment with the sequence's truth, where it has one
  std::int64_t ate_pairs = 0;
};

/// Trajectories, graphs, the map, and the effective configuration and calibration.
void write_slam_files(const std::filesystem::path& folder, const Sequence& sequence, const SlamResult& result,
                      SlamParameters& parameters);
/// The coloured cloud and the octree from the optimised keyframes, and a picture of the cloud.
void write_dense_files(const std::filesystem::path& folder, const Sequence& sequence,
                       const SlamResult& result, const SlamParameters& parameters, const SlamOutputs& wanted,
                       const Executor& executor, Progress& progress, SlamSummary& summary);
/// run.json: the figures of the run, as `cairn slam --json` prints them.
[[nodiscard]] std::string format_run_json(const Sequence& sequence, const SlamResult& result,
                                          const SlamSummary& summary);
void print_summary(const Sequence& sequence, const SlamResult& result, const SlamSummary& summary,
                   const std::string& folder, const SlamOutputs& wanted);
/// Compares with the truth that the sequence carries, if any.
void add_accuracy(const Sequence& sequence, const SlamResult& result, SlamSummary& summary);

}  // namespace cairn::app
