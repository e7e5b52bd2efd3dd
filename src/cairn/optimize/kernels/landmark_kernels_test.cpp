// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/kernels/landmark_kernels.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cairn/core/random.h"
#include "cairn/simd/available.h"

namespace cairn {
namespace {

constexpr int kBlocks = 3, kSlots = kBlocks * kObservationLanes;

/// Observations of points around (0, 0, 10) from around the origin, all with errors of a few pixels.
std::vector<ObservationBlock> random_blocks(std::uint64_t seed) {
  Random random(seed);
  std::vector<ObservationBlock> blocks(kBlocks);
  for (ObservationBlock& block : blocks) {
    for (int lane = 0; lane < kObservationLanes; ++lane) {
      for (int i = 0; i < 3; ++i) {
        block.u[i][lane] = (i == 0 ? 700 : 0) + 20 * random.normal();
        block.v[i][lane] = (i == 1 ? 700 : 0) + 20 * random.normal();
        block.axis[i][lane] = (i == 2 ? 1 : 0) + 0.02 * random.normal();
        block.centre[i][lane] = random.normal();
      }
      block.disparity_scale[lane] = 350;
      block.disparity[lane] = random.uniform(0, 60);
    }
  }
  return blocks;
}

struct Result {
  LandmarkSums sums{};
  std::array<double, kSlots> pixel_errors{}, errors{};
};

Result run(LandmarkExpansion* expansion, const std::vector<ObservationBlock>& blocks,
           const Eigen::Vector3d& point) {
  Result result;
  expansion(blocks.data(), static_cast<int>(blocks.size()), point.data(), &result.sums,
            result.pixel_errors.data(), result.errors.data());
  return result;
}

bool same_bits(const double* a, const double* b, std::size_t count) {
  return std::equal(a, a + count, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

bool same_bits(const Result& a, const Result& b) {
  constexpr std::size_t kSums = sizeof(LandmarkSums) / sizeof(double);
  return same_bits(reinterpret_cast<const double*>(&a.sums), reinterpret_cast<const double*>(&b.sums),
                   kSums) &&
         same_bits(a.pixel_errors.data(), b.pixel_errors.data(), a.pixel_errors.size()) &&
         same_bits(a.errors.data(), b.errors.data(), a.errors.size());
}

/// (u, v, d) errors of one observation at a point, as ObservationBlock has them; linear: times depth over
/// `depth`.
Eigen::Vector3d errors_of(const ObservationBlock& block, int lane, const Eigen::Vector3d& point) {
  const auto column = [&](const double(&rows)[3][kObservationLanes]) {
    return Eigen::Vector3d(rows[0][lane], rows[1][lane], rows[2][lane]);
  };
  const Eigen::Vector3d q = point - column(block.centre);
  const double depth = column(block.axis).dot(q);
  return {column(block.u).dot(q) / depth, column(block.v).dot(q) / depth,
          block.disparity_scale[lane] / depth - block.disparity[lane]};
}

double depth_of(const ObservationBlock& block, int lane, const Eigen::Vector3d& point) {
  double depth = 0;
  for (int i = 0; i < 3; ++i) depth += block.axis[i][lane] * (point[i] - block.centre[i][lane]);
  return depth;
}

/// By differences; those of the linear equations where `linear`.
Eigen::Matrix3d derivative(const ObservationBlock& block, int lane, const Eigen::Vector3d& point,
                           bool linear) {
  constexpr double kStep = 1e-4;
  const auto value = [&](const Eigen::Vector3d& at) -> Eigen::Vector3d {
    const double scale = linear ? depth_of(block, lane, at) / depth_of(block, lane, point) : 1.0;
    return scale * errors_of(block, lane, at);
  };
  Eigen::Matrix3d jacobian;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
    jacobian.col(i) = (value(point + step) - value(point - step)) / (2 * kStep);
  }
  return jacobian;
}

class LandmarkKernelsTest : public testing::TestWithParam<InstructionSet> {
 protected:
  const LandmarkKernels& kernels_ = landmark_kernels(GetParam());
  const LandmarkKernels& plain_ = landmark_kernels(InstructionSet::plain);

  /// Against sums of plain matrices with derivatives by differences.
  void expect_sums(LandmarkExpansion* expansion, bool linear) {
    const std::vector<ObservationBlock> blocks = random_blocks(5);
    const Eigen::Vector3d point(0.3, -0.2, 9);
    const Result result = run(expansion, blocks, point);
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    double sum = 0;
    for (int slot = 0; slot < kSlots; ++slot) {
      const ObservationBlock& block = blocks[static_cast<std::size_t>(slot / kObservationLanes)];
      const int lane = slot % kObservationLanes;
      const Eigen::Vector3d error = errors_of(block, lane, point);
      const Eigen::Matrix3d jacobian = derivative(block, lane, point, linear);
      hessian += jacobian.transpose() * jacobian;
      gradient += jacobian.transpose() * error;
      sum += error.squaredNorm();
      const auto index = static_cast<std::size_t>(slot);
      EXPECT_NEAR(result.errors[index], error.squaredNorm(), 1e-9 * error.squaredNorm());
      EXPECT_NEAR(result.pixel_errors[index], error.head<2>().squaredNorm(), 1e-9 * error.squaredNorm());
    }
    const double* h = result.sums.information;
    const Eigen::Matrix3d found{{h[0], h[1], h[2]}, {h[1], h[3], h[4]}, {h[2], h[4], h[5]}};
    EXPECT_LT((found - hessian).norm(), 1e-6 * hessian.norm());
    EXPECT_LT((Eigen::Map<const Eigen::Vector3d>(result.sums.gradient) - gradient).norm(),
              1e-6 * gradient.norm());
    EXPECT_NEAR(result.sums.squared_error, sum, 1e-9 * sum);
  }
};

TEST_P(LandmarkKernelsTest, SameBitsAsPlain) {
  Random random(1);
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::vector<ObservationBlock> blocks = random_blocks(seed);
    blocks.resize(1 + seed % kBlocks);
    const Eigen::Vector3d point(random.normal(), random.normal(), 9 + random.normal());
    ASSERT_TRUE(same_bits(run(kernels_.expand, blocks, point), run(plain_.expand, blocks, point)));
    ASSERT_TRUE(same_bits(run(kernels_.linearise, blocks, point), run(plain_.linearise, blocks, point)));
  }
}

TEST_P(LandmarkKernelsTest, ExpansionIsThatOfTheErrors) {
  expect_sums(kernels_.expand, false);
}

TEST_P(LandmarkKernelsTest, LinearEquationsAreThoseOfTheErrorsTimesDepth) {
  expect_sums(kernels_.linearise, true);
}

TEST_P(LandmarkKernelsTest, BehindACameraTheErrorIsInfinite) {
  std::vector<ObservationBlock> blocks = random_blocks(2);
  blocks[1].centre[2][3] = 20;
  const Result result = run(kernels_.expand, blocks, {0, 0, 10});
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    EXPECT_EQ(std::isinf(result.errors[slot]), slot == 11) << slot;
    EXPECT_EQ(std::isinf(result.pixel_errors[slot]), slot == 11) << slot;
  }
  EXPECT_TRUE(std::isinf(result.sums.squared_error));
}

INSTANTIATE_TEST_SUITE_P(Sets, LandmarkKernelsTest, testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return "set" + std::to_string(static_cast<int>(set.param)); });

}  // namespace
}  // namespace cairn
