// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/row_errors.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cairn/image/codec.h"
#include "cairn/image/remap.h"
#include "cairn/testing/image/recording_folder.h"
#include "cairn/testing/image/textured_pair.h"

namespace cairn {
namespace {

constexpr int kWidth = 480, kHeight = 300;
const Rig kRig{400, 400, 240, 150, 0.5};

class RowErrorsTest : public testing::Test, protected testkit::RecordingFolder {
 protected:
  /// Writes pairs whose right images have their rows moved by a field.
  [[nodiscard]] Sequence pairs_with(const RowField& field, int pairs = 4) const {
    Sequence sequence;
    sequence.folder = folder_;
    sequence.calibration.camera = {
        CameraModel::pinhole, kWidth, kHeight, kRig.fx, kRig.fy, kRig.cx, kRig.cy, {}};
    sequence.calibration.baseline = kRig.baseline;
    for (int i = 0; i < pairs; ++i) {
      const testkit::Waves waves(8, 40, static_cast<std::uint64_t>(i));
      testkit::TestPair pair = testkit::make_pair(kWidth, kHeight, {12, 0.01, 0.02}, waves, 1, 1);
      const ImageRemap moved({kWidth, kHeight}, {kWidth, kHeight}, [&](const Eigen::Vector2d& pixel) {
        const double error = field.dot(row_field_basis(kRig, pixel.x(), pixel.y()));
        return std::optional<Eigen::Vector2d>({pixel.x(), pixel.y() + error});
      });
      const auto left = folder_ / fmt::format("l{}.png", i), right = folder_ / fmt::format("r{}.png", i);
      write_png(left, pair.left);
      write_png(right, moved(pair.right));
      sequence.frames.push_back({i, i, left, {}, right});
    }
    return sequence;
  }
};

const RowField kTurned = (RowField() << 0.6, 0.3, 0.2, -2.0, 0.3, 0.6).finished();

TEST_F(RowErrorsTest, a_planted_field_is_found) {
  const RowErrors errors = measure_row_errors(pairs_with(kTurned), Executor(2));
  EXPECT_EQ(errors.pairs, 4);
  EXPECT_GT(errors.matches, 400);
  EXPECT_TRUE(errors.should_be_applied());
  EXPECT_NEAR(errors.field[0], 0.6, 0.03);
  EXPECT_NEAR(errors.field[3], -2.0, 0.15);
  EXPECT_GT(errors.rms_px, 0.4);
  EXPECT_LT(errors.scatter_px, 0.1);
}

TEST_F(RowErrorsTest, nothing_is_left_where_the_loader_takes_it_off) {
  Sequence sequence = pairs_with(kTurned);
  sequence.calibration.right_correction.emplace().rows = measure_row_errors(sequence, Executor()).field;
  const RowErrors left = measure_row_errors(sequence, Executor());
  EXPECT_LT(left.rms_px, 0.03);
  EXPECT_FALSE(left.should_be_applied());
}

TEST_F(RowErrorsTest, nothing_is_left_of_a_raw_pair_either) {
  Sequence sequence = pairs_with(kTurned);
  const Camera camera = sequence.calibration.camera;
  const LeftFromRight left_from_right(Rigid3{Eigen::Quaterniond::Identity(), {kRig.baseline, 0, 0}});
  set_raw_stereo({camera, camera, left_from_right}, {}, sequence.calibration);
  const RowErrors errors = measure_row_errors(sequence, Executor());
  EXPECT_TRUE(errors.should_be_applied());
  EXPECT_GT(errors.rms_px, 0.4);
  sequence.calibration.right_correction.emplace().rows = errors.field;
  EXPECT_LT(measure_row_errors(sequence, Executor()).rms_px, 0.04);
}

TEST_F(RowErrorsTest, a_stated_correction_is_kept) {
  Sequence sequence = pairs_with(kTurned);
  sequence.calibration.right_correction.emplace().disparity = {1, 2, 3};
  const AlignedRows aligned = align_rows(sequence, "auto", Executor());
  EXPECT_FALSE(aligned.applied);
  EXPECT_EQ(aligned.errors.pairs, 0);
  EXPECT_EQ(aligned.sequence.calibration.right_correction->disparity, DisparityField(1, 2, 3));
}

TEST_F(RowErrorsTest, rows_are_aligned_only_where_that_is_wanted) {
  const Sequence sequence = pairs_with(kTurned);
  const AlignedRows corrected = align_rows(sequence, "auto", Executor()),
                    reported = align_rows(sequence, "report", Executor()),
                    off = align_rows(sequence, "off", Executor());
  EXPECT_TRUE(corrected.applied);
  EXPECT_EQ(corrected.sequence.calibration.right_correction->rows, corrected.errors.field);
  EXPECT_FALSE(reported.applied);
  EXPECT_EQ(reported.errors.field, corrected.errors.field);
  EXPECT_FALSE(reported.sequence.calibration.right_correction);
  EXPECT_EQ(off.errors.pairs, 0);
}

TEST_F(RowErrorsTest, rectified_pairs_need_nothing) {
  const RowErrors errors = measure_row_errors(pairs_with(RowField::Zero()), Executor());
  EXPECT_TRUE(errors.is_determined());
  EXPECT_LT(errors.rms_px, 0.03);
  EXPECT_FALSE(errors.should_be_applied());
}

TEST_F(RowErrorsTest, one_pair_determines_nothing) {
  EXPECT_FALSE(measure_row_errors(pairs_with(kTurned, 1), Executor()).is_determined());
}

TEST_F(RowErrorsTest, the_same_bits_at_any_number_of_threads) {
  const Sequence sequence = pairs_with(kTurned);
  const RowErrors one = measure_row_errors(sequence, Executor(1)),
                  three = measure_row_errors(sequence, Executor(3));
  EXPECT_EQ(one.field, three.field);
  EXPECT_EQ(one.halves_differ_px, three.halves_differ_px);
}

TEST_F(RowErrorsTest, a_sequence_without_right_images_has_none) {
  Sequence sequence = pairs_with(kTurned);
  for (FrameFiles& files : sequence.frames) files.right.clear();
  EXPECT_EQ(measure_row_errors(sequence, Executor()).pairs, 0);
}

}  // namespace
}  // namespace cairn
