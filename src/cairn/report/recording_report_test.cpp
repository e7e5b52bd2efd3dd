// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/recording_report.h"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(SimulationReport, tells_frames_path_and_folder) {
  SimulationSummary summary{{12, 3.25, 0.5, false}, "demo/room", 7, "cairn info demo/room"};
  EXPECT_EQ(format_simulation_text(summary),
            "frames       12 over 0.50 s\npath         3.250 m\nwritten to   demo/room\n"
            "next         cairn info demo/room\n");
  summary.report.stopped = true;
  EXPECT_EQ(format_simulation_text(summary).find("frames       12 over 0.50 s, stopped before the end\n"),
            0U);
  EXPECT_EQ(format_simulation_json(summary),
            "{\n  \"frames\": 12,\n  \"duration_s\": 0.5,\n  \"path_m\": 3.25,\n  \"seed\": 7,\n"
            "  \"stopped\": true,\n  \"folder\": \"demo/room\"\n}\n");
}

TEST(RectifiedReport, tells_whether_there_are_poses) {
  EXPECT_EQ(format_rectified_text({5, 0, true, false}, "out"),
            "frames       5\nposes        of every frame\nwritten to   out\n");
  EXPECT_EQ(format_rectified_text({5, 2, false, true}, "out"),
            "frames       5, stopped before the end\nunreadable   2 frames, skipped\n"
            "poses        none: not every frame has a true one\nwritten to   out\n");
  EXPECT_EQ(format_rectified_json({5, 2, false, true}, "out"),
            "{\n  \"frames\": 5,\n  \"unreadable\": 2,\n  \"poses\": false,\n  \"stopped\": true,\n"
            "  \"folder\": \"out\"\n}\n");
}

}  // namespace
}  // namespace cairn
