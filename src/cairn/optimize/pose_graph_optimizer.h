// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cairn/core/progress.h"
#include "cairn/geometry/robust_kernel.h"
#include "cairn/map/pose_graph.h"

namespace cairn {

/// Names the poses at which the optimiser starts.
enum class PoseGraphStart {
  given,    ///< the poses in the graph
  chordal,  ///< the result of relax_chordal, which does not depend on the poses in the graph
  best,     ///< whichever of `given` and `chordal` costs less
};

/// Sets the kernel, the start and the convergence of optimize_pose_graph.
struct PoseGraphOptions {
  RobustKernel kernel = RobustKernel::none;  ///< applied to edges flagged robust
  /// Scale of the kernel in standard deviations of a whole edge; 3.5 leaves 95 % of good edges unweighted
  /// (the square root of chi-square's 95 % quantile at 6 degrees of freedom, 12.6).
  double robust_scale = 3.5;
  /// Both starts are tried by default: odometry that has drifted far leads plain least squares into a wrong
  /// minimum, and a relaxation with wrong loops is worse than odometry.
  PoseGraphStart start = PoseGraphStart::best;
  int max_iterations = 100;  ///< maximum number of Levenberg-Marquardt steps; 5 to 30 are usual
  /// Relative decrease of the cost below which a step has converged. Tight, because steps near a minimum
  /// converge quadratically.
  double relative_tolerance = 1e-9;

  /// Throws PreconditionError if a value is out of range.
  void validate() const;
};

/// Describes the result of optimize_pose_graph.
struct PoseGraphReport {
  double chi2_before = 0;  ///< of all edges, without kernel, at the poses given
  double chi2_start = 0;   ///< of all edges, without kernel, at the optimiser's start
  double chi2_after = 0;   ///< of all edges, without kernel, at the result
  PoseGraphStart started_at = PoseGraphStart::given;  ///< given or chordal
  int iterations = 0;                                 ///< steps tried, rejected ones included
  bool converged = false;   ///< false after max_iterations, a stop by the user, or a failed factorisation
  std::string termination;  ///< reason for the end, in words
  std::vector<std::int64_t> held;  ///< ids of the vertices held constant, in the graph's order
  int components = 0;              ///< number of connected parts of the graph
  double seconds = 0;              ///< wall clock
};

/// Moves the vertices of `graph` to the minimum of sum_k rho_k(e_k^T information_k e_k), with the error of
/// pose_graph_residual.h, by Levenberg-Marquardt over a sparse Cholesky factorisation. Holds the vertices in
/// `graph.fixed` and, in each connected part without one, the first vertex, because parts cannot be placed
/// relative to each other. A vertex without edges is not moved; vertices of a planar graph stay in the plane.
/// `progress` (may be null) gets one update for each iteration and may stop it; the best poses so far are
/// kept. One thread, deterministic. Throws PreconditionError if an option is out of range, an id occurs
/// twice, an edge or a fixed id names an unknown vertex, or an edge joins a vertex to itself.
PoseGraphReport optimize_pose_graph(PoseGraph& graph, const PoseGraphOptions& options = {},
                                    Progress* progress = nullptr);

}  // namespace cairn
