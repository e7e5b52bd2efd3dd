// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/g2o_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

PoseGraph read_text(const std::string& text) {
  const testkit::TemporaryFolder folder;
  return read_g2o(folder.write("graph.g2o", text));
}

std::string message_for(const std::string& text) {
  try {
    (void)read_text(text);
  } catch (const InputError& error) {
    const std::string& path = error.details().file;
    std::string message = error.what();
    return message.replace(message.find(path), path.size(), "FILE");
  }
  return "no error";
}

const std::string kIdentity = " 0 0 0 0 0 0 1";
const std::string kInformation = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4";
const std::string kTwo =
    "VERTEX_SE3:QUAT 0" + kIdentity + "\nVERTEX_SE3:QUAT 7 1 2 3 0 0 0.6 0.8\n";  // lines 1 and 2
const std::string kEdge = "EDGE_SE3:QUAT 0 7 1 2 3 0 0 0.6 0.8";

TEST(G2oFile, ReadsVerticesEdgesAndFixes) {
  const PoseGraph graph =
      read_text("# a comment\n" + kEdge +
                " 1 2 3 4 5 6 27 8 9 10 11 82 13 14 15 196 17 18 219 20 221\nFIX 7 0\n" + kTwo);
  ASSERT_EQ(graph.vertices.size(), 2U);
  EXPECT_EQ(graph.vertices[1].id, 7);
  EXPECT_EQ(graph.vertices[1].world_from_vertex.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_DOUBLE_EQ(graph.vertices[1].world_from_vertex.rotation.z(), 0.6);
  EXPECT_DOUBLE_EQ(graph.vertices[1].world_from_vertex.rotation.w(), 0.8);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].a, 0);
  EXPECT_EQ(graph.edges[0].b, 7);
  EXPECT_FALSE(graph.edges[0].robust);
  EXPECT_EQ(graph.edges[0].information(0, 5), 6);
  EXPECT_EQ(graph.edges[0].information(5, 0), 6);
  EXPECT_EQ(graph.edges[0].information(1, 1), 27);
  EXPECT_EQ(graph.edges[0].information(4, 5), 20);
  EXPECT_EQ(graph.fixed, (std::vector<std::int64_t>{7, 0}));
}

TEST(G2oFile, WritesWhatItReads) {
  Random random(20250101);
  PoseGraph graph;
  for (const std::int64_t id : std::initializer_list<std::int64_t>{5, 0, 4'000'000'000'000}) {
    const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
    graph.vertices.push_back({id, {rotation_exp(turn), 1e6 * turn.cwiseInverse()}});
  }
  PoseGraph::Edge edge{5, 0, graph.vertices[1].world_from_vertex, information_from_std(0.1, 0.03), false};
  edge.information(0, 4) = edge.information(4, 0) = 1.0 / 3.0;
  graph.edges.push_back(edge);
  graph.fixed = {0};

  const std::string text = format_g2o(graph);
  const PoseGraph back = read_text(text);
  EXPECT_EQ(format_g2o(back), text);
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    EXPECT_EQ(back.vertices[i].id, graph.vertices[i].id);
    EXPECT_EQ(back.vertices[i].world_from_vertex.rotation.coeffs(),
              graph.vertices[i].world_from_vertex.rotation.coeffs());
    EXPECT_EQ(back.vertices[i].world_from_vertex.translation,
              graph.vertices[i].world_from_vertex.translation);
  }
  EXPECT_EQ(back.edges[0].information, edge.information);
  EXPECT_EQ(back.fixed, graph.fixed);
}

TEST(G2oFile, WritesTidyLines) {
  PoseGraph graph;
  graph.vertices = {{0, {}}, {1, {Eigen::Quaterniond(0.8, 0, 0, 0.6), {0.5, -2, 1e-7}}}};
  graph.edges = {{0, 1, graph.vertices[1].world_from_vertex, Matrix6d::Identity(), true}};
  graph.fixed = {0};
  EXPECT_EQ(format_g2o(graph),
            "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
            "VERTEX_SE3:QUAT 1 0.5 -2 1e-07 0 0 0.6 0.8\n"
            "FIX 0\n"
            "EDGE_SE3:QUAT 0 1 0.5 -2 1e-07 0 0 0.6 0.8 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
}

TEST(G2oFile, ReadsAndWritesPlanarGraphs) {
  const std::string text =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.5 -2 3.25\nFIX 1\nEDGE_SE2 0 1 1 2 -0.5 1 2 3 8 5 14\n";
  const PoseGraph graph = read_text(text);
  EXPECT_TRUE(graph.planar);
  EXPECT_EQ(graph.vertices[1].world_from_vertex.translation, Eigen::Vector3d(1.5, -2, 0));
  EXPECT_DOUBLE_EQ(rotation_log(graph.edges[0].a_from_b.rotation).z(), -0.5);
  Matrix6d information = Matrix6d::Zero();
  information(0, 0) = 1, information(0, 1) = 2, information(0, 5) = 3;
  information(1, 0) = 2, information(1, 1) = 8, information(1, 5) = 5;
  information(5, 0) = 3, information(5, 1) = 5, information(5, 5) = 14;
  EXPECT_EQ(graph.edges[0].information, information);
  const PoseGraph back = read_text(format_g2o(graph));
  EXPECT_TRUE(back.planar);
  EXPECT_EQ(back.edges[0].information, information);
  EXPECT_EQ(back.fixed, graph.fixed);
  EXPECT_LT(rotation_angle(back.vertices[1].world_from_vertex.rotation.conjugate() *
                           graph.vertices[1].world_from_vertex.rotation),
            1e-15);
}

TEST(G2oFile, PassesOverWhatNoEdgeUsesAndCountsIt) {
  const testkit::TemporaryFolder folder;
  const auto path = folder.write("graph.g2o", "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 9 0 0 0\n" +
                                                  kTwo + "FIX 9 0\nPARAMS_SE3OFFSET 1 0 0 0 0 0 0 1\n" +
                                                  kEdge + kInformation + "\n");
  std::vector<std::string> warnings;
  const PoseGraph graph = read_g2o(path, &warnings);
  EXPECT_EQ(graph.vertices.size(), 2U);
  EXPECT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.fixed, (std::vector<std::int64_t>{0}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0], path.string() +
                             ": 3 lines that no edge between poses uses passed over, and not written: "
                             "PARAMS_SE3OFFSET (2), VERTEX_TRACKXYZ (1).");
}

TEST(G2oFile, AcceptsSemiDefiniteInformation) {
  const PoseGraph graph = read_text(kTwo + kEdge + " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n");
  EXPECT_EQ(graph.edges[0].information(5, 5), 0);
}

TEST(G2oFile, NamesWhatIsWrong) {
  const std::string mend = "\n  Correct or delete the line.";
  const std::string edges = "expected EDGE_SE3:QUAT or EDGE_SE2, found ";
  const struct {
    std::string text, message;
  } cases[] = {
      {"",
       "FILE: expected vertices (VERTEX_SE3:QUAT or VERTEX_SE2), found none.\n  Check that this is the right "
       "file."},
      {"VERTEX_SE3:QUAT 0 0 0 0 0 0 1\n",
       "FILE:1: expected 8 values after VERTEX_SE3:QUAT (id x y z qx qy qz qw), found 7." + mend},
      {kTwo + "VERTEX_SE3:QUAT 7" + kIdentity,
       "FILE:3: expected each vertex once, found vertex 7 a second time." + mend},
      {"VERTEX_SE3:QUAT -1" + kIdentity, "FILE:1: expected a vertex id from 0 up, found -1." + mend},
      {"VERTEX_SE3:QUAT 1.5" + kIdentity,
       "FILE:1: expected a whole number for the vertex id, found '1.5'." + mend},
      {"VERTEX_SE3:QUAT 0 0 nan 0 0 0 0 1", "FILE:1: expected a number for y, found 'nan'." + mend},
      {"VERTEX_SE3:QUAT 0 0 1e999 0 0 0 0 1", "FILE:1: expected a number for y, found '1e999'." + mend},
      {"VERTEX_SE3:QUAT 0 0 0 0 0 0 x 1", "FILE:1: expected a number for qz, found 'x'." + mend},
      {"VERTEX_SE3:QUAT 0 1 2 3 0 0 0 0",
       "FILE:1: expected a quaternion of length 1, found one of length 0.\n"
       "  Check the order of the columns: x y z qx qy qz qw."},
      {kTwo + "\n" + kEdge + " 1 0 0\n",
       "FILE:4: expected 30 values after EDGE_SE3:QUAT (a b x y z qx qy qz qw and 21 of the information's "
       "upper triangle), found 12." +
           mend},
      {kTwo + "EDGE_SE3:QUAT 0 3" + kIdentity + kInformation,
       "FILE:3: expected ids of vertices of this file, found 3, which is none." + mend},
      {kTwo + "EDGE_SE3:QUAT 7 7" + kIdentity + kInformation,
       "FILE:3: expected an edge between two vertices, found one from 7 to itself." + mend},
      {kTwo + kEdge + " 1 0 0 0 0 0 1 0 0 0 0 -1 0 0 0 4 0 0 4 0 4",
       "FILE:3: expected a positive semi-definite information matrix, found one with the eigenvalue -1.\n"
       "  Information is the inverse of a covariance, upper triangle row by row: i11 i12 .. i16 i22 .. i66."},
      {kTwo + kEdge + " 1 2 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4",
       "FILE:3: expected a positive semi-definite information matrix, found one with the eigenvalue -1.\n"
       "  Information is the inverse of a covariance, upper triangle row by row: i11 i12 .. i16 i22 .. i66."},
      {kTwo + kEdge + " 1 inf 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4",
       "FILE:3: expected a number for i12, found 'inf'." + mend},
      {kTwo + "FIX 3", "FILE:3: expected ids of vertices of this file, found 3, which is none." + mend},
      {kTwo + "FIX", "FILE:3: expected ids after FIX, found none." + mend},
      {kTwo + "VERTEX_SE2 8 0 0 0\n",
       "FILE:3: expected a graph in 3D throughout, as line 1 begins it, found 'VERTEX_SE2'.\n"
       "  Give each graph its own file."},
      {"VERTEX_SE2 0 0 0\n", "FILE:1: expected 4 values after VERTEX_SE2 (id x y theta), found 3." + mend},
      {"EDGE_SE2 0 1 1 0 0 1 0 0 1 0\n",
       "FILE:1: expected 11 values after EDGE_SE2 (a b x y theta and 6 of the information's upper triangle), "
       "found 10." +
           mend},
      {"EDGE2 0 1 1 0 0 1 0 1 1 0 0\n",
       "FILE:1: " + edges + "'EDGE2'.\n  This is TORO's format; convert the graph to g2o's."},
      {kTwo + "EDGE_SE3_PRIOR 0 0 0 0 0\n", "FILE:3: " + edges +
                                                "'EDGE_SE3_PRIOR'.\n  Only poses and the motions between "
                                                "them are optimised. Delete all other edges "
                                                "to do without what they measure."},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(message_for(text), message);
}

}  // namespace
}  // namespace cairn
