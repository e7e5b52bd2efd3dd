// SPDX-License-Identifier: Apache-2.0
// What the tests of whole runs share: a simulated street to be mapped.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cairn/map/test_map.h"
#include "cairn/sequence/simulate_street.h"
#include "cairn/sequence/write_kitti.h"
#include "cairn/survey/survey.h"

namespace cairn {

namespace fs = std::filesystem;

inline constexpr int kFrames = 26;

inline SimulateStreetOptions street_options() {
  SimulateStreetOptions options;
  options.frames_count = kFrames;
  options.camera = {CameraModel::pinhole, 414, 125, 240, 240, 203, 57, {}};
  options.seed = 5;
  return options;
}

/// So small a window that frames and landmarks are written on the way.
inline SurveyOptions small_window() {
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

  static inline fs::path street_;
  const TestFolder scratch_;
  Sequence sequence_;
  GivenPoses poses_;
  SurveyOptions options_ = small_window();
};

}  // namespace cairn
