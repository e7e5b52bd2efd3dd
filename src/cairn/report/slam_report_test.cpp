// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/slam_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

TrackingResult track_of(std::int32_t frame, TrackingStatus status, std::optional<KeyframeId> reference) {
  TrackingResult track;
  track.frame = {frame};
  track.stamp_ns = 500'000'000LL * frame;
  track.status = status;
  track.reference = reference;
  track.matches = reference ? 50 : 3;
  track.inliers = reference ? 40 + frame : 0;
  return track;
}

/// Six frames: two keyframes of one component with a frame between them, a lost frame, one that went too far,
/// and the keyframe of another component, which was found again.
struct SlamRun : testing::Test {
  SlamRun() {
    sequence.folder = "demo/room";
    sequence.frames.resize(7);
    result.map = Map(Rig{500, 500, 320, 240, 0.1}, "ORB");
    for (const std::int32_t component : {0, 0, 1}) {
      const auto number = static_cast<std::int32_t>(result.map.keyframes().size());
      ObservedFrame observed;
      observed.frame = {number == 2 ? 5 : 2 * number};
      result.map.add_keyframe(std::move(observed), {Eigen::Quaterniond::Identity(), {1.0 * number, 0, 0}},
                              KeyframeId{}, component);
    }
    result.frames = {track_of(0, TrackingStatus::keyframe, KeyframeId{0}),
                     track_of(1, TrackingStatus::tracked, KeyframeId{0}),
                     track_of(2, TrackingStatus::keyframe, KeyframeId{1}),
                     track_of(3, TrackingStatus::lost, std::nullopt),
                     track_of(4, TrackingStatus::implausible, std::nullopt),
                     track_of(5, TrackingStatus::keyframe, KeyframeId{2})};
    result.frames[1].reference_from_frame.translation = {0.5, 0, 0};
    result.frames[5].relocalized = true;
    result.loops.tried = 9;
    result.loops.rejected = 2;
    result.loops.unconfirmed = 1;
    result.times.tracking = {0.002, 0.003, 0.003};
    summary.folder = "demo/run";
    summary.total_seconds = 2;
    summary.threads = 4;
    summary.peak_memory_mb = 80.4;
  }
  Sequence sequence;
  SlamResult result;
  SlamSummary summary;
};

TEST_F(SlamRun, says_how_sure_the_last_keyframe_is) {
  EXPECT_EQ(format_slam_text(sequence, result, summary).find("precision"), std::string::npos);
  const auto figures_of = [&] { return nlohmann::json::parse(format_slam_json(sequence, result, summary)); };
  EXPECT_TRUE(figures_of()["last_keyframe_precision"].is_null()) << "not adjusted as a whole";
  result.keyframe_covariances.resize(3);
  result.keyframe_covariances[1].from_first = 1e-4 * Matrix6d::Identity();
  EXPECT_NEAR(figures_of()["last_keyframe_precision"]["position_m"], 0.0173205, 1e-6);
  EXPECT_NE(format_slam_text(sequence, result, summary)
                .find("precision    last keyframe to 0.017 m and 0.99 degrees of the first"),
            std::string::npos);
}

TEST_F(SlamRun, has_a_row_for_each_frame) {
  EXPECT_EQ(
      format_frames_csv(result),
      "frame,stamp_s,outcome,relocalized,part,reference_keyframe,matches,inliers,rotation_rad,translation_m,"
      "motion,motion_since_keyframe\n"
      "0,0.000000000,keyframe,0,0,0,50,40,,,,\n"
      "1,0.500000000," +
          std::string(to_string(TrackingStatus::tracked)) +
          ",0,0,0,50,41,0.000000,0.500000,0.500000,0.500000\n"
          "2,1.000000000,keyframe,0,0,1,50,42,0.000000,0.500000,0.500000,1.000000\n3,1.500000000," +
          std::string(to_string(TrackingStatus::lost)) + ",0,,,3,0,,,,\n4,2.000000000," +
          std::string(to_string(TrackingStatus::implausible)) +
          ",0,,,3,0,,,,\n5,2.500000000,keyframe,1,1,2,50,45,,,,\n");
}

TEST_F(SlamRun, is_told_in_text) {
  EXPECT_EQ(format_slam_text(sequence, result, summary),
            R"(frames       3 of 6 tracked (50.0 %), median 42 inliers
lost         1 not matched, 1 too far, found again 1 times
elsewhere    1 frames in a part of the map that was never joined with this one
keyframes    3
landmarks    0
loops        0 closed, 0 met without a gap, 3 not believed, of 9 keyframes compared
picture      demo/run/landmarks.png, the map from above
time         2.0 s on 4 threads, 3.0 frames/s
  stages     total s, median ms, 95 % ms
    decode       0.00     0.00     0.00
    features     0.00     0.00     0.00
    tracking     0.01     3.00     3.00
    mapping      0.00     0.00     0.00
    loops        0.00     0.00     0.00
    window       0.00     0.00     0.00
    global       0.00     0.00     0.00
memory       80 MB at most
written to   demo/run
)");
}

TEST_F(SlamRun, tells_what_was_written) {
  summary.has_cloud = summary.has_octree = summary.fused = true;
  summary.cloud_points = 1234;
  summary.occupied_voxels = 5;
  summary.free_voxels = 6;
  summary.fusion_seconds = 0.5;
  summary.ate_m = 0.0125;
  summary.ate_pairs = 3;
  sequence.truth = Trajectory{};
  const std::string text = format_slam_text(sequence, result, summary);
  EXPECT_NE(
      text.find("\naccuracy     ATE RMSE 1.25 cm against the sequence's truth (SE(3) alignment, 3 pairs)\n"),
      std::string::npos);
  EXPECT_NE(text.find("\ncloud        demo/run/cloud.ply, 1234 points; a picture of it in cloud.png\n"
                      "octree       demo/run/octree.ot, 5 occupied and 6 free voxels\n"),
            std::string::npos);
  EXPECT_NE(text.find("\n    fusion       0.50\n"), std::string::npos);
  EXPECT_NE(text.find("\nnext         cairn evaluate demo/run demo/room\n"), std::string::npos);
}

TEST_F(SlamRun, tells_whether_the_start_map_was_recognised) {
  result.start_keyframes = 1;
  EXPECT_NE(format_slam_text(sequence, result, summary)
                .find("\nstart map    recognised; the trajectory is in its world, from frame 0 on\n"
                      "keyframes    3, 2 of this run\n"),
            std::string::npos);
  result.map.set_component(KeyframeId{0}, 1);  // the run has most of its frames in another component
  result.frames[1].reference = KeyframeId{1};
  EXPECT_NE(format_slam_text(sequence, result, summary)
                .find("\nstart map    not recognised: the trajectory is in a world of its own, a new part of "
                      "the map\n"),
            std::string::npos);
}

TEST_F(SlamRun, is_told_in_json) {
  result.unreadable = {"a.png: damaged"};
  summary.seed = 7;
  const auto json = nlohmann::ordered_json::parse(format_slam_json(sequence, result, summary));
  EXPECT_EQ(json.begin().key(), "cairn");
  EXPECT_EQ(json["sequence"], "demo/room");
  EXPECT_EQ(json["frames"]["total"], 7);
  EXPECT_EQ(json["frames"]["processed"], 6);
  EXPECT_EQ(json["frames"]["tracked"], 3);
  EXPECT_EQ(json["frames"]["tracked_percent"], 50.0);
  EXPECT_EQ(json["frames"]["elsewhere"], 1);
  EXPECT_EQ(json["frames"]["relocalized"], 1);
  EXPECT_EQ(json["frames"]["unreadable"][0], "a.png: damaged");
  EXPECT_EQ(json["median_inliers"], 42);
  EXPECT_EQ(json["keyframes"], 3);
  EXPECT_TRUE(json["start_map"].is_null());
  EXPECT_TRUE(json["ate_rmse_m"].is_null());
  EXPECT_EQ(json["loops"]["rejected"], 2);
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["stages"].begin().key(), "decode");
  EXPECT_NEAR(json["stages"]["tracking"]["total_s"], 0.008, 1e-12);
  EXPECT_EQ(json["peak_memory_mb"], 80.4);
}

TEST_F(SlamRun, has_a_path_through_its_main_component) {
  const CameraPath path = main_path(result);
  ASSERT_EQ(path.world_from_camera.size(), 3U);
  EXPECT_EQ(path.world_from_camera[1].translation, Eigen::Vector3d(0.5, 0, 0));
  EXPECT_EQ(path.world_from_camera[2].translation, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(path.keyframes, (std::vector<std::size_t>{0, 2}));
}

}  // namespace
}  // namespace cairn
