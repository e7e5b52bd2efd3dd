// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/image_pair.h"

#include <gtest/gtest.h>

#include "cairn/core/error.h"
#include "cairn/core/id.h"
#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::kSmallCamera;
using testkit::RecordingFolder;

class ImagePairTest : public testing::Test, protected RecordingFolder {
 protected:
  ImagePairTest() {
    put_color("a.png");
    put_depth("b.png", 2000);
  }
};

TEST_F(ImagePairTest, is_a_sequence_of_one_frame) {
  const Sequence sequence = open_image_pair(folder_ / "a.png", folder_ / "b.png", "10,10,3.5,2.5,1000");
  ASSERT_EQ(sequence.frames.size(), 1U);
  EXPECT_EQ(sequence.calibration.camera.width, 8);
  EXPECT_EQ(sequence.calibration.camera.height, 6);
  const FrameLoader loader(sequence);
  EXPECT_FLOAT_EQ(loader.load_depth(FrameId{0})(3, 2), 2.0F);
  EXPECT_EQ(open_image_pair(folder_ / "a.png", folder_ / "b.png", write("c.yaml", kSmallCamera))
                .calibration.camera.cx,
            3.5);
}

TEST_F(ImagePairTest, needs_the_scale_of_its_depth_and_an_image) {
  EXPECT_THROW((void)open_image_pair(folder_ / "a.png", folder_ / "b.png", "10,10,3.5,2.5"), InputError);
  EXPECT_THROW((void)open_image_pair(folder_ / "none.png", folder_ / "b.png", "10,10,3.5,2.5,1000"),
               InputError);
}

}  // namespace
}  // namespace cairn
