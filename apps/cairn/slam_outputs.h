// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/report/slam_report.h"
#include "cairn/slam/slam.h"
#include "slam_parameters.h"

namespace cairn::app {

/// Which of the large outputs are wanted.
struct SlamOutputs {
  bool cloud = true;
  bool octree = true;
};

/// Trajectories, graphs, the map, and the effective configuration and calibration.
void write_slam_files(const std::filesystem::path& folder, const Sequence& sequence, const SlamResult& result,
                      SlamParameters& parameters);
/// The coloured cloud and the octree from the optimised keyframes, and a picture of the cloud.
void write_dense_files(const std::filesystem::path& folder, const Sequence& sequence,
                       const SlamResult& result, const SlamParameters& parameters, const SlamOutputs& wanted,
                       const Executor& executor, Progress& progress, SlamSummary& summary);
/// Compares with the truth that the sequence carries, if any.
void add_accuracy(const Sequence& sequence, const SlamResult& result, SlamSummary& summary);

}  // namespace cairn::app
