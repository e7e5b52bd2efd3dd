// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/map_report.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

MapStatistics small_map() {
  MapStatistics figures;
  MapInfo& info = figures.info;
  info.rig = {500, 510, 319.5, 239.5, 0.075};
  info.width = 640;
  info.height = 480;
  info.descriptor = {"ORB", Norm::hamming, 32};
  info.keyframes.resize(5);
  info.features = 4000;
  info.landmarks = 2;
  info.observations = 5;
  figures.component_keyframes = {{0, 3}, {1, 2}};
  figures.most_observations = 3;
  figures.indicators.push_back({"rms_px", {}});
  figures.indicators.back().values.add(0.5);
  figures.indicators.back().values.add(0.5);
  figures.indicators.push_back({"std_x", {}});
  return figures;
}

TEST(MapReport, tells_counts_header_and_indicators) {
  EXPECT_EQ(format_map_text("demo/map", small_map()),
            R"(map          demo/map
keyframes    5, 800 features each
components   2, of 3, 2 keyframes
landmarks    2
observations 5, 2.50 per landmark, 3 at most
descriptors  ORB (Hamming, 32 bytes)
camera       fx 500 fy 510 cx 319.5 cy 239.5 px, baseline 0.075 m
images       640 x 480 pixels
world        camera of the first keyframe

indicator              min       5 %    median      95 %       max      mean
rms_px                 0.5       0.5       0.5       0.5       0.5       0.5
std_x, std_y, std_z and largest_std know the noise of observations and the stated errors of poses;
errors that landmarks have in common and no pose states, as of a calibration, are not in them
)");
}

TEST(MapReport, tells_the_origin_and_unknown_covariances) {
  MapStatistics figures = small_map();
  figures.without_covariance = 1;
  figures.info.origin = GeodeticOrigin{49, 8.5, 115};
  const std::string text = format_map_text("map", figures);
  EXPECT_NE(
      text.find(
          "\norigin       latitude 49.000000000, longitude 8.500000000 degrees, height 115.000 m (WGS 84)\n"),
      std::string::npos);
  EXPECT_NE(text.find("\nno covariance: 1 landmarks, of which no standard deviation is counted\n"),
            std::string::npos);
  EXPECT_NE(
      format_map_json("map", figures)
          .find(
              "  \"origin\": {\n    \"latitude_deg\": 49.0,\n    \"longitude_deg\": 8.5,\n    \"height_m\": "
              "115.0\n  },\n  \"without_covariance\": 1,\n"),
      std::string::npos);
}

TEST(MapReport, has_no_indicators_of_an_empty_map) {
  MapStatistics figures = small_map();
  figures.info.landmarks = 0;
  figures.info.observations = 0;
  EXPECT_EQ(format_map_text("map", figures).find("indicator"), std::string::npos);
}

TEST(MapReport, has_in_json_what_the_text_has) {
  EXPECT_EQ(format_map_json("demo/map", small_map()), R"({
  "map": "demo/map",
  "keyframes": 5,
  "features": 4000,
  "parts": [
    3,
    2
  ],
  "landmarks": 2,
  "sightings": 5,
  "sightings_per_landmark": 2.5,
  "most_sightings": 3,
  "descriptor": "ORB",
  "camera": {
    "fx": 500.0,
    "fy": 510.0,
    "cx": 319.5,
    "cy": 239.5
  },
  "baseline_m": 0.075,
  "image": {
    "width": 640,
    "height": 480
  },
  "world": "camera of the first keyframe",
  "origin": null,
  "without_covariance": 0,
  "indicators": {
    "rms_px": {
      "count": 2,
      "min": 0.5,
      "percentile_5": 0.5,
      "median": 0.5,
      "percentile_95": 0.5,
      "max": 0.5,
      "mean": 0.5
    },
    "std_x": {
      "count": 0
    }
  }
}
)");
}

}  // namespace
}  // namespace cairn
