// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Holds poses and measured relative poses between them. It is optimised by optimize/pose_graph_optimizer.h
/// and stored by map_files/g2o_file.h.
struct PoseGraph {
  /// Holds a pose and its id.
  struct Vertex {
    std::int64_t id = 0;  ///< >= 0, unique in the graph
    Rigid3 world_from_vertex;
  };

  /// Holds a measurement of the pose of vertex b in the frame of vertex a.
  struct Edge {
    std::int64_t a = 0;  ///< id of a vertex
    std::int64_t b = 0;  ///< id of another vertex
    Rigid3 a_from_b;     ///< the measurement
    /// Inverse covariance of the error (translation in metres, vector part of the quaternion), in g2o's
    /// order; symmetric, positive semi-definite. The vector part is half the rotation vector for small
    /// errors: see `information_from_std`.
    Matrix6d information = Matrix6d::Identity();
    bool robust = false;  ///< whether it may be wrong (a loop closure): the optimiser's robust kernel then
                          ///< applies to it
  };

  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<std::int64_t> fixed;  ///< ids of vertices that must stay where they are; may be empty
  /// Whether all poses and measurements lie in the plane: z = 0 and turns about z. The error's rotation is
  /// then the angle itself, as in g2o's 2D graphs, and information has only the rows and columns of x, y and
  /// the last, of the angle in radians; all others are 0.
  bool planar = false;
};

/// Computes the information of an edge whose translation has standard deviation `translation_std_m` (metres)
/// along each axis and whose rotation vector has `rotation_std_rad`: diag(1/st^2, 4/sr^2), because the error
/// is half the rotation vector. Throws PreconditionError unless both are above 0.
[[nodiscard]] Matrix6d information_from_std(double translation_std_m, double rotation_std_rad);

/// Returns the position in `graph.vertices` of each id. Throws PreconditionError if an id occurs twice.
[[nodiscard]] std::unordered_map<std::int64_t, std::size_t> vertex_positions(const PoseGraph& graph);

/// Flags as robust exactly the edges that do not join two successive vertices: a g2o file does not say which
/// edges are loop closures, and odometry joins each pose to the next. Returns how many are flagged. Throws
/// PreconditionError if an edge has an unknown vertex.
std::size_t flag_loop_edges_robust(PoseGraph& graph);

}  // namespace cairn
