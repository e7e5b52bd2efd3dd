// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/survey/street_survey.h"

#include <optional>

#include "cairn/core/executor.h"
#include "cairn/simulate/write_kitti.h"

namespace cairn::testkit {

SimulateStreetOptions small_street(int frames) {
  SimulateStreetOptions options;
  options.frames_count = frames;
  options.camera = {CameraModel::pinhole, 414, 125, 240, 240, 203, 57, {}};
  options.seed = 5;
  return options;
}

void write_small_street(const std::filesystem::path& folder, int frames) {
  const Executor executor(2);
  Progress silent;
  (void)write_kitti(SimulatedStreet(small_street(frames), executor), folder, false, executor, silent);
}

SurveyOptions small_window() {
  SurveyOptions options;
  options.observer.features.count = 500;
  options.tracks.window = 6;
  options.tracks.pose_frames = 3;
  options.tracks.max_frames = 10;
  return options;
}

void StreetSurvey::SetUpTestSuite() {
  street_ = std::make_unique<const TemporaryFolder>();
  write_small_street(street_->path(), kStreetFrames);
}

StreetSurvey::StreetSurvey()
    : sequence_(open_sequence(street_->path())), poses_(read_given_poses(sequence_)) {}

SurveyResult StreetSurvey::survey(const std::string& name, int threads, Progress* progress) const {
  Progress silent;
  return run_survey({sequence_, poses_, "settings: some\n"}, options_, scratch_.make_folder(name),
                    Executor(threads), progress != nullptr ? *progress : silent);
}

void StreetSurvey::forget_pose(std::size_t frame) {
  poses_.frames[frame].reset();
  ++poses_.without_pose;
}

void StreetSurvey::stand_at(std::size_t frame) {
  const auto at = static_cast<std::ptrdiff_t>(frame);
  FrameFiles again = sequence_.frames[frame];
  ++again.stamp_ns;
  sequence_.frames.insert(sequence_.frames.begin() + at + 1, again);
  const std::optional<GivenPose> pose = poses_.frames[frame];
  poses_.frames.insert(poses_.frames.begin() + at + 1, pose);
}

std::filesystem::path StreetSurvey::damaged_image() const {
  return scratch_.write("damaged.png", "no image");
}

}  // namespace cairn::testkit
