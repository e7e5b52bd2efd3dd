// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/features_report.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TimedFeatures two_features(const std::string& path) {
  TimedFeatures timed{path, GrayImage(64, 48, 0), {}, 1.5};
  timed.features.keypoints = {{1.5F, 2, 31, 90, 0.25F}, {10, 20.25F, 62, -1, 7}};
  timed.features.descriptors = Descriptors(Norm::hamming, 32, 2);
  return timed;
}

TEST(FeaturesReport, counts_each_image) {
  const std::vector<FeatureCounts> counts{counts_of(two_features("a.png"))};
  EXPECT_EQ(format_features_text(counts, 0), "a.png  64x48  2 keypoints  1.500 ms\n");
  EXPECT_EQ(format_features_text(counts, 3),
            "a.png  64x48  2 keypoints  1.500 ms\n3 images cannot be read and were skipped\n");
  EXPECT_EQ(format_features_json("ORB", counts, 3), R"({
  "method": "ORB",
  "images": [
    {
      "image": "a.png",
      "width": 64,
      "height": 48,
      "keypoints": 2,
      "descriptor_bytes": 32,
      "time_ms": 1.5
    }
  ],
  "unreadable": 3
}
)");
}

TEST(FeaturesReport, lists_keypoints) {
  EXPECT_EQ(format_keypoints_csv(two_features("a.png").features.keypoints),
            "u,v,size,angle_deg,response\n1.5,2,31,90,0.25\n10,20.25,62,-1,7\n");
}

TEST(MatchReport, counts_and_lists_matches) {
  const TimedFeatures a = two_features("a.png"), b = two_features("b.png");
  const std::vector<Match> matches{{0, 1, 12}};
  const MatchReport report{"ORB", a, b, matches, 0.5};
  EXPECT_EQ(format_match_text(report),
            "a.png  2 keypoints  1.500 ms\nb.png  2 keypoints  1.500 ms\n1 matches  0.500 ms\n");
  EXPECT_EQ(format_matches_csv(report), "u1,v1,u2,v2,distance\n1.5,2,10,20.25,12\n");
  EXPECT_EQ(format_match_json(report), R"({
  "method": "ORB",
  "images": [
    {
      "image": "a.png",
      "keypoints": 2,
      "time_ms": 1.5
    },
    {
      "image": "b.png",
      "keypoints": 2,
      "time_ms": 1.5
    }
  ],
  "matches": 1,
  "matching_time_ms": 0.5
}
)");
}

}  // namespace
}  // namespace cairn
