// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/map/pose_graph.h"
#include "cairn/optimize/pose_graph_optimizer.h"

namespace cairn {

/// Holds what is told of an optimised pose graph beside the graph and the optimiser's report.
struct GraphSummary {
  std::string output;  ///< file, as the user named it
  std::string robust;  ///< name of the kernel, "none" without one
};

/// Returns sizes, chi-square before and after, and how the optimiser ended, for people.
[[nodiscard]] std::string format_graph_text(const PoseGraph& graph, const PoseGraphReport& report,
                                            const GraphSummary& summary);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_graph_json(const PoseGraph& graph, const PoseGraphReport& report,
                                            const GraphSummary& summary);

}  // namespace cairn
