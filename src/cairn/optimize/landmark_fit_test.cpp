// SPDX-License-Identifier: Apache-2.0
#include "cairn/optimize/landmark_fit.h"

#include <gtest/gtest.h>

#include "cairn/optimize/landmark_test_scene.h"

namespace cairn {
namespace {
TEST(LandmarkFit, without_noise_it_is_the_truth) {
  const LandmarkScene scene = make_landmark_scene(1, {.noise_px = 0});
  for (std::size_t i = 0; i < scene.tracks.size(); ++i) {
    const LandmarkFit fit = fit_landmark(scene.rig, scene.cameras, scene.tracks[i]);
    ASSERT_EQ(fit.status, LandmarkFitStatus::ok);
    EXPECT_LT((fit.point_in_world - scene.points_in_world[i]).norm(), 1e-9);
  }
}
}
}
