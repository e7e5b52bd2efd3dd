// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/parameter_file.h"

#include <gtest/gtest.h>

#include "cairn/testing/image/recording_folder.h"

namespace cairn {
namespace {

using testkit::RecordingFolder;

class ParameterFileTest : public testing::Test, protected RecordingFolder {
 protected:
  ParameterFileTest() {
    table_.parameter({"voxel_grid", above(0, "metres"), "Size.", "grid"}, size_);
    table_.retired({"visualize_pointcloud", "", "clouds are written"});
  }
  [[nodiscard]] ParameterFileSearch search(const std::string& text) const {
    put("parameters.txt", text);
    return find_parameters(folder_, table_);
  }

  double size_ = 0;
  SettingTable table_;
};

TEST_F(ParameterFileTest, is_taken_if_all_its_names_are_known) {
  EXPECT_TRUE(find_parameters(folder_, table_).path.empty());
  const ParameterFileSearch found = search("# size\ngrid=0.02;\nvisualize_pointcloud=yes\n");
  EXPECT_EQ(found.path, folder_ / "parameters.txt");
  EXPECT_TRUE(found.is_taken);
}

TEST_F(ParameterFileTest, of_another_program_is_not_taken) {
  EXPECT_EQ(search("voxel_grid=1\nlearning_rate=3\n").reason, "'learning_rate' in line 2 is no parameter");
  EXPECT_EQ(search("epochs 100\n").reason, "its lines are not all key=value; --config says which one");
  EXPECT_EQ(search("# nothing\n").reason, "it sets nothing");
  EXPECT_FALSE(search("epochs: 100\n").is_taken);
}

}  // namespace
}  // namespace cairn
