// SPDX-License-Identifier: Apache-2.0
// Rectification on a recording by others: left and right features that look alike have to lie in one row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "cairn/features/extractor.h"
#include "cairn/image/codec.h"
#include "cairn/matching/matching.h"
#include "cairn/sequence/sequence.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

/// Rows of matches, right minus left, pixels. The matching knows nothing of rows.
std::vector<double> row_differences(const Extractor& extractor, const GrayImage& left,
                                    const GrayImage& right) {
  const Features a = extractor.extract(left), b = extractor.extract(right);
  constexpr double kMaxRatio = 0.7;  // hardly one in a hundred is wrong
  std::vector<double> differences;
  for (const Match& match :
       match_descriptors(a.descriptors, b.descriptors, {.max_ratio = kMaxRatio, .mutual = true})) {
    differences.push_back(static_cast<double>(b.keypoints[static_cast<std::size_t>(match.train)].v -
                                              a.keypoints[static_cast<std::size_t>(match.query)].v));
  }
  return differences;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median_size(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return median(std::move(values));
}

class RectifiedPairsDataTest : public testing::Test {
 protected:
  const fs::path folder_ = fs::path(CAIRN_DATA_DIR) / "stereo/euroc_v101";
};

TEST_F(RectifiedPairsDataTest, matches_lie_in_one_row) {
  if (!fs::exists(folder_)) {
    ASSERT_EQ(std::getenv("CAIRN_REQUIRE_DATA"), nullptr) << folder_ << " is missing";
    GTEST_SKIP() << "needs " << folder_;
  }
  const Sequence sequence = open_sequence(folder_);
  const FrameLoader loader(sequence);
  const auto sift = make_extractor({"SIFT", "SIFT", 1000});
  std::vector<double> raw, rectified;
  for (int i = 0; i < 100; i += 10) {
    const FrameFiles& files = sequence.frames[static_cast<std::size_t>(i)];
    const Frame frame = loader.load(FrameId{i});
    const auto add = [&](std::vector<double>& all, const GrayImage& left, const GrayImage& right) {
      const auto differences = row_differences(*sift, left, right);
      all.insert(all.end(), differences.begin(), differences.end());
    };
    add(raw, read_gray(files.color), read_gray(files.right));
    add(rectified, frame.gray, frame.right);
  }
  ASSERT_GT(rectified.size(), 1000U);
  EXPECT_GT(median_size(raw), 3.0);
  EXPECT_LT(median_size(rectified), 0.25);
  EXPECT_LT(std::abs(median(rectified)), 0.15);
  RecordProperty("matches", static_cast<int>(rectified.size()));
  RecordProperty("median_row_difference_px", std::to_string(median_size(rectified)));
  RecordProperty("median_row_offset_px", std::to_string(median(rectified)));
  RecordProperty("median_row_difference_before_px", std::to_string(median_size(raw)));
}

}  // namespace
}  // namespace cairn
