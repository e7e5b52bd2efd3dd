// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/random.h"

namespace cairn {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Vector3d random_vector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

Points random_points(Random& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(random_vector(random));
  return points;
}

Points mapped(const Similarity3& target_from_source, const Points& source) {
  Points target;
  for (const auto& point : source) target.push_back(target_from_source * point);
  return target;
}

TEST(Alignment, FindsTheSimilarityOfExactPoints) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Points source = random_points(random, 3 + trial % 5);
    const Similarity3 truth{0.1 + random.uniform(), rotation_exp(2 * random_vector(random)),
                            10 * random_vector(random)};
    const Alignment found = align_points(source, mapped(truth, source), true);
    ASSERT_EQ(found.status, AlignmentStatus::ok);
    EXPECT_NEAR(found.target_from_source.scale, truth.scale, 1e-12);
    EXPECT_LT(rotation_angle(found.target_from_source.rotation.conjugate() * truth.rotation), 1e-7);
    EXPECT_LT((found.target_from_source.translation - truth.translation).norm(), 1e-11);
    EXPECT_LT(found.rmse, 1e-11);
  }
}

TEST(Alignment, KeepsTheScaleUnlessAsked) {
  Random random(2);
  const Points source = random_points(random, 10);
  const Similarity3 truth{2.0, rotation_exp({0.1, 0.2, 0.3}), {1, 2, 3}};
  const Alignment found = align_points(source, mapped(truth, source), false);
  EXPECT_EQ(found.target_from_source.scale, 1.0);
  EXPECT_LT(rotation_angle(found.target_from_source.rotation.conjugate() * truth.rotation), 1e-7);
  EXPECT_GT(found.rmse, 0.5);
}

/// The example of Umeyama 1991, section IV, put into the plane z = 0: there the best orthogonal matrix is a
/// reflection, which must not be returned. Its result in the plane is R = [[0.832, 0.555], [-0.555, 0.832]],
/// c = 0.721, t = (-0.800, 0.400); in space the same points can be turned over about an axis in the plane,
/// which fits them exactly.
TEST(Alignment, TurnsOverWhatOnlyAReflectionFitsInThePlane) {
  const Points source{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const Points target{{0, 0, 0}, {-1, 0, 0}, {0, 2, 0}};
  const Alignment found = align_points(source, target, true);
  ASSERT_EQ(found.status, AlignmentStatus::ok);
  EXPECT_NEAR(found.rmse, 0, 1e-12);
  EXPECT_NEAR(found.target_from_source.rotation.toRotationMatrix().determinant(), 1, 1e-12);
}

TEST(Alignment, NeverReturnsAReflection) {
  const Points source{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const Points target{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 0}};
  const Alignment found = align_points(source, target, false);
  ASSERT_EQ(found.status, AlignmentStatus::ok);
  EXPECT_NEAR(found.target_from_source.rotation.toRotationMatrix().determinant(), 1, 1e-12);
  EXPECT_GT(found.rmse, 0.1);
}

TEST(Alignment, IsAMinimum) {
  Random random(3);
  const Points source = random_points(random, 20);
  Points target = mapped({1.5, rotation_exp({1, 0, 0}), {0, 0, 1}}, source);
  for (auto& point : target) point += 0.1 * random_vector(random);
  const Alignment best = align_points(source, target, true);
  const auto cost = [&](const Similarity3& moved) {
    double sum = 0;
    for (std::size_t i = 0; i < source.size(); ++i) sum += (target[i] - moved * source[i]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(source.size()));
  };
  for (int trial = 0; trial < 100; ++trial) {
    Similarity3 moved = best.target_from_source;
    moved.scale += 1e-3 * random.normal();
    moved.rotation = rotation_exp(1e-3 * random_vector(random)) * moved.rotation;
    moved.translation += 1e-3 * random_vector(random);
    EXPECT_LT(best.rmse, cost(moved));
  }
}

TEST(Alignment, SaysWhyThereIsNone) {
  const Points line{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}};
  const Points place(4, Eigen::Vector3d(1e6, 2, 3));
  const Points plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const auto status = [](const Points& source, const Points& target) {
    return align_points(source, target, true).status;
  };
  EXPECT_EQ(status({}, {}), AlignmentStatus::too_few_points);
  EXPECT_EQ(status({line[0], line[1]}, {line[0], line[1]}), AlignmentStatus::too_few_points);
  EXPECT_EQ(status(line, plane), AlignmentStatus::one_line);
  EXPECT_EQ(status(plane, line), AlignmentStatus::one_line);
  EXPECT_EQ(status(place, plane), AlignmentStatus::one_place);
  EXPECT_EQ(status(plane, place), AlignmentStatus::one_place);
  EXPECT_EQ(status(plane, plane), AlignmentStatus::ok);
  EXPECT_THROW((void)status(plane, {}), PreconditionError);
}

TEST(Alignment, HasNoAnswerWhereSeveralRotationsFitAMirrorImage) {
  const Points axes{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  Points mirrored = axes;
  for (auto& point : mirrored) point.z() = -point.z();
  EXPECT_EQ(align_points(axes, mirrored, true).status, AlignmentStatus::mirrored);
  for (auto& point : mirrored)
    point.x() *= 2;  // now one rotation, which keeps x, fits better than all others
  mirrored[2] *= 1.5;
  mirrored[3] *= 1.5;
  EXPECT_EQ(align_points(axes, mirrored, true).status, AlignmentStatus::ok);
}

TEST(Alignment, RefusesCoordinatesThatAreNoNumbers) {
  const Points good{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const double bad : {std::nan(""), HUGE_VAL, -1e200}) {
    Points points = good;
    points[1].y() = bad;
    EXPECT_THROW((void)align_points(points, good, false), PreconditionError);
    EXPECT_THROW((void)align_points(good, points, false), PreconditionError);
  }
}

TEST(Alignment, SaysHowFarTheTurnAboutTheMainLineIsKnown) {
  Random random(4);
  Points source, noisy;
  for (int i = 0; i < 200; ++i) {
    source.emplace_back(0.1 * i, 1e-2 * random.normal(), 1e-2 * random.normal());
    noisy.emplace_back(0.1 * i, 1e-2 * random.normal(), 1e-2 * random.normal());
  }
  const Similarity3 truth{1.5, rotation_exp({0.4, -0.2, 0.7}), {1, 2, 3}};
  EXPECT_LT(align_points(source, mapped(truth, source), true).turn_uncertainty, 1e-6);
  EXPECT_GT(align_points(source, mapped(truth, noisy), true).turn_uncertainty, 0.5);
}

TEST(Alignment, MeasuresDistances) {
  const Points source{{0, 0, 0}, {1, 0, 0}}, target{{3, 4, 0}, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(rms_distance({}, source, target), std::sqrt(12.5));
  EXPECT_EQ(rms_distance({}, {}, {}), 0);
  EXPECT_THROW((void)rms_distance({}, source, {}), PreconditionError);
}

TEST(Alignment, MapsPoses) {
  const Similarity3 map{2.0, rotation_exp({0, 0, 1}), {1, 2, 3}};
  const Rigid3 camera{rotation_exp({0.5, 0, 0}), {4, 5, 6}};
  const Rigid3 mapped_camera = map * camera;
  EXPECT_EQ(mapped_camera.translation, map * Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(rotation_angle(mapped_camera.rotation.conjugate() * map.rotation * camera.rotation), 0, 1e-12);
}

}  // namespace
}  // namespace cairn
