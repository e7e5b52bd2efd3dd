// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/simulate/simulation_writer.h"
#include "cairn/simulate/write_kitti.h"

namespace cairn {

/// Holds what is told of a simulated recording.
struct SimulationSummary {
  SimulationReport report;
  std::string folder;
  std::uint64_t seed = 1;
  std::string next;  ///< a command to try with it
};

/// Returns frames, path and folder of a simulated recording, for people.
[[nodiscard]] std::string format_simulation_text(const SimulationSummary& summary);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_simulation_json(const SimulationSummary& summary);

/// Returns frames, poses and folder of a rectified recording, for people.
[[nodiscard]] std::string format_rectified_text(const RectifiedReport& report, const std::string& folder);
/// Returns the same as a JSON object.
[[nodiscard]] std::string format_rectified_json(const RectifiedReport& report, const std::string& folder);

}  // namespace cairn
