// SPDX-License-Identifier: Apache-2.0
// Runs that were stopped, or failed, and what the next one goes on from.
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "cairn/image/codec.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/survey/street_survey.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

using SurveyTest = testkit::StreetSurvey;
using testkit::contents_of;
using testkit::kStreetFrames;
using testkit::Watcher;

TEST_F(SurveyTest, goes_on_where_it_was_stopped) {
  const SurveyResult whole = survey("whole");
  const auto expected = contents_of(folder("whole"));
  for (const int updates : {1, 7, 15, kStreetFrames - 1}) {
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

TEST_F(SurveyTest, other_deviations_of_the_poses_begin_anew) {
  for (auto& pose : poses_.frames) pose->uncertainty = PoseUncertainty{};
  Watcher stop(12);
  (void)survey("map", 2, &stop);
  poses_.frames[3]->uncertainty->rotation(1, 1) = 1e-9;
  EXPECT_EQ(survey("map").resumed_at, 0);
}

TEST_F(SurveyTest, another_origin_begins_anew) {
  poses_.origin = GeodeticOrigin{49, 8, 110};
  Watcher stop(12);
  (void)survey("map", 2, &stop);
  poses_.origin->height_m = 111;
  EXPECT_EQ(survey("map").resumed_at, 0);
}

TEST_F(SurveyTest, an_image_changed_behind_the_window_begins_anew) {
  fs::copy(sequence_.frames[0].right, folder("0.png"));
  sequence_.frames[0].right = folder("0.png");
  Watcher stop(20);
  (void)survey("map", 2, &stop);
  fs::last_write_time(folder("0.png"), fs::last_write_time(folder("0.png")) + std::chrono::seconds(3));
  EXPECT_EQ(survey("map").resumed_at, 0);
}

/// Fails as a defect would after some frames.
class Breaking : public Watcher {
 public:
  explicit Breaking(std::int64_t at) : at_(at) {}
  void update(std::int64_t done) override {
    if (done == at_) throw std::runtime_error("a defect");
    Watcher::update(done);
  }

 private:
  std::int64_t at_;
};

TEST_F(SurveyTest, a_run_that_fails_discards_what_was_kept) {
  (void)survey("whole");
  Watcher stop(8);
  (void)survey("map", 2, &stop);
  ASSERT_TRUE(has_unfinished_survey(folder("map")));
  Breaking breaking(11);
  EXPECT_THROW((void)survey("map", 2, &breaking), std::runtime_error);
  EXPECT_FALSE(has_unfinished_survey(folder("map")));
  ASSERT_EQ(breaking.warnings.size(), 1U);
  EXPECT_NE(breaking.warnings[0].find("begins anew"), std::string::npos) << breaking.warnings[0];
  EXPECT_EQ(survey("map").resumed_at, 0);
  EXPECT_TRUE(contents_of(folder("map")) == contents_of(folder("whole")));
}

TEST_F(SurveyTest, damaged_pieces_begin_anew) {
  (void)survey("whole");
  Watcher stop(20);
  (void)survey("map", 2, &stop);
  int cut = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder("map"))) {
    if (!entry.is_regular_file() || entry.path().parent_path() == folder("map") / "frames" ||
        entry.path().filename() == "checkpoint.bin")
      continue;
    fs::resize_file(entry.path(), 0);
    ++cut;
  }
  ASSERT_GT(cut, 0);
  Watcher watcher;
  EXPECT_EQ(survey("map", 2, &watcher).resumed_at, 0);
  EXPECT_EQ(watcher.warnings.size(), 1U);
  EXPECT_TRUE(contents_of(folder("map")) == contents_of(folder("whole")));
}

TEST_F(SurveyTest, an_image_changed_meanwhile_begins_anew) {
  fs::copy(sequence_.frames[5].color, folder("5.png"));
  sequence_.frames[5].color = folder("5.png");
  Watcher stop(8);
  (void)survey("map", 2, &stop);
  write_png(folder("5.png"), GrayImage(414, 125, 90));  // without features
  EXPECT_EQ(survey("map").resumed_at, 0);
}

}  // namespace
}  // namespace cairn
