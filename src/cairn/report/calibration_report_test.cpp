// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/calibration_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

CalibrationResult result_with(const std::vector<Quantity>& quantities) {
  CalibrationResult result;
  result.frames = 12;
  result.tracked = 11;
  result.quantities = quantities;
  return result;
}

const Quantity kOff{"boresight x", "deg", 0.2, 0.01, Finding::off, "", true};
const Quantity kOpen{"lever arm z", "m", 0.1, 0.9, Finding::undetermined, "too level", false};
const Quantity kAlso{"lever arm y", "m", 0.1, 0.9, Finding::undetermined, "too level", false};

TEST(CalibrationReport, has_a_row_for_each_quantity_and_each_reason_once) {
  const CalibrationResult result = result_with({kOff, kAlso, kOpen});
  const std::optional<GivenPath> none;
  EXPECT_EQ(format_calibration_text({result, none, "camera.yaml"}),
            "frames       12, 11 tracked\n"
            "poses        none: baseline, time offset, boresight and lever arm need --poses\n"
            "quantity      found     std  unit         finding\n"
            "boresight x  0.2000  0.0100   deg  off, corrected\n"
            "lever arm y       -       -     m    undetermined\n"
            "lever arm z       -       -     m    undetermined\n"
            "lever arm y, lever arm z: undetermined: too level\n"
            "written to   camera.yaml\n");
}

TEST(CalibrationReport, says_that_poses_were_not_compared_when_the_run_was_stopped) {
  CalibrationResult result = result_with({kOff});
  result.stopped = true;
  std::optional<GivenPath> given(std::in_place);
  given->source = "gnss.csv";
  given->format = "table";
  const std::string text = format_calibration_text({result, given, "camera.yaml"});
  EXPECT_EQ(text.find("frames       12, 11 tracked, stopped before the end\n"
                      "poses        gnss.csv (table), not compared\n"),
            0U)
      << text;
}

TEST(CalibrationReport, says_what_to_do_about_what_is_not_written) {
  CalibrationResult result = result_with({{"baseline factor", "", 1.005, 0.0004, Finding::off, "", false},
                                          {"time offset", "s", 0.02, 0.001, Finding::off, "", false}});
  result.poses.emplace();
  result.poses->value[time_term] = 0.02;
  result.poses->findings[time_term] = result.poses->findings[scale_term] = Finding::off;
  std::optional<GivenPath> given(std::in_place);
  given->time_offset_s = 1;
  const std::string text = format_calibration_text({result, given, "camera.yaml"});
  EXPECT_NE(text.find("give --pose-offset 1.0200 to the commands"), std::string::npos) << text;
  EXPECT_NE(text.find("baseline factor: corrected only with --apply-baseline"), std::string::npos) << text;
  given->is_by_frame = true;
  EXPECT_NE(format_calibration_text({result, given, ""}).find("give them with stamps, 1.0200 s later"),
            std::string::npos);
}

TEST(CalibrationReport, says_that_nothing_was_corrected) {
  const CalibrationResult result = result_with({{"time offset", "s", 0.02, 0.001, Finding::off, "", false}});
  const std::string text = format_calibration_text({result, std::nullopt, "camera.yaml"});
  EXPECT_NE(text.find("off, not corrected"), std::string::npos) << text;
  EXPECT_NE(text.find("written to   camera.yaml; nothing was corrected"), std::string::npos) << text;
}

TEST(CalibrationReport, json_has_every_quantity) {
  const CalibrationResult result = result_with({kOff, kOpen});
  const std::optional<GivenPath> none;
  const auto json = nlohmann::json::parse(format_calibration_json({result, none, ""}));
  EXPECT_EQ(json["quantities"].size(), 2U);
  EXPECT_EQ(json["quantities"][0]["finding"], "off");
  EXPECT_EQ(json["quantities"][0]["written"], true);
  EXPECT_EQ(json["quantities"][1]["why"], "too level");
  EXPECT_TRUE(json["poses"].is_null());
  EXPECT_TRUE(json["output"].is_null());
}

}  // namespace
}  // namespace cairn
