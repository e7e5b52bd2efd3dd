// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/depth_noise.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

const Rig kRig{500, 500, 320, 240, 0.08};

TEST(DepthNoiseReport, says_what_a_depth_is_good_to) {
  const DisparityNoiseEstimate found{{0.1, 0.0015}, kRig, 2500};
  EXPECT_EQ(describe(found),
            "depth        good to 2.9 mm at 1 m and 23 mm at 3 m (one standard deviation), estimated from "
            "2500 readings");
  const Json json = to_json(std::optional(found));
  EXPECT_NEAR(json["sigma_at_1_m"].get<double>(), std::hypot(0.1 / 40, 0.0015), 1e-12);
  EXPECT_EQ(json["sigma_disparity_px"], 0.1);
  EXPECT_EQ(json["estimated_from"], 2500);
}

TEST(DepthNoiseReport, says_that_it_is_not_estimated) {
  const DisparityNoiseEstimate stated{{1, 0}, kRig, 0}, assumed{{1, 0}, kRig, 0, true};
  EXPECT_EQ(describe(stated),
            "depth        good to 25.0 mm at 1 m and 225 mm at 3 m (one standard deviation), as stated");
  EXPECT_NE(describe(assumed).find("assumed, as too few readings show it"), std::string::npos);
}

TEST(DepthNoiseReport, is_silent_without_a_depth_camera) {
  EXPECT_EQ(describe(std::optional<DisparityNoiseEstimate>{}), "");
  EXPECT_TRUE(to_json(std::optional<DisparityNoiseEstimate>{}).is_null());
}

}  // namespace
}  // namespace cairn
