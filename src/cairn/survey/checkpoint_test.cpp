// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/checkpoint.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/geometry/camera_paths.h"
#include "cairn/testing/survey/point_drive.h"

namespace cairn {
namespace {

using testkit::contents_of;
using testkit::TemporaryFolder;

constexpr std::uint32_t kIdentity = 1234;

/// All its numbers, none of which is padding.
using CountsAsNumbers = std::array<std::int64_t, sizeof(SurveyCounts) / sizeof(std::int64_t)>;
static_assert(std::has_unique_object_representations_v<CountsAsNumbers>);

CountsAsNumbers numbers_of(const SurveyCounts& counts) {
  return std::bit_cast<CountsAsNumbers>(counts);
}

/// A different number for each count.
SurveyCounts all_different() {
  CountsAsNumbers numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 1000 + static_cast<std::int64_t>(i);
  return std::bit_cast<SurveyCounts>(numbers);
}

SurveyLandmark make_landmark(const FrameBuffer& frames, std::int32_t feature) {
  SurveyLandmark landmark =
      fit_observations(testkit::kDriveRig, frames, testkit::observations_of(feature, 4, 8), SurveyOptions())
          .value();
  landmark.pose_covariance = Eigen::Vector3d(0.1, 0.2, 0.3 + feature).asDiagonal();
  landmark.variance_factor = 1.75;
  landmark.image_covariance = Eigen::Vector3d(0.4, 0.5, 0.6 + feature).asDiagonal();
  return landmark;
}

/// What a landmark may say of its noise, a bit more of each number for a larger `i`.
LandmarkErrors errors(int i) {
  const double x = 1 + 0.01 * i;
  return {7 * x, 3 * x, 6, 4, 0.3 * x, 0.9 * x, 0.2 * x, 0.1 * x, 5};
}

/// As in the middle of a drive: frames 4 to 8 are still needed.
SurveyState make_state() {
  SurveyState state;
  state.frames = testkit::drive(testkit::roadside_points(6), 9, 0.4);
  for (int i = 0; i < 4; ++i) state.frames.pop_front();
  for (std::int32_t i = 3; i < 5; ++i) state.pending.push_back(make_landmark(state.frames, i));
  state.next_in_sequence = 13;
  state.next_frame = {9};
  state.next_landmark = {77};
  for (int i = 4; i < 9; ++i) {
    SurveyFrame& frame = state.frames[KeyframeId{i}];
    frame.observed.frame = {i + 4};  // four were left out
    frame.kept = {0, 2, 3, 5, 8, static_cast<std::uint32_t>(20 + i)};
    frame.landmarks[1] = {70 + i};
    frame.odometry.translation.x() += i;
    frame.world_from_camera.translation.y() += 0.01 * i;
    frame.camera_from_world = frame.world_from_camera.inverse();
    if (i > 4) frame.motion = VisualMotion{testkit::on_bend(i), 1e-6 * i, 1e-4 * i};
  }
  for (std::int32_t i = 0; i < 3; ++i) state.tracks.push_back(testkit::track_of(state.frames, i, 5, 8 - i));
  for (int i = 0; i < 120; ++i) state.variance.add(1.0 + i % 5, 6);
  for (int i = 0; i < 130; ++i) state.noise.add(errors(i));
  state.counts = all_different();
  return state;
}

MapWriterState writer_state() {
  MapWriterState state{{}, 4, 77, 4321, 1234};
  for (std::size_t i = 0; i < state.append_files.size(); ++i)
    state.append_files[i] = {100 * i, static_cast<std::uint32_t>(7 * i)};
  return state;
}

class CheckpointTest : public testing::Test {
 protected:
  void write() const { write_checkpoint(folder_.path(), kIdentity, state_, writer_state()); }
  [[nodiscard]] std::optional<Checkpoint> read(std::uint32_t identity = kIdentity) const {
    return read_checkpoint(folder_.path(), identity,
                           [&](std::vector<SurveyFrame>& frames) { observe_again(frames); });
  }
  /// From what make_state observed.
  void observe_again(std::vector<SurveyFrame>& frames) const {
    for (SurveyFrame& frame : frames) {
      const SurveyFrame& before = state_.frames[frame.id];
      EXPECT_EQ(frame.observed.frame, before.observed.frame);
      EXPECT_EQ(frame.kept, before.kept);
      frame.observed = before.observed;
      frame.given = before.given;
    }
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "checkpoint.bin"; }

  const TemporaryFolder folder_;
  const SurveyState state_ = make_state();
};

void expect_equal(const Rigid3& a, const Rigid3& b) {
  EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs());
  EXPECT_EQ(a.translation, b.translation);
}

void expect_equal(const SurveyFrame& a, const SurveyFrame& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.kept, b.kept);
  EXPECT_EQ(a.landmarks, b.landmarks);
  expect_equal(a.world_from_camera, b.world_from_camera);
  expect_equal(a.camera_from_world, b.camera_from_world);
  expect_equal(a.odometry, b.odometry);
  ASSERT_EQ(a.motion.has_value(), b.motion.has_value());
  if (!a.motion) return;
  expect_equal(a.motion->previous_from_this, b.motion->previous_from_this);
  EXPECT_EQ(a.motion->rotation_variance, b.motion->rotation_variance);
  EXPECT_EQ(a.motion->translation_variance, b.motion->translation_variance);
}

void expect_equal(const Track& a, const Track& b) {
  EXPECT_EQ(a.observations, b.observations);
  EXPECT_EQ(a.measured, b.measured);
  EXPECT_EQ(a.point_in_world, b.point_in_world);
}

void expect_equal(const ValueRange& a, const ValueRange& b) {
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.min, b.min);
  EXPECT_EQ(a.max, b.max);
  EXPECT_EQ(a.std, b.std);
}

void expect_equal(const LandmarkIndicators& a, const LandmarkIndicators& b) {
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.rms_px, b.rms_px);
  EXPECT_EQ(a.max_ray_angle_deg, b.max_ray_angle_deg);
  expect_equal(a.distance, b.distance);
  expect_equal(a.lateral, b.lateral);
  expect_equal(a.depth, b.depth);
  expect_equal(a.angle_deg, b.angle_deg);
}

void expect_equal(const LandmarkErrors& a, const LandmarkErrors& b) {
  using Numbers = std::array<double, sizeof(LandmarkErrors) / sizeof(double)>;
  EXPECT_EQ(std::bit_cast<Numbers>(a), std::bit_cast<Numbers>(b));
}

void expect_equal(const LandmarkInformation& a, const LandmarkInformation& b) {
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(a.disparities, b.disparities);
  expect_equal(a.errors, b.errors);
}

void expect_equal(const LandmarkNoiseModel& a, const LandmarkNoiseModel& b) {
  EXPECT_EQ(a.count(), b.count());
  EXPECT_EQ(a.noise().pixel_scale, b.noise().pixel_scale);
  EXPECT_EQ(a.noise().disparity_scale, b.noise().disparity_scale);
  EXPECT_EQ(a.noise().own.freedom, b.noise().own.freedom);
  EXPECT_EQ(a.noise().own.scale, b.noise().own.scale);
  EXPECT_EQ(a.noise().disparities, b.noise().disparities);
  EXPECT_EQ(a.noise().pixels, b.noise().pixels);
  ASSERT_EQ(a.samples().size(), b.samples().size());
  for (std::size_t i = 0; i < a.samples().size(); ++i) expect_equal(a.samples()[i], b.samples()[i]);
}

void expect_equal(const SurveyLandmark& a, const SurveyLandmark& b) {
  EXPECT_EQ(a.observations, b.observations);
  EXPECT_EQ(a.point_in_world, b.point_in_world);
  EXPECT_EQ(a.cofactor, b.cofactor);
  EXPECT_EQ(a.squared_error_sum, b.squared_error_sum);
  EXPECT_EQ(a.redundancy, b.redundancy);
  EXPECT_EQ(a.variance_factor, b.variance_factor);
  expect_equal(a.information, b.information);
  EXPECT_EQ(a.image_covariance, b.image_covariance);
  EXPECT_EQ(a.pose_covariance, b.pose_covariance);
  expect_equal(a.indicators, b.indicators);
}

TEST_F(CheckpointTest, gives_the_state_back) {
  write();
  const auto checkpoint = read();
  ASSERT_TRUE(checkpoint.has_value());
  const SurveyState& found = checkpoint->state;
  EXPECT_EQ(found.next_in_sequence, state_.next_in_sequence);
  EXPECT_EQ(found.next_frame, state_.next_frame);
  EXPECT_EQ(found.next_landmark, state_.next_landmark);
  EXPECT_EQ(numbers_of(found.counts), numbers_of(state_.counts));
  EXPECT_EQ(found.variance.sums().count, state_.variance.sums().count);
  EXPECT_EQ(found.variance.sums().noise, state_.variance.sums().noise);
  EXPECT_EQ(found.variance.prior().freedom, state_.variance.prior().freedom);
  EXPECT_EQ(found.variance.prior().scale, state_.variance.prior().scale);
  expect_equal(found.noise, state_.noise);
  ASSERT_EQ(found.frames.size(), state_.frames.size());
  for (int i = 4; i < 9; ++i) expect_equal(found.frames[KeyframeId{i}], state_.frames[KeyframeId{i}]);
  ASSERT_EQ(found.tracks.size(), state_.tracks.size());
  for (std::size_t i = 0; i < found.tracks.size(); ++i) expect_equal(found.tracks[i], state_.tracks[i]);
  ASSERT_EQ(found.pending.size(), state_.pending.size());
  for (std::size_t i = 0; i < found.pending.size(); ++i) expect_equal(found.pending[i], state_.pending[i]);
}

TEST_F(CheckpointTest, gives_the_writers_state_back) {
  write();
  const auto checkpoint = read();
  ASSERT_TRUE(checkpoint.has_value());
  const MapWriterState before = writer_state();
  EXPECT_EQ(checkpoint->writer.append_files, before.append_files);
  EXPECT_EQ(checkpoint->writer.frames, before.frames);
  EXPECT_EQ(checkpoint->writer.landmarks, before.landmarks);
  EXPECT_EQ(checkpoint->writer.features, before.features);
  EXPECT_EQ(checkpoint->writer.observations, before.observations);
}

TEST_F(CheckpointTest, written_again_it_has_the_same_bytes) {
  write();
  const std::string bytes = read_file(file());
  const auto checkpoint = read();
  ASSERT_TRUE(checkpoint.has_value());
  write_checkpoint(folder_.path(), kIdentity, checkpoint->state, checkpoint->writer);
  EXPECT_EQ(read_file(file()), bytes);
  EXPECT_EQ(contents_of(folder_.path()).size(), 1U);
}

TEST_F(CheckpointTest, of_another_input_there_is_none) {
  write();
  EXPECT_FALSE(read(kIdentity + 1).has_value());
  EXPECT_TRUE(read().has_value());
}

TEST_F(CheckpointTest, damaged_it_is_none) {
  write();
  const std::string good = read_file(file());
  for (const std::size_t place : {std::size_t{3}, std::size_t{8}, good.size() / 2, good.size() - 2}) {
    std::string bytes = good;
    bytes[place] = static_cast<char>(bytes[place] ^ 16);
    write_file(file(), bytes);
    EXPECT_FALSE(read().has_value()) << place;
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{11}, good.size() / 2, good.size() - 1}) {
    write_file(file(), good.substr(0, length));
    EXPECT_FALSE(read().has_value()) << length;
  }
}

TEST_F(CheckpointTest, whose_images_are_gone_it_is_none) {
  write();
  const auto fail = [](std::vector<SurveyFrame>&) {
    throw InputError({"left.png", 0, "a readable file", "none", "Look."});
  };
  EXPECT_FALSE(read_checkpoint(folder_.path(), kIdentity, fail).has_value());
}

TEST_F(CheckpointTest, can_be_removed) {
  EXPECT_FALSE(has_checkpoint(folder_.path()));
  EXPECT_FALSE(read().has_value());
  write();
  EXPECT_TRUE(has_checkpoint(folder_.path()));
  remove_checkpoint(folder_.path());
  EXPECT_FALSE(has_checkpoint(folder_.path()));
  remove_checkpoint(folder_.path());
}

}  // namespace
}  // namespace cairn
