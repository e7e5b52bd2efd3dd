// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/keyframe_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace cairn {
namespace {

/// Three keyframes, of which the second was erased; the last is known to 2 cm and 0.01 rad on each axis.
SlamResult three_keyframes() {
  SlamResult result;
  result.map = Map(Rig{500, 500, 320, 240, 0.1}, "ORB");
  for (std::int32_t k = 0; k < 3; ++k) {
    ObservedFrame observed;
    observed.frame = {k};
    observed.stamp_ns = 1'000'000'000LL * k;
    (void)result.map.add_keyframe(std::move(observed), {}, k == 0 ? KeyframeId{} : KeyframeId{0}, 0);
  }
  result.map.erase(KeyframeId{1});
  result.keyframe_covariances.resize(3);
  result.keyframe_covariances[0].from_first = Matrix6d::Zero();
  Vector6d variances;
  variances << 1e-4, 1e-4, 1e-4, 4e-4, 4e-4, 4e-4;
  result.keyframe_covariances[2].from_first = Matrix6d(variances.asDiagonal());
  return result;
}

std::vector<std::string> rows_of(const SlamResult& result) {
  std::vector<std::string> rows;
  std::istringstream text(format_keyframe_covariances(result));
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("#")) rows.push_back(line);
  return rows;
}

TEST(KeyframeReport, has_a_row_for_each_keyframe_that_is_left) {
  const auto rows = rows_of(three_keyframes());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(rows[0].starts_with("stamp_s,first_cov_rx_rx,first_cov_rx_ry,")) << rows[0];
  EXPECT_TRUE(rows[0].ends_with(",previous_cov_y_z,previous_cov_z_z")) << rows[0];
  for (const std::string& row : rows) EXPECT_EQ(std::count(row.begin(), row.end(), ','), 42) << row;
  EXPECT_TRUE(rows[1].starts_with("0.000000000,0,0,")) << rows[1];
  EXPECT_TRUE(rows[2].starts_with("2.000000000,0.0001,0,0,0,0,0,0.0001,")) << rows[2];
  EXPECT_TRUE(rows[2].ends_with(",0.0004" + std::string(21, ','))) << "nothing is known of the one before";
}

TEST(KeyframeReport, says_how_sure_the_last_keyframe_is) {
  SlamResult result = three_keyframes();
  const auto last = last_keyframe_precision(result);
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->position_m, 0.02 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(last->rotation_deg, 0.01 * std::sqrt(3.0) * 57.29577951, 1e-8);
  result.keyframe_covariances.clear();
  EXPECT_FALSE(last_keyframe_precision(result)) << "not adjusted as a whole";
}

}  // namespace
}  // namespace cairn
