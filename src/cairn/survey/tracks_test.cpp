// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cairn/core/executor.h"
#include "cairn/testing/features/random_descriptor.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::kDriveRig;

constexpr std::size_t kPoints = 60;

/// Two frames whose points all have a track, and a third one.
class MatchToTracks : public testing::Test {
 protected:
  MatchToTracks() {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(kPoints); ++i)
      tracks_.push_back(testkit::track_of(frames_, i, 0, 1));
  }
  [[nodiscard]] std::vector<TrackMatch> match(int threads = 1) const {
    return match_to_tracks(kDriveRig, frames_, tracks_, next_, options_, Executor(threads));
  }
  [[nodiscard]] bool is_matched(std::int32_t track) const {
    const auto matches = match();
    return std::any_of(matches.begin(), matches.end(),
                       [&](const TrackMatch& found) { return found.track == track; });
  }
  [[nodiscard]] Observation& seen(std::size_t feature) { return next_.observed.observations[feature]; }
  [[nodiscard]] Keypoint& keypoint(std::size_t feature) { return next_.observed.features.keypoints[feature]; }
  void move(std::size_t feature, const Eigen::Vector2d& by) {
    seen(feature).u += by.x(), seen(feature).v += by.y();
    keypoint(feature).u += static_cast<float>(by.x()), keypoint(feature).v += static_cast<float>(by.y());
  }
  /// Unit vector from the epipole, on the epipolar line: where a wrong depth moves the pixel.
  [[nodiscard]] Eigen::Vector2d along_line(std::size_t feature) {
    const Rigid3 now_from_then = next_.odometry.inverse() * frames_.back().odometry;
    const Eigen::Vector3d epipole = kDriveRig.project(now_from_then.translation);
    return Eigen::Vector2d(seen(feature).u - epipole.x(), seen(feature).v - epipole.y()).normalized();
  }

  std::vector<testkit::DrivePoint> points_ = testkit::roadside_points(kPoints);
  FrameBuffer frames_ = testkit::drive(points_, 2);
  std::vector<Track> tracks_;
  SurveyFrame next_ = testkit::see(points_, 2, testkit::on_bend(2));
  TrackOptions options_;
};

TEST_F(MatchToTracks, finds_each_where_it_should_be) {
  const auto matches = match();
  ASSERT_EQ(matches.size(), kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    EXPECT_EQ(matches[i].track, static_cast<std::int32_t>(i));
    EXPECT_EQ(matches[i].feature, matches[i].track);
  }
}

TEST_F(MatchToTracks, refuses_what_looks_different) {
  testkit::put_look(testkit::kDriveLooks, 1000, 5, next_.observed.features.descriptors);
  EXPECT_FALSE(is_matched(5));
  EXPECT_EQ(match().size(), kPoints - 1);
}

TEST_F(MatchToTracks, refuses_what_is_elsewhere) {
  testkit::forget_disparity(5, next_);
  move(5, 40 * along_line(5));
  EXPECT_FALSE(is_matched(5));
  options_.search_px = 60;
  EXPECT_TRUE(is_matched(5));
}

TEST_F(MatchToTracks, refuses_what_is_off_the_epipolar_line) {
  options_.search_px = 10;
  const Eigen::Vector2d along = along_line(7);
  move(7, 5 * Eigen::Vector2d(-along.y(), along.x()));
  EXPECT_FALSE(is_matched(7));
  options_.epipolar_px = 5.5;
  EXPECT_TRUE(is_matched(7));
}

TEST_F(MatchToTracks, a_coarser_keypoint_may_be_further_off_the_line) {
  options_.search_px = 10;
  const Eigen::Vector2d along = along_line(7);
  move(7, 5 * Eigen::Vector2d(-along.y(), along.x()));
  keypoint(7).sigma_px = 3;
  EXPECT_TRUE(is_matched(7));
}

TEST_F(MatchToTracks, refuses_another_depth) {
  seen(9).d += 8;
  EXPECT_FALSE(is_matched(9));
  seen(9).sigma_d_px = 3;
  EXPECT_TRUE(is_matched(9));
}

TEST_F(MatchToTracks, takes_a_feature_without_a_disparity) {
  testkit::forget_disparity(9, next_);
  EXPECT_TRUE(is_matched(9));
}

TEST_F(MatchToTracks, refuses_what_is_behind_the_camera) {
  next_ = testkit::see(points_, 2, WorldFromCamera(Rigid3{Eigen::Quaterniond::Identity(), {0, 0, 60}}));
  for (std::size_t i = 0; i < kPoints; ++i) testkit::forget_disparity(i, next_);
  EXPECT_TRUE(match().empty());
}

TEST_F(MatchToTracks, a_full_track_takes_no_more) {
  options_.max_frames = 3;
  tracks_[4] = testkit::track_of(frames_, 4, 1, 1);
  EXPECT_EQ(match().size(), 1U);
  EXPECT_TRUE(is_matched(4));
  options_.max_frames = 4;
  EXPECT_EQ(match().size(), kPoints);
}

TEST_F(MatchToTracks, of_two_tracks_one_gets_the_feature) {
  tracks_.push_back(tracks_[3]);
  const auto matches = match();
  std::set<std::int32_t> features;
  for (const TrackMatch& found : matches) EXPECT_TRUE(features.insert(found.feature).second);
  EXPECT_EQ(matches.size(), kPoints);
}

TEST_F(MatchToTracks, of_two_like_features_none_is_believed) {
  testkit::put_look(testkit::kDriveLooks, 3, 4, next_.observed.features.descriptors);
  move(4, Eigen::Vector2d(seen(3).u + 1 - seen(4).u, seen(3).v - seen(4).v));
  keypoint(4).size = keypoint(3).size;
  EXPECT_FALSE(is_matched(3));
  options_.max_ratio = 0;
  EXPECT_TRUE(is_matched(3));
}

TEST_F(MatchToTracks, goes_by_the_odometry) {
  // Given poses may jump: the tracks live in the world of the odometry.
  const Rigid3 jump{rotation_exp({0, 0.3, 0}), {5, 0, 3}};
  next_.given.world_from_camera = next_.world_from_camera = WorldFromCamera(jump * next_.odometry);
  next_.camera_from_world = next_.world_from_camera.inverse();
  EXPECT_EQ(match().size(), kPoints);
}

TEST_F(MatchToTracks, is_the_same_at_any_number_of_threads) {
  const auto points = testkit::roadside_points(700, 2);
  frames_ = testkit::drive(points, 2, 0.5);
  next_ = testkit::see(points, 2, testkit::on_bend(2), 0.5);
  tracks_.clear();
  for (std::int32_t i = 0; i < 700; ++i) tracks_.push_back(testkit::track_of(frames_, i, 0, 1));
  const auto one = match(1);
  EXPECT_GT(one.size(), 500U);
  for (const int threads : {2, 3}) {
    const auto many = match(threads);
    ASSERT_EQ(many.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].track, one[i].track);
      EXPECT_EQ(many[i].feature, one[i].feature);
    }
  }
}

TEST(KeepUseful, keeps_what_has_a_disparity_or_a_match) {
  const auto points = testkit::roadside_points(6);
  SurveyFrame frame = testkit::see(points, 0, testkit::on_bend(0));
  for (const std::size_t feature : {0U, 2U, 3U, 5U}) testkit::forget_disparity(feature, frame);
  const ObservedFrame all = frame.observed;
  std::vector<TrackMatch> matches{{10, 3}, {11, 4}};
  drop_unused_features(frame, matches);
  EXPECT_EQ(frame.kept, (std::vector<std::uint32_t>{1, 3, 4}));
  EXPECT_EQ(matches[0].feature, 1);
  EXPECT_EQ(matches[1].feature, 2);
  EXPECT_EQ(matches[0].track, 10);
  ASSERT_EQ(frame.observed.observations.size(), 3U);
  ASSERT_EQ(frame.observed.features.keypoints.size(), 3U);
  ASSERT_EQ(frame.observed.features.descriptors.count(), 3U);
  EXPECT_EQ(frame.observed.stamp_ns, all.stamp_ns);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t was = frame.kept[i];
    EXPECT_EQ(frame.observed.observations[i].u, all.observations[was].u);
    EXPECT_EQ(frame.observed.features.keypoints[i].v, all.features.keypoints[was].v);
    EXPECT_TRUE(std::equal(all.features.descriptors.row(was), all.features.descriptors.row(was) + 32,
                           frame.observed.features.descriptors.row(i)));
    EXPECT_EQ(frame.observed.points_in_camera[i].allFinite(), was != 3);
  }
}

TEST(ExtendTracks, features_join_or_begin) {
  const auto points = testkit::roadside_points(4);
  SurveyFrame first = testkit::see(points, 0, testkit::on_bend(0));
  testkit::forget_disparity(3, first);
  std::vector<Track> tracks;
  extend_tracks(first, {}, tracks);
  ASSERT_EQ(tracks.size(), 3U);  // the one without a disparity begins none
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((tracks[i].point_in_world - points[i].position).norm(), 1e-9);

  SurveyFrame second = testkit::see(points, 1, testkit::on_bend(1));
  second.odometry.translation.x() += 1;  // where tracks are placed
  testkit::forget_disparity(0, second);
  const std::vector<TrackMatch> matches{{0, 0}, {2, 2}};
  extend_tracks(second, matches, tracks);
  ASSERT_EQ(tracks.size(), 5U);
  EXPECT_EQ(tracks[0].observations, testkit::observations_of(0, 0, 1));  // joins without one, too,
  EXPECT_EQ(tracks[0].measured, (ObservationRef{{0}, 0}));               // and stays where it was measured
  EXPECT_LT((tracks[0].point_in_world - points[0].position).norm(), 1e-9);
  EXPECT_EQ(tracks[1].observations, testkit::observations_of(1, 0, 0));
  EXPECT_EQ(tracks[2].measured, (ObservationRef{{1}, 2}));
  EXPECT_NEAR((tracks[2].point_in_world - points[2].position).norm(), 1, 1e-9);
  EXPECT_EQ(tracks[3].observations, testkit::observations_of(1, 1, 1));
  EXPECT_EQ(tracks[4].observations, testkit::observations_of(3, 1, 1));
}

/// Numbers of the features whose tracks are finished at `newest`; those that stay remain in `tracks`.
std::vector<std::int32_t> finished_at(int newest, const TrackOptions& options, std::vector<Track>& tracks) {
  std::vector<std::int32_t> features;
  for (const Track& track : extract_finished({newest}, options, tracks))
    features.push_back(track.observations.front().feature);
  return features;
}

TEST(TakeFinished, tracks_that_left_the_window) {
  TrackOptions options;
  options.window = 5;
  const FrameBuffer frames = testkit::drive(testkit::roadside_points(4), 8);
  std::vector<Track> tracks{testkit::track_of(frames, 0, 0, 3), testkit::track_of(frames, 1, 0, 2),
                            testkit::track_of(frames, 2, 0, 7), testkit::track_of(frames, 3, 2, 2)};
  tracks[3].observations.push_back({{6}, 3});  // without a disparity there: its place is too old
  EXPECT_TRUE(finished_at(6, options, tracks).empty());
  EXPECT_EQ(finished_at(7, options, tracks), (std::vector<std::int32_t>{1, 3}));
  EXPECT_EQ(tracks.size(), 2U);
  EXPECT_EQ(finished_at(8, options, tracks), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(finished_at(11, options, tracks), (std::vector<std::int32_t>{}));
  EXPECT_EQ(finished_at(12, options, tracks), (std::vector<std::int32_t>{2}));
  EXPECT_TRUE(tracks.empty());
}

TEST(TakeFinished, full_tracks) {
  TrackOptions options;
  options.window = 8;
  options.max_frames = 5;
  const FrameBuffer frames = testkit::drive(testkit::roadside_points(2), 8);
  std::vector<Track> tracks{testkit::track_of(frames, 0, 0, 3), testkit::track_of(frames, 1, 2, 3)};
  EXPECT_TRUE(finished_at(3, options, tracks).empty());
  EXPECT_EQ(finished_at(4, options, tracks), (std::vector<std::int32_t>{0}));
  EXPECT_EQ(finished_at(6, options, tracks), (std::vector<std::int32_t>{1}));
}

}  // namespace
}  // namespace cairn
