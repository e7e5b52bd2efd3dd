// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/stereo_calibration.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

RowErrors some_rows() {
  RowErrors rows;
  rows.field << 0.1, 0.2, 0.3, -7, 0.5, 0.6;
  rows.pairs = 8;
  rows.matches = 3000;
  rows.rms_px = 0.6;
  return rows;
}

DisparityCalibration some_disparities() {
  DisparityCalibration found;
  found.field = {-0.74, -0.36, -1.4};
  found.sigma = {0.14, 0.17, 0.38};
  found.rms_px = 0.99;
  found.disparities = 10000;
  found.estimates = 5;
  return found;
}

TEST(StereoCalibration, says_what_was_found_and_done) {
  const RowErrors rows = some_rows();
  DisparityCalibration found = some_disparities();
  found.applied = true;
  EXPECT_EQ(
      describe({rows, true, found}),
      "stereo pair  rows off by 0.60 px RMS, corrected; disparities by 0.99 px RMS (-0.74 +- 0.14 px in the "
      "middle), corrected");
  found.applied = false;
  EXPECT_NE(describe({rows, false, found}).find("0.60 px RMS, left as they are;"), std::string::npos);
  EXPECT_NE(describe({rows, false, found}).find("middle), left as they are"), std::string::npos);
}

TEST(StereoCalibration, says_what_the_recording_does_not_determine) {
  RowErrors rows = some_rows();
  rows.pairs = 1;
  DisparityCalibration found = some_disparities();
  found.sigma[0] = 0.9;
  const std::string said = describe({rows, false, found});
  EXPECT_NE(said.find("0.60 px RMS, not determined;"), std::string::npos) << said;
  EXPECT_NE(said.find("middle), not determined"), std::string::npos) << said;
}

TEST(StereoCalibration, json_has_the_terms_and_what_was_done) {
  const Json json = to_json(StereoCalibrationFigures{some_rows(), true, some_disparities()});
  EXPECT_EQ(json["rows"]["terms_px"].size(), 6U);
  EXPECT_EQ(json["rows"]["terms_px"][3], -7.0);
  EXPECT_EQ(json["rows"]["applied"], true);
  EXPECT_EQ(json["disparities"]["terms_px"][0], -0.74);
  EXPECT_EQ(json["disparities"]["sigma_px"][2], 0.38);
  EXPECT_EQ(json["disparities"]["determined"], true);
  EXPECT_EQ(json["disparities"]["applied"], false);
}

TEST(StereoCalibration, nothing_is_said_where_nothing_was_measured) {
  EXPECT_EQ(describe({RowErrors{}, false, DisparityCalibration{}}), "");
  EXPECT_TRUE(to_json(StereoCalibrationFigures{RowErrors{}, false, DisparityCalibration{}}).is_null());
}

}  // namespace
}  // namespace cairn
