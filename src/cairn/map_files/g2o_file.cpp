// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/g2o_file.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <unordered_set>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/geometry/decompositions.h"
#include "cairn/geometry/unit_rotation.h"

namespace cairn {
namespace {

constexpr std::string_view kVertexTag = "VERTEX_SE3:QUAT";
constexpr std::string_view kEdgeTag = "EDGE_SE3:QUAT";
constexpr std::string_view kPlanarVertexTag = "VERTEX_SE2";
constexpr std::string_view kPlanarEdgeTag = "EDGE_SE2";
constexpr std::string_view kFixTag = "FIX";
constexpr std::string_view kMend = "Correct or delete the line.";

/// Holds what was read so far, and the lines that can be checked only when all vertices are known.
struct Reading {
  PoseGraph graph;
  const TextLine* first = nullptr;  ///< the line that says whether the graph is planar
  std::unordered_set<std::int64_t> ids;
  std::vector<const TextLine*> edge_lines;
  std::vector<const TextLine*> fix_lines;            ///< one for each entry of graph.fixed
  std::map<std::string_view, int> passed_over;       ///< number of lines of each other tag
  std::unordered_set<std::int64_t> passed_over_ids;  ///< of vertices among them
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

Rigid3 parse_planar_pose(const TextFile& file, const TextLine& line, std::size_t first) {
  const double x = file.number(line, first, "x");
  const double y = file.number(line, first + 1, "y");
  const double angle = file.number(line, first + 2, "theta");
  return {Eigen::Quaterniond(std::cos(angle / 2), 0, 0, std::sin(angle / 2)), {x, y, 0}};
}

constexpr int kPlanarRows[] = {0, 1, 5};  ///< of x, y and theta in the information of a planar edge

Matrix6d parse_planar_information(const TextFile& file, const TextLine& line, std::size_t first) {
  Matrix6d information = Matrix6d::Zero();
  std::size_t field = first;
  for (int i = 0; i < 3; ++i) {
    for (int k = i; k < 3; ++k, ++field) {
      const double value = file.number(line, field, fmt::format("i{}{}", i + 1, k + 1));
      const int row = kPlanarRows[i], column = kPlanarRows[k];
      information(row, column) = information(column, row) = value;
    }
  }
  check_information(file, line, information);
  return information;
}

void set_planar(const TextFile& file, const TextLine& line, bool planar, Reading& reading) {
  if (reading.first == nullptr) {
    reading.first = &line;
    reading.graph.planar = planar;
  }
  if (reading.graph.planar == planar) return;
  file.fail(line,
            fmt::format("a graph in {} throughout, as line {} begins it", planar ? "3D" : "2D",
                        reading.first->number),
            fmt::format("'{}'", line.fields[0]), "Give each graph its own file.");
}

void read_vertex(const TextFile& file, const TextLine& line, Reading& reading) {
  const bool planar = line.fields[0] == kPlanarVertexTag;
  set_planar(file, line, planar, reading);
  planar ? expect_fields(file, line, 4, "id x y theta")
         : expect_fields(file, line, 8, "id x y z qx qy qz qw");
  const std::int64_t id = parse_id(file, line, 1);
  if (!reading.ids.insert(id).second) {
    file.fail(line, "each vertex once", fmt::format("vertex {} a second time", id), std::string(kMend));
  }
  reading.graph.vertices.push_back(
      {id, planar ? parse_planar_pose(file, line, 2) : parse_pose(file, line, 2)});
}

void read_edge(const TextFile& file, const TextLine& line, Reading& reading) {
  const bool planar = line.fields[0] == kPlanarEdgeTag;
  set_planar(file, line, planar, reading);
  planar ? expect_fields(file, line, 11, "a b x y theta and 6 of the information's upper triangle")
         : expect_fields(file, line, 30, "a b x y z qx qy qz qw and 21 of the information's upper triangle");
  PoseGraph::Edge edge;
  edge.a = parse_id(file, line, 1);
  edge.b = parse_id(file, line, 2);
  if (edge.a == edge.b) {
    file.fail(line, "an edge between two vertices", fmt::format("one from {} to itself", edge.a),
              std::string(kMend));
  }
  edge.a_from_b = planar ? parse_planar_pose(file, line, 3) : parse_pose(file, line, 3);
  edge.information = planar ? parse_planar_information(file, line, 6) : parse_information(file, line, 10);
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

/// Passes over a line that no edge uses. Edges of other kinds would change the result.
void pass_over(const TextFile& file, const TextLine& line, Reading& reading) {
  const std::string_view tag = line.fields[0];
  const bool is_toro = tag == "VERTEX2" || tag == "EDGE2" || tag == "VERTEX3" || tag == "EDGE3";
  if (is_toro || tag.starts_with("EDGE")) {
    file.fail(line, fmt::format("{} or {}", kEdgeTag, kPlanarEdgeTag), fmt::format("'{}'", tag),
              is_toro ? "This is TORO's format; convert the graph to g2o's."
                      : "Only poses and the motions between them are optimised. Delete all other edges to do "
                        "without what they measure.");
  }
  ++reading.passed_over[tag];
  std::int64_t id = 0;
  if (tag.starts_with("VERTEX") && line.fields.size() > 1 && parse_integer(line.fields[1], id))
    reading.passed_over_ids.insert(id);
}

void read_line(const TextFile& file, const TextLine& line, Reading& reading) {
  const std::string_view tag = line.fields[0];
  if (tag == kVertexTag || tag == kPlanarVertexTag) return read_vertex(file, line, reading);
  if (tag == kEdgeTag || tag == kPlanarEdgeTag) return read_edge(file, line, reading);
  if (tag == kFixTag) return read_fix(file, line, reading);
  pass_over(file, line, reading);
}

/// Leaves out what is said of vertices that were passed over.
void drop_fixes_passed_over(Reading& reading) {
  std::vector<std::int64_t> fixed;
  std::vector<const TextLine*> lines;
  for (std::size_t i = 0; i < reading.fix_lines.size(); ++i) {
    const std::int64_t id = reading.graph.fixed[i];
    if (!reading.ids.contains(id) && reading.passed_over_ids.contains(id)) continue;
    fixed.push_back(id);
    lines.push_back(reading.fix_lines[i]);
  }
  reading.graph.fixed = std::move(fixed);
  reading.fix_lines = std::move(lines);
}

std::string describe_passed_over(const TextFile& file, const Reading& reading) {
  int lines = 0;
  std::string tags;
  for (const auto& [tag, count] : reading.passed_over) {
    lines += count;
    tags += fmt::format("{}{} ({})", tags.empty() ? "" : ", ", tag, count);
  }
  return fmt::format("{}: {} line{} that no edge between poses uses passed over, and not written: {}.",
                     file.path().string(), lines, lines == 1 ? "" : "s", tags);
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

void append_planar_pose(fmt::memory_buffer& text, const Rigid3& pose) {
  const double sign = pose.rotation.w() < 0 ? -1 : 1;
  const double angle = 2 * std::atan2(sign * pose.rotation.z(), sign * pose.rotation.w());
  fmt::format_to(std::back_inserter(text), " {} {} {}", pose.translation.x(), pose.translation.y(), angle);
}

void append_edge(fmt::memory_buffer& text, const PoseGraph::Edge& edge, bool planar) {
  constexpr int kAllRows[] = {0, 1, 2, 3, 4, 5};
  const std::span<const int> rows = planar ? std::span<const int>(kPlanarRows) : kAllRows;
  fmt::format_to(std::back_inserter(text), "{} {} {}", planar ? kPlanarEdgeTag : kEdgeTag, edge.a, edge.b);
  planar ? append_planar_pose(text, edge.a_from_b) : append_pose(text, edge.a_from_b);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = i; k < rows.size(); ++k) {
      fmt::format_to(std::back_inserter(text), " {}", edge.information(rows[i], rows[k]));
    }
  }
  text.push_back('\n');
}

}  // namespace

PoseGraph read_g2o(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  const TextFile file(path);
  Reading reading;
  for (const TextLine& line : file.lines()) read_line(file, line, reading);
  if (reading.graph.vertices.empty()) {
    throw InputError({path.string(), 0, fmt::format("vertices ({} or {})", kVertexTag, kPlanarVertexTag),
                      "none", "Check that this is the right file."});
  }
  drop_fixes_passed_over(reading);
  check_references(file, reading);
  if (warnings != nullptr && !reading.passed_over.empty())
    warnings->push_back(describe_passed_over(file, reading));
  return std::move(reading.graph);
}

std::string format_g2o(const PoseGraph& graph) {
  fmt::memory_buffer text;
  for (const PoseGraph::Vertex& vertex : graph.vertices) {
    fmt::format_to(std::back_inserter(text), "{} {}", graph.planar ? kPlanarVertexTag : kVertexTag,
                   vertex.id);
    graph.planar ? append_planar_pose(text, vertex.world_from_vertex)
                 : append_pose(text, vertex.world_from_vertex);
    text.push_back('\n');
  }
  for (const std::int64_t id : graph.fixed) fmt::format_to(std::back_inserter(text), "{} {}\n", kFixTag, id);
  for (const PoseGraph::Edge& edge : graph.edges) append_edge(text, edge, graph.planar);
  return fmt::to_string(text);
}

}  // namespace cairn
