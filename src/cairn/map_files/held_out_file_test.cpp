// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/held_out_file.h"

#include <gtest/gtest.h>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

std::vector<HeldOutFrame> some_frames() {
  HeldOutFrame frame{{3}, Vector6d::LinSpaced(-0.3, 0.2), Vector6d::LinSpaced(1, 0.1), {}, {}};
  frame.formal.setConstant(1e-7 / 3);
  frame.stated.setZero();
  HeldOutFrame other = frame;
  other.keyframe = {8};
  other.stated.setConstant(0.0025);
  return {frame, other};
}

class HeldOutFile : public testing::Test {
 protected:
  std::vector<HeldOutFrame> read(const std::string& text) {
    write_file(folder_.path() / kHeldOutFile, text);
    MapInfo info;
    info.keyframes.resize(9);
    info.checksums[kHeldOutFile] = crc32(text);
    return read_held_out(folder_.path(), info);
  }
  testkit::TemporaryFolder folder_;
};

TEST_F(HeldOutFile, gives_back_what_was_written) {
  const auto written = some_frames();
  const auto read = this->read(format_held_out(written));
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].keyframe, written[i].keyframe);
    EXPECT_EQ(read[i].to_map, written[i].to_map);
    EXPECT_EQ(read[i].to_given, written[i].to_given);
    EXPECT_EQ(read[i].formal, written[i].formal);
    EXPECT_EQ(read[i].stated, written[i].stated);
  }
}

TEST_F(HeldOutFile, is_empty_of_a_map_without_one) {
  EXPECT_TRUE(read_held_out(folder_.path(), {}).empty());
}

TEST_F(HeldOutFile, refuses_what_is_no_such_frame) {
  auto frames = some_frames();
  frames[1].keyframe = {9};
  EXPECT_THROW((void)read(format_held_out(frames)), InputError);
  frames = some_frames();
  frames[0].formal[2] = -1;
  EXPECT_THROW((void)read(format_held_out(frames)), InputError);
  EXPECT_THROW((void)read("3 0 0\n"), InputError);
}

}  // namespace
}  // namespace cairn
