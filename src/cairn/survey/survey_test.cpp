// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "cairn/image/codec.h"
#include "cairn/map/test_map.h"
#include "cairn/sequence/simulate_street.h"
#include "cairn/sequence/write_kitti.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 26;

SimulateStreetOptions street_options() {
  SimulateStreetOptions options;
  options.frames_count = kFrames;
  options.camera = {CameraModel::pinhole, 414, 125, 240, 240, 203, 57, {}};
  options.seed = 5;
  return options;
}

/// So small a window that frames and landmarks are written on the way.
SurveyOptions small_window() {
  SurveyOptions options;
  options.observer.features.count = 500;
  options.tracks.window = 6;
  options.tracks.smooth_frames = 3;
  options.tracks.max_frames = 10;
  return options;
}

/// Stops after some updates, and remembers what it was told.
class Watcher : public Progress {
 public:
  explicit Watcher(int updates_before_stop = kFrames + 1) : updates_left_(updates_before_stop) {}
  void update(std::int64_t done) override {
    --updates_left_;
    last_update = done;
  }
  void warn(const std::string& message) override { warnings.push_back(message); }
  [[nodiscard]] bool stop_requested() const override { return updates_left_ <= 0; }

  std::vector<std::string> warnings;
  std::int64_t last_update = 0;

 private:
  int updates_left_;
};

/// A simulated street with exact poses in a folder of its own, made once for all tests; each test works on a
/// copy of the lists, and maps into a folder of its own.
class SurveyTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    street_ = fs::temp_directory_path() / ("cairn_survey_test_" + std::to_string(::getpid()));
    fs::create_directories(street_);
    const Executor executor(2);
    Progress silent;
    (void)write_kitti(SimulatedStreet(street_options(), executor), street_, false, executor, silent);
  }
  static void TearDownTestSuite() { fs::remove_all(street_); }

  SurveyTest() : sequence_(open_sequence(street_)), poses_(read_given_poses(sequence_)) {}

  SurveyResult survey(const std::string& name, int threads = 2, Progress* progress = nullptr) const {
    Progress silent;
    fs::create_directories(folder(name));
    return run_survey({sequence_, poses_, "settings: some\n"}, options_, folder(name), Executor(threads),
                      progress != nullptr ? *progress : silent);
  }
  [[nodiscard]] fs::path folder(const std::string& name) const { return scratch_.path() / name; }
  void forget_pose(std::size_t frame) {
    poses_.frames[frame].reset();
    ++poses_.without_pose;
  }
  /// Shows `frame` once more where it was, a moment later.
  void stand_at(std::size_t frame) {
    const auto at = static_cast<std::ptrdiff_t>(frame);
    FrameFiles again = sequence_.frames[frame];
    ++again.stamp_ns;
    sequence_.frames.insert(sequence_.frames.begin() + at + 1, again);
    const std::optional<GivenPose> pose = poses_.frames[frame];
    poses_.frames.insert(poses_.frames.begin() + at + 1, pose);
  }
  [[nodiscard]] fs::path damaged_image() const {
    write_file(scratch_.path() / "damaged.png", "no image");
    return scratch_.path() / "damaged.png";
  }

  static fs::path street_;
  const TestFolder scratch_;
  Sequence sequence_;
  GivenPoses poses_;
  SurveyOptions options_ = small_window();
};

fs::path SurveyTest::street_;

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
  EXPECT_EQ(result.counts.frames, kFrames);
  const Map map = read_map(folder("map"));
  const auto covariances = read_covariances(folder("map"));
  ASSERT_EQ(map.landmarks().size(), static_cast<std::size_t>(result.counts.landmarks));
  EXPECT_EQ(map.keyframes().size(), static_cast<std::size_t>(kFrames));
  EXPECT_GT(map.landmarks().size(), 300U);
  const SimulatedStreet street(street_options());
  std::vector<DepthImage> truth;
  for (int i = 0; i < kFrames; ++i) truth.push_back(street.render(i).depth_true);
  std::size_t on_surface = 0;
  for (const Landmark& landmark : map.landmarks()) {
    const auto frame = static_cast<std::size_t>(landmark.sightings.front().keyframe.value);
    const Rigid3 camera_from_world = map.world_from_camera(landmark.sightings.front().keyframe).inverse();
    const Eigen::Vector3d point = camera_from_world * landmark.point_in_world;
    const Eigen::Matrix3d& covariance = covariances[static_cast<std::size_t>(landmark.id.value)];
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
  std::int64_t sightings = 0;
  for (const Landmark& landmark : map.landmarks()) {
    sightings += static_cast<std::int64_t>(landmark.sightings.size());
    EXPECT_GE(landmark.sightings.size(), 3U);
    EXPECT_LT(landmark.sightings.back().keyframe.value - landmark.sightings.front().keyframe.value, 20);
    for (const Sighting& sighting : landmark.sightings)
      EXPECT_EQ(map[sighting.keyframe].landmarks[static_cast<std::size_t>(sighting.feature)], landmark.id);
  }
  EXPECT_EQ(sightings, counts.sightings);
  const std::int64_t cleaned = std::accumulate(counts.cleaned.begin(), counts.cleaned.end(), std::int64_t{0});
  EXPECT_EQ(counts.tracks,
            counts.too_short + counts.contradictory + cleaned + counts.merged + counts.landmarks);
  EXPECT_GE(counts.features, counts.measured);
  EXPECT_GT(counts.matched, counts.sightings / 2);
  for (int i = 0; i < kFrames; ++i) {  // exact poses: smoothing hardly moves them
    const Rigid3& given = poses_.frames[static_cast<std::size_t>(i)]->world_from_camera;
    EXPECT_LT((map.world_from_camera(KeyframeId{i}).translation - given.translation).norm(), 0.03);
  }
  EXPECT_FALSE(has_unfinished_survey(folder("map")));
}

TEST_F(SurveyTest, is_the_same_at_any_number_of_threads) {
  (void)survey("one", 1);
  const auto one = contents_of(folder("one"));
  EXPECT_GT(one.size(), static_cast<std::size_t>(kFrames));
  for (const int threads : {2, 3}) {
    const std::string name = std::to_string(threads);
    (void)survey(name, threads);
    EXPECT_EQ(contents_of(folder(name)), one) << threads;
  }
}

TEST_F(SurveyTest, goes_on_where_it_was_stopped) {
  const SurveyResult whole = survey("whole");
  const auto expected = contents_of(folder("whole"));
  for (const int updates : {1, 7, 15, kFrames - 1}) {
    const std::string name = "stopped_" + std::to_string(updates);
    Watcher stop(updates);
    const SurveyResult stopped = survey(name, 2, &stop);
    EXPECT_TRUE(stopped.stopped);
    EXPECT_TRUE(has_unfinished_survey(folder(name)));
    EXPECT_EQ(stop.last_update, updates);
    const SurveyResult resumed = survey(name, 1);
    EXPECT_FALSE(resumed.stopped);
    EXPECT_EQ(resumed.resumed_at, updates);
    EXPECT_EQ(resumed.counts.landmarks, whole.counts.landmarks);
    EXPECT_EQ(resumed.counts.tracks, whole.counts.tracks);
    EXPECT_EQ(resumed.counts.moved_squared_m, whole.counts.moved_squared_m);
    EXPECT_TRUE(contents_of(folder(name)) == expected) << updates;
  }
}

TEST_F(SurveyTest, goes_on_as_often_as_it_was_stopped) {
  (void)survey("whole");
  int runs = 0;
  for (bool stopped = true; stopped; ++runs) {
    Watcher stop(9);
    stopped = survey("pieces", 2, &stop).stopped;
  }
  EXPECT_EQ(runs, 3);
  EXPECT_TRUE(contents_of(folder("pieces")) == contents_of(folder("whole")));
}

TEST_F(SurveyTest, another_input_begins_anew) {
  Watcher stop(12);
  (void)survey("map", 2, &stop);
  poses_.frames[3]->world_from_camera.translation.x() += 1e-9;
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.resumed_at, 0);
  (void)survey("whole");
  EXPECT_TRUE(contents_of(folder("map")) == contents_of(folder("whole")));
}

TEST_F(SurveyTest, frames_without_a_pose_are_left_out) {
  forget_pose(4);
  forget_pose(kFrames - 1);
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.without_pose, 2);
  EXPECT_EQ(result.counts.frames, kFrames - 2);
  const Map map = read_map(folder("map"));
  ASSERT_EQ(map.keyframes().size(), static_cast<std::size_t>(kFrames - 2));
  EXPECT_EQ(map.keyframes()[3].observed.frame, FrameId{3});
  EXPECT_EQ(map.keyframes()[4].observed.frame, FrameId{5});
}

TEST_F(SurveyTest, a_camera_that_stands_adds_nothing) {
  stand_at(10);
  stand_at(10);
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.standing, 2);
  EXPECT_EQ(result.counts.frames, kFrames);
  const Map map = read_map(folder("map"));
  EXPECT_EQ(map.keyframes()[10].observed.frame, FrameId{10});
  EXPECT_EQ(map.keyframes()[11].observed.frame, FrameId{13});
}

TEST_F(SurveyTest, an_unreadable_frame_is_reported_and_left_out) {
  sequence_.frames[6].color = damaged_image();
  Watcher watcher;
  const SurveyResult result = survey("map", 2, &watcher);
  EXPECT_EQ(result.counts.unreadable, 1);
  EXPECT_EQ(result.counts.frames, kFrames - 1);
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

TEST_F(SurveyTest, an_image_changed_meanwhile_begins_anew) {
  fs::copy(sequence_.frames[5].color, folder("5.png"));
  sequence_.frames[5].color = folder("5.png");
  Watcher stop(8);
  (void)survey("map", 2, &stop);
  write_png(folder("5.png"), GrayImage(414, 125, 90));  // without features
  EXPECT_EQ(survey("map").resumed_at, 0);
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
  options_.tracks.smooth_frames = options_.tracks.window;
  try {
    (void)survey("map");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("smooth_frames"), std::string::npos) << error.what();
  }
}

TEST_F(SurveyTest, images_without_texture_make_a_map_without_landmarks) {
  write_png(folder("flat.png"), GrayImage(414, 125, 90));
  for (FrameFiles& files : sequence_.frames) files.color = files.right = folder("flat.png");
  const SurveyResult result = survey("map");
  EXPECT_EQ(result.counts.landmarks, 0);
  EXPECT_EQ(result.counts.features, 0);
  EXPECT_EQ(read_map(folder("map")).keyframes().size(), static_cast<std::size_t>(kFrames));
}

TEST_F(SurveyTest, wrong_poses_make_no_landmarks) {
  // As with the poses of another drive: each frame gets that of a frame far away, backwards.
  std::reverse(poses_.frames.begin(), poses_.frames.end());
  EXPECT_LT(survey("map").counts.landmarks, 30);
}

TEST_F(SurveyTest, there_is_a_pose_or_none_for_each_frame) {
  poses_.frames.pop_back();
  EXPECT_THROW((void)survey("map"), PreconditionError);
}

}  // namespace
}  // namespace cairn
