// SPDX-License-Identifier: Apache-2.0
#include "cairn/calibrate/depth_shift.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

Calibration rgbd() {
  Calibration calibration;
  calibration.camera = {CameraModel::pinhole, 640, 480, 525, 525, 320, 240, {}};
  calibration.depth.emplace().scale = 1000;
  return calibration;
}

TEST(MoveDepth, registered_depth_gets_a_camera_with_another_principal_point) {
  Calibration calibration = rgbd();
  move_depth({4, -3}, calibration);
  ASSERT_TRUE(calibration.depth->camera);
  EXPECT_EQ(calibration.depth->camera->cx, 316);
  EXPECT_EQ(calibration.depth->camera->cy, 243);
  EXPECT_EQ(calibration.camera.cx, 320);
}

TEST(MoveDepth, shifts_are_in_pixels_of_the_colour_image) {
  Calibration calibration = rgbd();
  calibration.depth->camera = Camera{CameraModel::pinhole, 320, 240, 262.5, 262.5, 160, 120, {}};
  move_depth({4, -2}, calibration);
  EXPECT_EQ(calibration.depth->camera->cx, 158);
  EXPECT_EQ(calibration.depth->camera->cy, 121);
}

TEST(MeasureDepthShift, a_run_that_shows_nothing_determines_nothing) {
  Sequence sequence;
  sequence.calibration = rgbd();
  SlamResult slam;
  MapHeader header;
  header.rig = {525, 525, 320, 240, 0.075};
  slam.map = Map(header);
  const DepthShift found = measure_depth_shift(sequence, slam, Executor(1));
  EXPECT_EQ(found.readings, 0);
  for (const Quantity& quantity : quantities_of(found)) {
    EXPECT_EQ(quantity.finding, Finding::undetermined);
    EXPECT_EQ(quantity.why, "0 observations of known points with a smooth depth are too few");
  }
}

}  // namespace
}  // namespace cairn
