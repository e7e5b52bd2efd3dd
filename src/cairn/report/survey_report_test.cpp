// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/survey_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

SurveyResult small_survey() {
  SurveyResult result;
  result.counts.frames = 10;
  result.counts.features = 10'000;
  result.counts.measured = 8'000;
  result.counts.matched = 5'000;
  result.counts.tracks = 700;
  result.counts.too_short = 300;
  result.counts.inconsistent = 20;
  result.counts.cleaned[static_cast<std::size_t>(CleaningRule::frames)] = 50;
  result.counts.cleaned[static_cast<std::size_t>(CleaningRule::view_angle)] = 1;
  result.counts.merged = 9;
  result.counts.landmarks = 300;
  result.counts.observations = 1'200;
  result.image_std_rms_m = 0.0125;
  result.pose_check.pairs = 12;
  result.pose_check.error_px = std::numeric_limits<double>::infinity();
  result.times.decode = 0.5;
  return result;
}

SurveySummary small_summary() {
  SurveySummary summary{"out/map", "TUM", 12, 2, 3, {}, 0};
  summary.peak_memory_mb = 123.4;
  return summary;
}

TEST(SurveyText, tells_what_became_of_frames_and_landmarks) {
  EXPECT_EQ(format_survey_text(small_survey(), small_summary()),
            R"(frames       10 of 12 mapped
poses        TUM
features     1000 a frame, 800 with depth, 500 matched to a track
tracks       700, 300 in too few frames, 20 contradict themselves
cleaning     50 seen in too few frames, 1 seen too obliquely; 9 merged
landmarks    300, in 4.0 frames each
deviations   0.013 m by what the images leave open, none stated of the poses (RMS, worst direction)
map          out/map; cairn info out/map says how good it is
picture      out/map/landmarks.png, the landmarks from above
time         3.0 s, 300 ms a frame
memory       123 MB at most
)");
}

TEST(SurveyText, tells_what_is_out_of_the_ordinary) {
  SurveyResult result = small_survey();
  result.counts.without_pose = 1;
  result.counts.stationary = 2;
  result.counts.unreadable = 3;
  result.counts.cleaned = {};
  result.resumed_at = 6;
  result.moved_rms_m = 0.02;
  result.turned_rms_deg = 0.125;
  result.pose_std_rms_m = 0.5;
  result.pose_check.verdict = PoseVerdict::contradiction;
  SurveySummary summary = small_summary();
  summary.image_root = "data/images";
  const std::string text = format_survey_text(result, summary);
  EXPECT_EQ(text.find("frames       10 of 12 mapped, 1 without pose, 2 without motion, 3 unreadable\n"
                      "resumed      at frame 6 of the sequence\n"
                      "poses        TUM, moved by 2.0 cm and 0.125 degrees (RMS) to agree with the "
                      "images\n             they contradict the images: " +
                      describe(result.pose_check) + "\n"),
            0U);
  EXPECT_NE(text.find("\ncleaning     none fell to a rule; 9 merged\n"), std::string::npos);
  EXPECT_NE(text.find(" leave open, 0.5 m by the poses' (RMS"), std::string::npos);
  EXPECT_NE(text.find("\ncolmap       out/map/colmap, with --image_path data/images\n"), std::string::npos);
}

TEST(SurveyText, says_by_how_many_deviations_poses_were_moved) {
  SurveyResult result = small_survey();
  result.moved_rms_m = 0.02;
  result.moves = {10, {0.4, 0.25}, {1.3, 0.75}};
  EXPECT_NE(format_survey_text(result, small_summary())
                .find(" (RMS) to agree with the images:\n"
                      "             in standard deviations that they state moved by 0.4 (1.3 at most), "
                      "turned by 0.25 "
                      "(0.75 at most) (medians)\n"),
            std::string::npos);
  result.moves.median.rotation = result.moves.largest.rotation = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(format_survey_text(result, small_summary())
                .find(" in standard deviations that they state moved by 0.4 (1.3 at most) (medians)\n"),
            std::string::npos);
}

TEST(SurveyJson, has_moves_in_deviations_if_the_poses_state_some) {
  SurveyResult result = small_survey();
  EXPECT_TRUE(
      nlohmann::json::parse(format_survey_report(result))["smoothed_poses"]["moved_sigmas"].is_null());
  result.moves = {10, {0.4, 0}, {1.3, std::numeric_limits<double>::infinity()}};
  const auto json = nlohmann::json::parse(format_survey_report(result))["smoothed_poses"];
  EXPECT_EQ(json["moved_sigmas"]["median"], 0.4);
  EXPECT_EQ(json["moved_sigmas"]["max"], 1.3);
  EXPECT_EQ(json["turned_sigmas"]["median"], 0);
  EXPECT_TRUE(json["turned_sigmas"]["max"].is_null());  // turned, though stated as exact
}

TEST(SurveyJson, has_a_report_that_is_the_same_in_every_run) {
  SurveyResult result = small_survey();
  const std::string report = format_survey_report(result);
  result.times.decode = 99;
  result.resumed_at = 5;
  EXPECT_EQ(format_survey_report(result), report);
  const auto json = nlohmann::json::parse(report);
  EXPECT_EQ(json["frames"]["mapped"], 10);
  EXPECT_EQ(json["features"]["matched_to_tracks"], 5'000);
  EXPECT_EQ(json["tracks"]["contradictory"], 20);
  EXPECT_EQ(json["cleaned"]["frames"], 50);
  EXPECT_EQ(json["cleaned"]["depth"], 0);
  EXPECT_EQ(json["uncertainty"]["by_images_rms_m"], 0.0125);
  EXPECT_EQ(json["pose_check"]["verdict"], "undecided");
  EXPECT_TRUE(json["pose_check"]["error_px"].is_null());  // infinite
}

TEST(SurveyJson, adds_the_times_of_this_run) {
  const auto json = nlohmann::ordered_json::parse(format_survey_json(small_survey(), small_summary()));
  EXPECT_EQ(json.begin().key(), "cairn");
  EXPECT_EQ(json["map"], "out/map");
  EXPECT_EQ(json["landmarks"], 300);
  EXPECT_EQ(json["seconds"]["total"], 3.0);
  EXPECT_EQ(json["seconds"]["decode"], 0.5);
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["peak_memory_mb"], 123.4);
}

}  // namespace
}  // namespace cairn
