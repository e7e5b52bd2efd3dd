// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/g2o_file.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <unordered_set>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/decompositions.h"
#include "cairn/geometry/unit_rotation.h"

namespace cairn {
namespace {

constexpr std::string_view kVertexTag = "VERTEX_SE3:QUAT";
constexpr std::string_view kEdgeTag = "EDGE_SE3:QUAT";
constexpr std::string_view kFixTag = "FIX";
constexpr std::string_view kMend = "Correct or delete the line.";

/// Holds what was read so far, and the lines that can be checked only when all vertices are known.
struct Reading {
  PoseGraph graph;
  std::unordered_set<std::int64_t> ids;
  std::vector<const TextLine*> edge_lines;
  std::vector<const TextLine*> fix_lines;  ///< one for each entry of graph.fixed
};

void expect_fields(const TextFile& file, const TextLine& line, std::size_t count, std::string_view layout) {
  if (line.fields.size() == count + 1) return;
  file.fail(line, fmt::format("{} values after {} ({})", count, line.fields[0], layout),
            fmt::format("{}", line.fields.size() - 1), std::string(kMend));
}

std::int64_t parse_id(const TextFile& file, const TextLine& line, std::size_t field) {
  const std::int64_t id = file.integer(line, field, "the vertex id");
  if (id < 0) file.fail(line, "a vertex id from 0 up", fmt::format("{}", id), std::string(kMend));
  return id;
}

Eigen::Quaterniond parse_quaternion(const TextFile& file, const TextLine& line, std::size_t first) {
  const auto value = [&](std::size_t i, std::string_view what) { return file.number(line, first + i, what); };
  const double x = value(0, "qx"), y = value(1, "qy"), z = value(2, "qz"), w = value(3, "qw");
  const Eigen::Quaterniond rotation(w, x, y, z);
  const double length = rotation.norm();
  constexpr double kMaxDeviation = 0.05;  // rounding to two digits passes, other columns do not
  if (!(std::abs(length - 1.0) <= kMaxDeviation)) {
    file.fail(line, "a quaternion of length 1", fmt::format("one of length {:.4g}", length),
              "Check the order of the columns: x y z qx qy qz qw.");
  }
  return unit_rotation(rotation);
}

Rigid3 parse_pose(const TextFile& file, const TextLine& line, std::size_t first) {
  const double x = file.number(line, first, "x");
  const double y = file.number(line, first + 1, "y");
  const double z = file.number(line, first + 2, "z");
  return {parse_quaternion(file, line, first + 3), {x, y, z}};
}

void check_information(const TextFile& file, const TextLine& line, const Matrix6d& information) {
  const Vector6d eigenvalues = eigen_of_symmetric(information).values;
  constexpr double kRounding = 1e-5;  // of the numbers in the file, six digits
  if (eigenvalues.minCoeff() >= -kRounding * eigenvalues.cwiseAbs().maxCoeff()) return;
  file.fail(
      line, "a positive semi-definite information matrix",
      fmt::format("one with the eigenvalue {:.4g}", eigenvalues.minCoeff()),
      "Information is the inverse of a covariance, upper triangle row by row: i11 i12 .. i16 i22 .. i66.");
}

Matrix6d parse_information(const TextFile& file, const TextLine& line, std::size_t first) {
  Matrix6d information;
  std::size_t field = first;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column, ++field) {
      const double value = file.number(line, field, fmt::format("i{}{}", row + 1, column + 1));
      information(row, column) = information(column, row) = value;
    }
  }
  check_information(file, line, information);
  return information;
}

void read_vertex(const TextFile& file, const TextLine& line, Reading& reading) {
  expect_fields(file, line, 8, "id x y z qx qy qz qw");
  const std::int64_t id = parse_id(file, line, 1);
  if (!reading.ids.insert(id).second) {
    file.fail(line, "each vertex once", fmt::format("vertex {} a second time", id), std::string(kMend));
  }
  reading.graph.vertices.push_back({id, parse_pose(file, line, 2)});
}

void read_edge(const TextFile& file, const TextLine& line, Reading& reading) {
  expect_fields(file, line, 30, "a b x y z qx qy qz qw and 21 of the information's upper triangle");
  PoseGraph::Edge edge;
  edge.a = parse_id(file, line, 1);
  edge.b = parse_id(file, line, 2);
  if (edge.a == edge.b) {
    file.fail(line, "an edge between two vertices", fmt::format("one from {} to itself", edge.a),
              std::string(kMend));
  }
  edge.a_from_b = parse_pose(file, line, 3);
  edge.information = parse_information(file, line, 10);
  reading.graph.edges.push_back(edge);
  reading.edge_lines.push_back(&line);
}

void read_fix(const TextFile& file, const TextLine& line, Reading& reading) {
  if (line.fields.size() < 2) file.fail(line, "ids after FIX", "none", std::string(kMend));
  for (std::size_t field = 1; field < line.fields.size(); ++field) {
    reading.graph.fixed.push_back(parse_id(file, line, field));
    reading.fix_lines.push_back(&line);
  }
}

[[noreturn]] void fail_tag(const TextFile& file, const TextLine& line) {
  const std::string_view tag = line.fields[0];
  const bool planar = tag.starts_with("VERTEX_SE2") || tag.starts_with("EDGE_SE2") || tag == "VERTEX2" ||
                      tag == "EDGE2" || tag == "VERTEX_XY";
  file.fail(line, fmt::format("{}, {} or {}", kVertexTag, kEdgeTag, kFixTag), fmt::format("'{}'", tag),
            planar ? "This is a 2D graph; only 3D pose graphs are supported."
                   : "Only 3D pose graphs are supported; remove what else the file holds.");
}

void read_line(const TextFile& file, const TextLine& line, Reading& reading) {
  const std::string_view tag = line.fields[0];
  if (tag == kVertexTag) return read_vertex(file, line, reading);
  if (tag == kEdgeTag) return read_edge(file, line, reading);
  if (tag == kFixTag) return read_fix(file, line, reading);
  fail_tag(file, line);
}

void check_references(const TextFile& file, const Reading& reading) {
  const auto check = [&](const TextLine& line, std::int64_t id) {
    if (reading.ids.contains(id)) return;
    file.fail(line, "ids of vertices of this file", fmt::format("{}, which is none", id), std::string(kMend));
  };
  for (std::size_t i = 0; i < reading.edge_lines.size(); ++i) {
    check(*reading.edge_lines[i], reading.graph.edges[i].a);
    check(*reading.edge_lines[i], reading.graph.edges[i].b);
  }
  for (std::size_t i = 0; i < reading.fix_lines.size(); ++i) {
    check(*reading.fix_lines[i], reading.graph.fixed[i]);
  }
}

void append_pose(fmt::memory_buffer& text, const Rigid3& pose) {
  const auto& t = pose.translation;
  const auto& q = pose.rotation;
  fmt::format_to(std::back_inserter(text), " {} {} {} {} {} {} {}", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                 q.w());
}

void append_edge(fmt::memory_buffer& text, const PoseGraph::Edge& edge) {
  fmt::format_to(std::back_inserter(text), "{} {} {}", kEdgeTag, edge.a, edge.b);
  append_pose(text, edge.a_from_b);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      fmt::format_to(std::back_inserter(text), " {}", edge.information(row, column));
    }
  }
  text.push_back('\n');
}

}  // namespace

PoseGraph read_g2o(const std::filesystem::path& path) {
  const TextFile file(path);
  Reading reading;
  for (const TextLine& line : file.lines()) read_line(file, line, reading);
  if (reading.graph.vertices.empty()) {
    throw InputError({path.string(), 0, fmt::format("vertices ({})", kVertexTag), "none",
                      "Check that this is the right file."});
  }
  check_references(file, reading);
  return std::move(reading.graph);
}

std::string format_g2o(const PoseGraph& graph) {
  fmt::memory_buffer text;
  for (const PoseGraph::Vertex& vertex : graph.vertices) {
    fmt::format_to(std::back_inserter(text), "{} {}", kVertexTag, vertex.id);
    append_pose(text, vertex.world_from_vertex);
    text.push_back('\n');
  }
  for (const std::int64_t id : graph.fixed) fmt::format_to(std::back_inserter(text), "{} {}\n", kFixTag, id);
  for (const PoseGraph::Edge& edge : graph.edges) append_edge(text, edge);
  return fmt::to_string(text);
}

}  // namespace cairn
