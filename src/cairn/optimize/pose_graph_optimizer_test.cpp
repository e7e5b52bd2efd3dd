// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/pose_graph_optimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"
#include "cairn/map_files/g2o_file.h"
#include "cairn/optimize/pose_graph_residual.h"

namespace cairn {
namespace {

constexpr double kNoiseM = 0.02, kNoiseRad = 0.01;

struct Scene {
  PoseGraph graph;
  std::vector<Rigid3> truth;
};

Rigid3 noise(Random& random) {
  const auto vector = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  const Eigen::Vector3d turn = kNoiseRad * vector();
  return {rotation_exp(turn), kNoiseM * vector()};
}

void join(Scene& scene, std::size_t a, std::size_t b, const Rigid3& error, bool robust) {
  scene.graph.edges.push_back({scene.graph.vertices[a].id, scene.graph.vertices[b].id,
                               scene.truth[a].inverse() * scene.truth[b] * error,
                               information_from_std(kNoiseM, kNoiseRad), robust});
}

/// Two rounds of a circle, 50 poses each, with noisy odometry and noisy loops from the second round to the
/// first; the given poses are the odometry's. Ids are 100, 101, ..
Rigid3 on_a_helix(int i) {
  const double angle = 2 * std::numbers::pi * i / 50;
  return {rotation_exp({0, 0, angle}), {5 * std::cos(angle), 5 * std::sin(angle), 0.02 * i}};
}

Scene two_rounds(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  for (int i = 0; i < 100; ++i) {
    scene.truth.push_back(on_a_helix(i));
    scene.graph.vertices.push_back({100 + i, scene.truth.back()});
  }
  for (std::size_t i = 1; i < 100; ++i) {
    join(scene, i - 1, i, noise(random), false);
    scene.graph.vertices[i].world_from_vertex =
        scene.graph.vertices[i - 1].world_from_vertex * scene.graph.edges.back().a_from_b;
  }
  for (std::size_t i = 0; i < 50; i += 5) join(scene, i, i + 50, noise(random), true);
  return scene;
}

double largest_error_m(const Scene& scene) {
  double largest = 0;
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    const Eigen::Vector3d found = scene.graph.vertices[i].world_from_vertex.translation;
    largest = std::max(largest, (found - scene.truth[i].translation).norm());
  }
  return largest;
}

TEST(PoseGraphOptimizer, FitsTheMeasurementsAsTheirNoisePredicts) {
  Scene scene = two_rounds(1);
  const double error_before = largest_error_m(scene);
  const PoseGraphReport report = optimize_pose_graph(scene.graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_GT(report.iterations, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.held, (std::vector<std::int64_t>{100}));
  EXPECT_LT(largest_error_m(scene), 0.7 * error_before);
  // chi2 of 109 edges and 99 free poses: 60 degrees of freedom, standard deviation sqrt(120) = 11
  EXPECT_NEAR(report.chi2_after, 60, 4 * 11);
  EXPECT_DOUBLE_EQ(report.chi2_after, chi2(scene.graph));
}

TEST(PoseGraphOptimizer, ReachesOneMinimumFromBothStarts) {
  Scene given = two_rounds(2), chordal = two_rounds(2);
  for (auto& vertex : chordal.graph.vertices) vertex.world_from_vertex.rotation.setIdentity();
  PoseGraphOptions options;
  options.start = PoseGraphStart::given;
  const PoseGraphReport from_given = optimize_pose_graph(given.graph, options);
  options.start = PoseGraphStart::best;
  const PoseGraphReport from_best = optimize_pose_graph(chordal.graph, options);
  EXPECT_EQ(from_given.started_at, PoseGraphStart::given);
  EXPECT_EQ(from_best.started_at, PoseGraphStart::chordal);
  EXPECT_LT(from_best.chi2_start, 0.01 * from_best.chi2_before);
  EXPECT_NEAR(from_given.chi2_after, from_best.chi2_after, 1e-6);
}

TEST(PoseGraphOptimizer, StaysAtAPerfectGraph) {
  Scene scene = two_rounds(3);
  for (std::size_t i = 0; i < 100; ++i) scene.graph.vertices[i].world_from_vertex = scene.truth[i];
  const auto index = [](std::int64_t id) { return static_cast<std::size_t>(id - 100); };
  for (auto& edge : scene.graph.edges)
    edge.a_from_b = scene.truth[index(edge.a)].inverse() * scene.truth[index(edge.b)];
  const PoseGraphReport report = optimize_pose_graph(scene.graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_LT(report.chi2_after, 1e-18);
  EXPECT_LT(largest_error_m(scene), 1e-9);
}

TEST(PoseGraphOptimizer, RobustKernelsWithstandWrongLoops) {
  for (const RobustKernel kernel : {RobustKernel::cauchy, RobustKernel::geman_mcclure}) {
    Scene scene = two_rounds(4);
    join(scene, 10, 40, {rotation_exp({0, 0, 1}), {3, 0, 0}}, true);
    join(scene, 25, 90, {rotation_exp({0, 1, 0}), {0, 4, 0}}, true);
    Scene plain = scene;
    PoseGraphOptions options;
    options.kernel = kernel;
    EXPECT_TRUE(optimize_pose_graph(scene.graph, options).converged);
    EXPECT_TRUE(optimize_pose_graph(plain.graph).converged);
    EXPECT_LT(largest_error_m(scene), 0.5);
    EXPECT_GT(largest_error_m(plain), 1.0);
  }
}

TEST(PoseGraphOptimizer, KernelsLeaveOtherEdgesAlone) {
  Scene plain = two_rounds(5), robust = two_rounds(5);
  for (auto& edge : robust.graph.edges) edge.robust = false;
  PoseGraphOptions options;
  options.kernel = RobustKernel::huber;
  options.robust_scale = 0.01;
  (void)optimize_pose_graph(plain.graph);
  (void)optimize_pose_graph(robust.graph, options);
  EXPECT_EQ(format_g2o(plain.graph), format_g2o(robust.graph));
}

TEST(PoseGraphOptimizer, HoldsOneVertexOfEachPart) {
  Scene scene = two_rounds(6);
  const Rigid3 kept = scene.graph.vertices[60].world_from_vertex;
  std::erase_if(scene.graph.edges, [](const PoseGraph::Edge& e) { return (e.a < 160) != (e.b < 160); });
  scene.graph.vertices.push_back({7, {}});  // no edges at all
  const PoseGraphReport report = optimize_pose_graph(scene.graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_EQ(report.components, 3);
  EXPECT_EQ(report.held, (std::vector<std::int64_t>{100, 160, 7}));
  EXPECT_EQ(scene.graph.vertices[60].world_from_vertex.translation, kept.translation);
}

TEST(PoseGraphOptimizer, LeavesFixedVerticesAlone) {
  Scene scene = two_rounds(7);
  scene.graph.fixed = {130, 170};
  const Rigid3 kept = scene.graph.vertices[70].world_from_vertex;
  const Rigid3 first = scene.graph.vertices[0].world_from_vertex;
  EXPECT_TRUE(optimize_pose_graph(scene.graph).converged);
  EXPECT_EQ(scene.graph.vertices[70].world_from_vertex.rotation.coeffs(), kept.rotation.coeffs());
  EXPECT_NE(scene.graph.vertices[0].world_from_vertex.translation, first.translation);
}

TEST(PoseGraphOptimizer, TakesSemiDefiniteInformation) {
  Scene scene = two_rounds(8);
  for (auto& edge : scene.graph.edges) {
    if (edge.robust) edge.information.bottomRightCorner<3, 3>().setZero();
  }
  scene.graph.vertices.push_back({7, {Eigen::Quaterniond::Identity(), {1, 2, 3}}});
  scene.graph.edges.push_back({100, 7, {}, Matrix6d::Identity(), false});
  scene.graph.edges.back().information.bottomRightCorner<3, 3>().setZero();  // its rotation is free
  const PoseGraphReport report = optimize_pose_graph(scene.graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_LT(report.chi2_after, report.chi2_before);
}

TEST(PoseGraphOptimizer, WorksWithoutEdges) {
  PoseGraph graph;
  graph.vertices = {{0, {}}, {1, {}}};
  const PoseGraphReport report = optimize_pose_graph(graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_EQ(report.chi2_after, 0);
  EXPECT_EQ(report.components, 2);
}

TEST(PoseGraphOptimizer, GivesTheSameBitsEachTime) {
  Scene first = two_rounds(9), second = two_rounds(9);
  (void)optimize_pose_graph(first.graph);
  (void)optimize_pose_graph(second.graph);
  EXPECT_EQ(format_g2o(first.graph), format_g2o(second.graph));
}

class StopAtOnce : public Progress {
 public:
  [[nodiscard]] bool stop_requested() const override { return true; }
};

TEST(PoseGraphOptimizer, SaysThatItDidNotConverge) {
  Scene scene = two_rounds(10);
  PoseGraphOptions options;
  options.max_iterations = 1;
  const PoseGraphReport report = optimize_pose_graph(scene.graph, options);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 1);
  StopAtOnce progress;
  Scene stopped = two_rounds(10);
  EXPECT_FALSE(optimize_pose_graph(stopped.graph, {}, &progress).converged);
}

TEST(PoseGraphOptimizer, ChecksItsOptions) {
  PoseGraph graph;
  PoseGraphOptions options;
  options.robust_scale = 0;
  EXPECT_THROW((void)optimize_pose_graph(graph, options), PreconditionError);
  options = {};
  options.max_iterations = 0;
  EXPECT_THROW((void)optimize_pose_graph(graph, options), PreconditionError);
}

/// Holds x, y and the heading of each vertex of a planar graph.
using PlanarPoses = std::vector<Eigen::Vector3d>;

/// The cost of a planar graph, written down in 2D.
double planar_cost(const PoseGraph& graph, const PlanarPoses& poses) {
  double sum = 0;
  for (const PoseGraph::Edge& edge : graph.edges) {
    const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
    const double measured = rotation_log(edge.a_from_b.rotation).z();
    const Eigen::Vector2d moved = Eigen::Rotation2Dd(-poses[a].z()) * (poses[b] - poses[a]).head<2>() -
                                  edge.a_from_b.translation.head<2>();
    const Eigen::Vector2d shift = Eigen::Rotation2Dd(-measured) * moved;
    const double turn = std::remainder(poses[b].z() - poses[a].z() - measured, 2 * std::numbers::pi);
    Vector6d error = Vector6d::Zero();
    error << shift, 0, 0, 0, turn;
    sum += error.dot(edge.information * error);
  }
  return sum;
}

/// A square walked twice with errors of odometry of up to 0.2 rad, and a loop to the first round; correlated.
PoseGraph planar_square() {
  Random random(7);
  PoseGraph graph;
  graph.planar = true;
  const auto motion = [&](double x, double turn) {
    return Rigid3{rotation_exp({0, 0, turn + 0.1 * random.normal()}),
                  {x + 0.1 * random.normal(), 0.1 * random.normal(), 0}};
  };
  Matrix6d information = Matrix6d::Zero();
  information.diagonal() << 100, 80, 0, 0, 0, 90;
  information(0, 5) = information(5, 0) = 20;
  graph.vertices.push_back({0, {}});
  for (std::int64_t i = 1; i < 9; ++i) {
    graph.edges.push_back({i - 1, i, motion(2, std::numbers::pi / 2), information});
    graph.vertices.push_back({i, graph.vertices.back().world_from_vertex * graph.edges.back().a_from_b});
  }
  for (std::int64_t i = 4; i < 9; ++i) graph.edges.push_back({i - 4, i, motion(0, 0), information});
  return graph;
}

TEST(PoseGraphOptimizer, PlanarGraphsEndAtTheMinimumOfTheirCostInThePlane) {
  PoseGraph graph = planar_square();
  const PoseGraphReport report = optimize_pose_graph(graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_LT(report.chi2_after, 0.5 * report.chi2_before);
  PlanarPoses poses;
  for (const PoseGraph::Vertex& vertex : graph.vertices) {
    const Rigid3& pose = vertex.world_from_vertex;
    EXPECT_EQ(pose.translation.z(), 0);
    EXPECT_EQ(pose.rotation.x(), 0);
    EXPECT_EQ(pose.rotation.y(), 0);
    poses.emplace_back(pose.translation.x(), pose.translation.y(), rotation_log(pose.rotation).z());
  }
  EXPECT_NEAR(planar_cost(graph, poses), report.chi2_after, 1e-9 * report.chi2_after);
  constexpr double kStep = 1e-5;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      PlanarPoses ahead = poses, behind = poses;
      ahead[i][k] += kStep;
      behind[i][k] -= kStep;
      const double slope = (planar_cost(graph, ahead) - planar_cost(graph, behind)) / (2 * kStep);
      EXPECT_NEAR(slope, 0, 1e-3) << "vertex " << i << ", coordinate " << k;  // information is about 100
    }
  }
}

class PublicGraph : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(PublicGraph, EndsAtTheKnownMinimum) {
  const auto [name, known_chi2] = GetParam();
  const std::filesystem::path path = std::filesystem::path(CAIRN_DATA_DIR) / "graphs" / name;
  if (!std::filesystem::exists(path)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << path << " is missing";
    GTEST_SKIP() << "needs " << path;
  }
  PoseGraph graph = read_g2o(path);
  const PoseGraphReport report = optimize_pose_graph(graph);
  EXPECT_TRUE(report.converged) << report.termination;
  EXPECT_LE(report.chi2_after, known_chi2);
}

/// chi2 at the minimum that g2o finds, rounded up in the last digit.
INSTANTIATE_TEST_SUITE_P(Graphs, PublicGraph,
                         testing::Values(std::pair{"sphere2500.g2o", 727.16},
                                         std::pair{"parking-garage.g2o", 1.2388},
                                         std::pair{"sphere_slambook.g2o", 44360.7}));

}  // namespace
}  // namespace cairn
