// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/ransac.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/executor.h"

namespace cairn {
namespace {

/// Lines y = slope x + offset: the smallest problem that the engine takes.
struct LineProblem {
  struct Model {
    double slope = 0, offset = 0;
    bool operator==(const Model&) const = default;
  };
  static constexpr std::size_t kSampleSize = 2, kMaxModels = 1;
  static constexpr double kSigma = 0.01;

  std::vector<double> x, y;

  [[nodiscard]] std::size_t size() const { return x.size(); }
  std::size_t solve(const std::array<std::uint32_t, 2>& sample, std::array<Model, 1>& models) const {
    const double dx = x[sample[1]] - x[sample[0]];
    if (dx == 0) return 0;
    const double slope = (y[sample[1]] - y[sample[0]]) / dx;
    models[0] = {slope, y[sample[0]] - slope * x[sample[0]]};
    return 1;
  }
  [[nodiscard]] double squared_error(const Model& line, std::size_t i) const {
    const double error = (line.slope * x[i] + line.offset - y[i]) / kSigma;
    return error * error;
  }
  [[nodiscard]] static double limit(std::size_t /*i*/) { return 3.841; }
  bool refine(std::span<const std::int32_t> inliers, Model& line) const {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const std::int32_t index : inliers) {
      const auto i = static_cast<std::size_t>(index);
      n += 1, sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
    }
    const double determinant = n * sxx - sx * sx;
    if (!(determinant > 1e-9)) return false;
    line.slope = (n * sxy - sx * sy) / determinant;
    line.offset = (sy - line.slope * sx) / n;
    return true;
  }
  [[nodiscard]] static double chance() { return 2 * std::sqrt(3.841) * kSigma; }
};

LineProblem make_line(std::uint64_t seed, int count, int outliers) {
  Random random(seed);
  LineProblem problem;
  for (int i = 0; i < count; ++i) {
    problem.x.push_back(random.uniform());
    const double exact = 0.5 * problem.x.back() + 0.2 + LineProblem::kSigma * random.normal();
    problem.y.push_back(i < outliers ? random.uniform() : exact);
  }
  return problem;
}

TEST(Ransac, finds_the_model_and_its_inliers) {
  const LineProblem problem = make_line(1, 300, 200);
  const auto result = Ransac(problem, {}).run();
  ASSERT_TRUE(result.found());
  EXPECT_NEAR(result.model.slope, 0.5, 0.01);
  EXPECT_NEAR(result.model.offset, 0.2, 0.01);
  EXPECT_GT(result.inliers.size(), 90U);
  EXPECT_LT(result.inliers.size(), 120U);
  double cost = 0;
  for (std::size_t i = 0; i < 300; ++i) cost += std::min(3.841, problem.squared_error(result.model, i));
  EXPECT_NEAR(result.cost, cost, 1e-9);
}

/// Chum et al. 2003: with local optimisation about as many samples are needed as theory says.
TEST(Ransac, needs_no_more_samples_than_theory_says) {
  double iterations = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed)
    iterations += Ransac(make_line(seed, 300, 150), {}).run().iterations / 50.0;
  EXPECT_LT(iterations, 1.2 * samples_needed(150, 300, 2, {}));
}

TEST(Ransac, gives_the_same_bits_at_any_number_of_threads) {
  const auto solve = [](std::size_t item) {
    const LineProblem problem = make_line(item, 100, 50);
    const auto result = Ransac(problem, {.item = item}).run();
    return std::pair(result.model, result.inliers);
  };
  using Found = std::pair<LineProblem::Model, std::vector<std::int32_t>>;
  const auto one = Executor(1).map<Found>(50, solve);
  EXPECT_EQ(one, Executor(2).map<Found>(50, solve));
  EXPECT_EQ(one, Executor(3).map<Found>(50, solve));
}

/// Less than one in a hundred sets of unrelated data gives a model.
TEST(Ransac, does_not_believe_what_chance_explains) {
  int believed = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed)
    believed += Ransac(make_line(seed, 50, 50), {}).run().found() ? 1 : 0;
  EXPECT_LE(believed, 5);
}

TEST(Ransac, says_why_there_is_no_model) {
  LineProblem problem = make_line(1, 1, 0);
  EXPECT_EQ(Ransac(problem, {}).run().status, RansacStatus::too_few_data);
  problem.x.assign(20, 0.3);
  problem.y.assign(20, 0.3);
  EXPECT_EQ(Ransac(problem, {}).run().status, RansacStatus::degenerate);
  EXPECT_THROW(Ransac(problem, {.max_iterations = 0}), PreconditionError);
  EXPECT_THROW(Ransac(problem, {.confidence = 1.0}), PreconditionError);
}

TEST(Ransac, draws_different_indices) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const auto sample = draw_sample<5>(random, 6);
    EXPECT_EQ(std::set<std::uint32_t>(sample.begin(), sample.end()).size(), 5U);
    for (const std::uint32_t index : sample) EXPECT_LT(index, 6U);
  }
}

TEST(Ransac, counts_samples_and_false_alarms) {
  EXPECT_EQ(samples_needed(100, 100, 5, {}), 1);
  EXPECT_EQ(samples_needed(50, 100, 3, {.confidence = 0.99}), 35);  // log 0.01 / log(1 - 1/8) = 34.5
  EXPECT_EQ(samples_needed(1, 100, 5, {.max_iterations = 77}), 77);
  // 4 C(5, 4) C(4, 3) 0.01
  EXPECT_NEAR(log10_false_alarms(4, 5, 3, 4, 0.01), std::log10(4 * 5 * 4 * 0.01), 1e-12);
}

}  // namespace
}  // namespace cairn
