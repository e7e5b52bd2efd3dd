// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cairn/map/pose_graph.h"

namespace cairn {

/// Reads a pose graph in g2o's text format (Kuemmerle et al. 2011), in 3D or in the plane:
///
///     VERTEX_SE3:QUAT id x y z qx qy qz qw
///     EDGE_SE3:QUAT a b x y z qx qy qz qw  i11 i12 .. i16 i22 .. i66
///     VERTEX_SE2 id x y theta
///     EDGE_SE2 a b x y theta  i11 i12 i13 i22 i23 i33
///     FIX id [id ..]
///
/// with the pose world_from_vertex, the measurement a_from_b and the upper triangle of the information, row
/// by row, in the order (translation, vector part of the quaternion), or (x, y, theta in radians). Lines may
/// come in any order; vertices and edges keep theirs. Quaternions are normalised. All edges come with robust
/// = false. Other lines, such as PARAMS_SE3OFFSET or vertices of landmarks, are passed over; `warnings`,
/// unless null, gets one that counts them. InputError, with the line, for what would change the result:
/// another number of fields, no finite number, an id that is negative or occurs twice, an edge or FIX with an
/// unknown vertex, an edge from a vertex to itself, a quaternion far from length 1, an information matrix
/// with a negative eigenvalue, an edge of another kind, a graph partly in 3D and partly in the plane, a file
/// without vertices.
[[nodiscard]] PoseGraph read_g2o(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);

/// Returns the graph in g2o's text format (see read_g2o), readable by g2o and GTSAM. Numbers are the shortest
/// that read back to the same bits; angles of planar graphs, from -pi to pi, may differ in the last one. The
/// robust flags are not stored: the format has no place for them.
[[nodiscard]] std::string format_g2o(const PoseGraph& graph);

}  // namespace cairn
