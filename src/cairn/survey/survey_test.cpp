// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/image/codec.h"
#include "cairn/map/map.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/uvlist.h"
#include "cairn/sequence/sequence.h"
#include "cairn/simulate/simulate_street.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/survey/street_survey.h"

namespace cairn {
namespace {

using SurveyTest = testkit::StreetSurvey;
using testkit::contents_of;
using testkit::kStreetFrames;
using testkit::Watcher;

/// The depth nearest to `depth` within a pixel of where a point is seen; 0 where only the sky is.
double surface_near(const DepthImage& truth, const Eigen::Vector3d& pixel, double depth) {
  double best = 0;
  for (int dv = -1; dv <= 1; ++dv) {
    for (int du = -1; du <= 1; ++du) {
      const int u = std::clamp(static_cast<int>(std::lround(pixel.x())) + du, 0, truth.width() - 1);
      const int v = std::clamp(static_cast<int>(std::lround(pixel.y())) + dv, 0, truth.height() - 1);
      const double surface = truth(u, v);
      if (surface > 0 && std::abs(surface - depth) < std::abs(best - depth)) best = surface;
    }
  }
  return best;
}

TEST_F(SurveyTest, landmarks_lie_on_what_was_seen) {
  const SurveyResult result = survey("map");
  EXPECT_FALSE(result.stopped);
  EXPECT_EQ(result.counts.frames, kStreetFrames);
  const Map map = read_map(folder("map"));
  const auto covariances = read_covariances(folder("map"));
  ASSERT_EQ(std::ssize(map.landmarks()), result.counts.landmarks);
  EXPECT_EQ(std::ssize(map.keyframes()), kStreetFrames);
  EXPECT_GT(map.landmarks().size(), 300U);
  const SimulatedStreet street(testkit::small_street(kStreetFrames));
  std::vector<DepthImage> truth;
  for (int i = 0; i < kStreetFrames; ++i) truth.push_back(street.render(i).depth_true);
  std::size_t on_surface = 0;
  for (const Landmark& landmark : map.landmarks()) {
    const auto frame = landmark.observations.front().keyframe.index();
    const Rigid3 camera_from_world = map.world_from_camera(landmark.observations.front().keyframe).inverse();
    const Eigen::Vector3d point = camera_from_world * landmark.point_in_world;
    const Eigen::Matrix3d& covariance = covariances[landmark.id.index()];
    const Eigen::Vector3d axis = camera_from_world.rotation.conjugate() * Eigen::Vector3d::UnitZ();
    const double sigma = std::sqrt(axis.dot(covariance * axis));
    const double surface = surface_near(truth[frame], map.rig().project(point), point.z());
    if (std::abs(surface - point.z()) < 3 * sigma + 0.05) ++on_surface;
  }
  // The others are features of outlines, whose centres lie before one thing and behind another.
  EXPECT_GT(on_surface, map.landmarks().size() * 90 / 100);
}

TEST_F(SurveyTest, the_map_holds_together) {
  const SurveyResult result = survey("map");
  const SurveyCounts& counts = result.counts;
  const Map map = read_map(folder("map"));
  std::int64_t observations = 0;
  for (const Landmark& landmark : map.landmarks()) {
    observations += static_cast<std::int64_t>(landmark.observations.size());
    EXPECT_GE(landmark.observations.size(), 3U);
    // Two tracks that were merged, the second of which ended before the first was written.
    EXPECT_LT(landmark.observations.back().keyframe.value - landmark.observations.front().keyframe.value,
              options_.tracks.max_frames + 2 * options_.tracks.window + options_.tracks.pose_frames);
    for (const ObservationRef& observation : landmark.observations)
      EXPECT_EQ(map[observation.keyframe].landmarks[static_cast<std::size_t>(observation.feature)],
                landmark.id);
  }
  EXPECT_EQ(observations, counts.observations);
  const std::int64_t cleaned = std::accumulate(counts.cleaned.begin(), counts.cleaned.end(), std::int64_t{0});
  EXPECT_EQ(counts.tracks,
            counts.too_short + counts.inconsistent + cleaned + counts.merged + counts.landmarks);
  EXPECT_GE(counts.features, counts.measured);
  EXPECT_GT(counts.matched, counts.observations / 2);
  for (int i = 0; i < kStreetFrames; ++i) {  // exact poses hardly move
    const Rigid3& given = poses_.frames[static_cast<std::size_t>(i)]->world_from_camera;
    EXPECT_LT((map.world_from_camera(KeyframeId{i}).translation - given.translation).norm(), 0.03);
  }
  EXPECT_FALSE(has_unfinished_survey(folder("map")));
}

TEST_F(SurveyTest, is_the_same_at_any_number_of_threads) {
  (void)survey("one", 1);
  const auto one = contents_of(folder("one"));
  EXPECT_GT(std::ssize(one), kStreetFrames);
  for (const int threads : {2, 3}) {
    const std::string name = std::to_string(threads);
    (void)survey(name, threads);
    EXPECT_EQ(contents_of(folder(name)), one) << threads;
  }
}

TEST_F(SurveyTest, covariances_that_are_symmetric_up_to_rounding_make_a_map) {
  PoseUncertainty uncertainty;
  uncertainty.position << 4e-4, 1e-4, 2e-5, 1e-4 + 1e-20, 9e-4, 3e-5, 2e-5, 3e-5 - 4e-21, 1e-3;
  uncertainty.rotation << 3e-7, 1e-8, 2e-8, 1e-8 + 2e-24, 4e-7, 0, 2e-8, 0, 1e-6;
  for (auto& pose : poses_.frames) pose->uncertainty = uncertainty;
  const SurveyResult result = survey("map");
  EXPECT_GT(result.counts.landmarks, 300);
  for (const Eigen::Matrix3d& covariance : read_covariances(folder("map")))
    EXPECT_EQ(covariance, Eigen::Matrix3d(covariance.transpose()));
}

TEST_F(SurveyTest, deviations_of_a_metre_take_no_landmark_away) {
  const auto exact = static_cast<double>(survey("exact").counts.landmarks);
  PoseUncertainty cheap;
  cheap.position = Eigen::Vector3d(1, 1, 4).asDiagonal();
  for (auto& pose : poses_.frames) pose->uncertainty = cheap;
  const SurveyResult result = survey("cheap");
  EXPECT_GT(static_cast<double>(result.counts.landmarks), 0.99 * exact);  // the poses are others
  EXPECT_EQ(result.counts.dominated_by_poses, result.counts.landmarks);
  EXPECT_NEAR(result.pose_std_rms_m, 2, 1e-9);
  EXPECT_LT(result.image_std_rms_m, 0.5);
  EXPECT_EQ(result.stated.position_m, 2);
  for (const Eigen::Matrix3d& covariance : read_covariances(folder("cheap"))) EXPECT_GT(covariance(2, 2), 4);
}

TEST_F(SurveyTest, every_landmark_holds_against_every_limit) {
  options_.observer.features.count = 800;
  options_.cleaning.duplicate_sigmas = 8;  // to merge what hardly belongs together
  options_.cleaning.max_std_m = 2;
  options_.cleaning.max_rms_px = 0.4;
  options_.cleaning.depth.max_std = 6;
  options_.cleaning.angle_deg.max_std = 6;
  options_.cleaning.lateral.max_mean = 15;
  const SurveyResult result = survey("map");
  EXPECT_GT(result.counts.merged, 0);
  std::int64_t rows = 0;
  UvlistStream table(folder("map") / "uvlist.txt", crc32(read_file(folder("map") / "uvlist.txt")));
  while (const auto* row = table.next()) {
    const auto value = [&](const std::string& name) {
      const auto& columns = uvlist_columns();
      return (
          *row)[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())];
    };
    constexpr double kRounding = 1 + 1e-5;  // the table has six digits
    EXPECT_LE(value("rms_px"), 0.4 * kRounding);
    EXPECT_LE(value("std_depth"), 6 * kRounding);
    EXPECT_LE(value("std_angle_deg"), 6 * kRounding);
    EXPECT_LE(value("mean_lateral"), 15 * kRounding);
    EXPECT_GE(value("frames"), 3);
    ++rows;
  }
  EXPECT_EQ(rows, result.counts.landmarks);
}

TEST_F(SurveyTest, misread_poses_are_refused) {
  for (auto& pose : poses_.frames)
    pose->world_from_camera = WorldFromCamera(Rigid3(pose->world_from_camera).inverse());
  try {
    (void)survey("map");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("inverse poses"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(has_unfinished_survey(folder("map")));
}

TEST_F(SurveyTest, frames_without_a_pose_are_left_out) {
  forget_pose(4);
  forget_pose(kStreetFrames - 1);
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.without_pose, 2);
  EXPECT_EQ(result.counts.frames, kStreetFrames - 2);
  const Map map = read_map(folder("map"));
  ASSERT_EQ(std::ssize(map.keyframes()), kStreetFrames - 2);
  EXPECT_EQ(map.keyframes()[3].observed.frame, FrameId{3});
  EXPECT_EQ(map.keyframes()[4].observed.frame, FrameId{5});
}

TEST_F(SurveyTest, a_camera_that_stands_adds_nothing) {
  stand_at(10);
  stand_at(10);
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.stationary, 2);
  EXPECT_EQ(result.counts.frames, kStreetFrames);
  const Map map = read_map(folder("map"));
  EXPECT_EQ(map.keyframes()[10].observed.frame, FrameId{10});
  EXPECT_EQ(map.keyframes()[11].observed.frame, FrameId{13});
}

TEST_F(SurveyTest, an_unreadable_frame_is_reported_and_left_out) {
  sequence_.frames[6].color = damaged_image();
  Watcher watcher;
  const SurveyResult result = survey("map", 2, &watcher);
  EXPECT_EQ(result.counts.unreadable, 1);
  EXPECT_EQ(result.counts.frames, kStreetFrames - 1);
  ASSERT_EQ(watcher.warnings.size(), 1U);
  EXPECT_NE(watcher.warnings[0].find("damaged.png"), std::string::npos) << watcher.warnings[0];
  EXPECT_GT(result.counts.landmarks, 250);
}

TEST_F(SurveyTest, not_one_readable_frame_is_bad_input) {
  for (FrameFiles& files : sequence_.frames) files.color = damaged_image();
  try {
    (void)survey("map");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().expected, "a PNG, JPEG, PGM or PPM image");
    EXPECT_EQ(error.details().found, "another kind of file; and none of 26 frames can be read");
  }
}

TEST_F(SurveyTest, one_camera_without_depth_is_refused) {
  sequence_.calibration.baseline.reset();
  try {
    (void)survey("map");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().expected, "a stereo or an RGB-D sequence");
  }
}

TEST_F(SurveyTest, options_out_of_range_are_named) {
  options_.tracks.pose_frames = -1;
  try {
    (void)survey("map");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("pose_frames"), std::string::npos) << error.what();
  }
}

TEST_F(SurveyTest, images_without_texture_make_a_map_without_landmarks) {
  write_png(folder("flat.png"), GrayImage(414, 125, 90));
  for (FrameFiles& files : sequence_.frames) files.color = files.right = folder("flat.png");
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.landmarks, 0);
  EXPECT_EQ(result.counts.features, 0);
  EXPECT_EQ(std::ssize(read_map(folder("map")).keyframes()), kStreetFrames);
}

TEST_F(SurveyTest, wrong_poses_make_no_landmarks) {
  // As with the poses of another drive, sideways.
  Random random(3);
  for (auto& pose : poses_.frames)
    pose->world_from_camera.translation +=
        9 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  Watcher watcher;
  const SurveyResult result = survey("map", 2, &watcher);
  EXPECT_LT(result.counts.landmarks, 30);
  EXPECT_EQ(result.pose_check.verdict, PoseVerdict::contradiction);
  ASSERT_EQ(watcher.warnings.size(), 1U);
  EXPECT_NE(watcher.warnings[0].find("contradict the images"), std::string::npos) << watcher.warnings[0];
}

TEST_F(SurveyTest, there_is_a_pose_or_none_for_each_frame) {
  poses_.frames.pop_back();
  EXPECT_THROW((void)survey("map"), PreconditionError);
}

}  // namespace
}  // namespace cairn
