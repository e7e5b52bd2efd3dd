// SPDX-License-Identifier: Apache-2.0
#include "cairn/evaluate/evaluation.h"

#include <cmath>
#include <memory>

#include "localization.h"

namespace cairn::bench {
namespace {

/// A drive around a block, ten poses a second.
Trajectory drive(int count, double off) {
  Trajectory trajectory;
  for (int i = 0; i < count; ++i) {
    const double at = 0.005 * i;
    const Eigen::Vector3d place(200 * std::cos(at) + off * std::sin(7.0 * i), 150 * std::sin(at),
                                off * std::cos(3.0 * i));
    trajectory.push_back({i * std::int64_t{100'000'000}, WorldFromCamera({rotation_exp({0, 0, at}), place})});
  }
  return trajectory;
}

}  // namespace

void add_evaluation(Comparisons& comparisons) {
  constexpr int kPoses = 20'000;
  constexpr double kAtMostMs = 100;
  const auto truth = std::make_shared<const Trajectory>(drive(kPoses, 0));
  const auto estimate = std::make_shared<const Trajectory>(drive(kPoses, 0.05));
  comparisons.timed.push_back({"a trajectory of 20,000 poses evaluated",
                               1,
                               [=] { (void)evaluate_trajectory(*estimate, *truth); },
                               {},
                               {},
                               kAtMostMs});
}

}  // namespace cairn::bench
