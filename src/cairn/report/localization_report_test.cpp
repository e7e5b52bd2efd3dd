// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/localization_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace cairn {
namespace {

/// A good image at 1 2 3, a weak one, and one that was not found.
std::vector<LocalizedImage> three_images() {
  std::vector<LocalizedImage> images(3);
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i].position = static_cast<std::int64_t>(i) + 4;
    images[i].stamp_ns = 1'500'000'000 + 1'000'000'000 * static_cast<std::int64_t>(i);
    images[i].file = "images/" + std::to_string(i) + ".png";
    images[i].feature_seconds = 0.001 * static_cast<double>(i + 1);
    images[i].localize_seconds = 0.01;
    images[i].found.matches.resize(5);
  }
  Localization& good = images[0].found;
  good.verdict = Verdict::good;
  good.camera_from_world.translation = {-1, -2, -3};
  good.inliers = {0, 1, 2, 4};
  good.independent = 3;
  good.cells = 2;
  good.rms_px = 0.75;
  good.variance_factor = 1.5;
  good.precision.covariance = 4e-6 * Matrix6d::Identity();
  good.precision.gdop = 0.125;
  good.precision.protection << 0, 0, 0, 0.01, 0.02, 0.03;
  Localization& weak = images[1].found;
  weak = good;
  weak.verdict = Verdict::weak;
  weak.weakness = Weakness::few_inliers;
  weak.inliers = {3};
  weak.from_prior = true;
  return images;
}

LocalizationSummary small_summary() {
  LocalizationSummary summary{"demo/map", "demo/street", "demo/found", "times", "64x48 pixels"};
  summary.images = 3;
  summary.open_seconds = 0.125;
  summary.peak_memory_mb = 50;
  return summary;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(LocalizationCsv, has_a_row_for_each_image) {
  const auto lines = lines_of(format_localization_csv(three_images(), small_summary()));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_NE(lines[0].find("images of 64x48 pixels. stamp_s: times."), std::string::npos);
  EXPECT_EQ(lines[1].find("frame,stamp_s,file,verdict,reason,tx_m,ty_m,tz_m,qx,qy,qz,qw,matches,inliers,"),
            0U);
  EXPECT_NE(lines[1].find(",std_rx_deg,std_ry_deg,std_rz_deg,std_x_m,"), std::string::npos);
  EXPECT_EQ(lines[2].find("4,1.500000000,images/0.png,good,"), 0U);
  EXPECT_NE(lines[2].find(",1,2,3,"), std::string::npos);
  EXPECT_NE(lines[2].find(",5,4,3,2,0.75,1.5,0,0.125,"), std::string::npos);
  EXPECT_NE(lines[2].find(",0.114592,0.114592,0.114592,0.002,0.002,0.002,0,0,0,0.01,0.02,0.03,4e-06,0,"),
            std::string::npos);
  EXPECT_NE(lines[3].find(",5,1,3,2,0.75,1.5,1,0.125,"), std::string::npos);  // from the prior
  EXPECT_EQ(lines[4].find("6,3.500000000,images/2.png,none,"), 0U);
}

TEST(LocalizationCsv, has_as_many_columns_in_every_row) {
  const auto lines = lines_of(format_localization_csv(three_images(), small_summary()));
  const auto columns = [&](std::size_t i) { return std::count(lines[i].begin(), lines[i].end(), ','); };
  for (std::size_t i = 2; i < lines.size(); ++i) EXPECT_EQ(columns(i), columns(1)) << lines[i];
}

TEST(LocalizationTrajectory, holds_the_images_with_a_pose) {
  const auto lines = lines_of(format_found_trajectory(three_images(), small_summary()));
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const auto& line) { return line[0] != '#'; }), 2);
  LocalizationSummary summary = small_summary();
  summary.stamps = "positions";
  EXPECT_EQ(format_found_trajectory(three_images(), summary)
                .find("# t: positions; localization.csv has the names of the files\n"),
            0U);
}

TEST(LocalizationJson, counts_images_and_lists_them) {
  const auto json = nlohmann::json::parse(format_localization_json(three_images(), small_summary()));
  EXPECT_EQ(json["images"]["total"], 3);
  EXPECT_EQ(json["images"]["good"], 1);
  EXPECT_EQ(json["images"]["weak"], 1);
  EXPECT_EQ(json["images"]["none"], 1);
  EXPECT_EQ(json["weak_because"], (nlohmann::json{{std::string(to_string(Weakness::few_inliers)), 1}}));
  EXPECT_EQ(json["median_inliers"], 4.0);
  EXPECT_EQ(json["median_std_m"], 0.002);
  EXPECT_EQ(json["median_protection_m"], 0.03);
  EXPECT_EQ(json["median_ms"]["features"], 2.0);
  EXPECT_EQ(json["results"][0]["position_m"], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(json["results"][0]["protection_m"], (std::vector<double>{0.01, 0.02, 0.03}));
  EXPECT_FALSE(json["results"][2].contains("position_m"));
}

TEST(LocalizationJson, has_no_medians_of_no_poses) {
  const auto json = nlohmann::json::parse(format_localization_json({}, small_summary()));
  EXPECT_TRUE(json["median_inliers"].is_null());
  EXPECT_TRUE(json["median_std_m"].is_null());
  EXPECT_EQ(json["weak_because"], nlohmann::json::object());
}

TEST(LocalizationText, tells_counts_precision_and_times) {
  EXPECT_EQ(format_localization_text(three_images(), small_summary()),
            "images       3: 1 good, 1 weak, 1 not found\ncamera       64x48 pixels\n  weak       " +
                std::string(to_string(Weakness::few_inliers)) +
                ": 1\n"
                "inliers      4 in the median\n"
                "position     0.2 cm by noise alone (standard deviation), protection level 3 cm (medians);\n"
                "             errors that the whole map has in common are in neither\n"
                "time         map opened in 0.125 s; 2.0 ms features and 10.0 ms localisation an image\n"
                "memory       50 MB at most\n"
                "picture      demo/found/landmarks.png, the poses in the map from above\n"
                "written to   demo/found\n");
}

TEST(LocalizationText, tells_what_is_out_of_the_ordinary) {
  LocalizationSummary summary = small_summary();
  summary.stamps = "positions";
  summary.unreadable = 2;
  summary.images = 9;
  summary.stopped = true;
  const std::string text = format_localization_text(three_images(), summary);
  EXPECT_NE(text.find("\nstamps       positions\n"), std::string::npos);
  EXPECT_NE(text.find("\nunreadable   2 images, skipped\nstopped      after 3 of 9 images\n"),
            std::string::npos);
}

TEST(LocalizationWords, describe_stamps_and_cameras) {
  Sequence sequence;
  EXPECT_EQ(describe_stamps(sequence), "times");
  sequence.has_times = false;
  EXPECT_EQ(describe_stamps(sequence), "file numbers / 30: the images have no times");
  sequence.format = "images";
  EXPECT_EQ(describe_stamps(sequence), "positions of the images in their folder, from 0: they have no times");
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  EXPECT_EQ(describe_camera(camera, {{}, 640, 480}), "640x480 pixels");
  EXPECT_EQ(describe_camera(camera, {{}, 320, 240}),
            "640x480 pixels, scaled to 320x240: to the map's pixels per radian");
}

TEST(LocalizationPictures, have_good_and_weak_poses) {
  const std::vector<FoundPose> found = found_poses(three_images());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].good);
  EXPECT_FALSE(found[1].good);
  EXPECT_EQ(found[0].world_from_camera.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(LocalizationPictures, have_features_and_landmarks_in_pixels_of_the_stored_image) {
  Camera camera{CameraModel::pinhole, 64, 48, 100, 100, 32, 24, {}};
  const Rig rig{50, 50, 16, 12, 0.1};  // of an image half as large
  Localization found;
  found.verdict = Verdict::good;
  found.inliers = {1};
  found.matches.resize(2);
  found.matches[0].seen = {16, 12};
  found.matches[0].point_in_world = {0, 0, -1};  // behind the camera
  found.matches[1].seen = {18.5, 12};
  found.matches[1].point_in_world = {0.1, 0, 2};
  const auto matches = drawn_matches(found, camera, rig);
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_FALSE(matches[0].inlier);
  EXPECT_LT(matches[0].projected.x(), -1000);
  EXPECT_TRUE(matches[1].inlier);
  EXPECT_NEAR((matches[1].seen - Eigen::Vector2d(37, 24)).norm(), 0, 1e-12);
  EXPECT_NEAR((matches[1].projected - Eigen::Vector2d(37, 24)).norm(), 0, 1e-12);
  found.verdict = Verdict::none;
  EXPECT_EQ(drawn_matches(found, camera, rig)[0].projected, drawn_matches(found, camera, rig)[0].seen);
}

}  // namespace
}  // namespace cairn
