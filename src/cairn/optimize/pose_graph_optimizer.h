// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/progress.h"
#include "cairn/geometry/robust_kernel.h"
#include "cairn/map/pose_graph.h"

namespace cairn {

/// Where the optimiser starts.
enum class PoseGraphStart {
  given,    ///< at the poses in the graph
  chordal,  ///< at relax_chordal: does not depend on the poses in the graph
  best,     ///< at whichever of the two costs less
};

struct PoseGraphOptions {
  RobustKernel kernel = RobustKernel::none;  ///< of edges flagged robust
  /// Standard deviations of a whole edge at which the kernel sets in; 3.5 lets 95 % of good edges through
  /// (the square root of chi-square's 95 % quantile at 6 degrees of freedom, 12.6).
  double robust_scale = 3.5;
  /// Odometry that has drifted far leads plain least squares into a wrong minimum, and a relaxation that
  /// takes wrong loops for right ones is worse than odometry: so try both.
  PoseGraphStart start = PoseGraphStart::best;
  int max_iterations = 100;  ///< of Levenberg-Marquardt; 5 to 30 are usual
  /// Converged when a step lowers the cost by less than this share. Tight because iterations near a minimum
  /// gain quadratically.
  double relative_tolerance = 1e-9;

  /// PreconditionError for a value out of range.
  void validate() const;
};

struct PoseGraphReport {
  double chi2_before = 0;                             ///< of all edges, without kernel, at the poses given
  double chi2_start = 0;                              ///< the same where the optimiser started
  double chi2_after = 0;                              ///< the same at the result
  PoseGraphStart started_at = PoseGraphStart::given;  ///< given or chordal
  int iterations = 0;                                 ///< steps tried, rejected ones included
  bool converged = false;          ///< false: max_iterations, stopped by the user, or a failed factorisation
  std::string termination;         ///< why it ended, in words
  std::vector<std::int64_t> held;  ///< ids of the vertices held constant, in the graph's order
  int components = 0;              ///< connected parts of the graph
  double seconds = 0;              ///< wall clock
};

/// Moves the vertices of `graph` to the minimum of sum_k rho_k(e_k^T information_k e_k), with the error of
/// pose_graph_residual.h, by Levenberg-Marquardt over a sparse Cholesky factorisation. Vertices in
/// `graph.fixed` are held, and in each connected part without one its first vertex: parts cannot be placed
/// relative to each other. A vertex without edges stays where it is. `progress` (may be null) gets one update
/// for each iteration, and may stop it: the best poses so far are kept.
/// One thread, deterministic. PreconditionError for double ids and edges to unknown vertices.
PoseGraphReport optimize_pose_graph(PoseGraph& graph, const PoseGraphOptions& options = {},
                                    Progress* progress = nullptr);

}  // namespace cairn
