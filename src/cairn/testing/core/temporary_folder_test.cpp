// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/core/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

namespace cairn::testkit {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, is_empty_and_its_own) {
  const TemporaryFolder a, b;
  EXPECT_NE(a.path(), b.path());
  EXPECT_TRUE(fs::is_directory(a.path()));
  EXPECT_TRUE(fs::is_empty(a.path()));
  EXPECT_EQ(a.path(), fs::canonical(a.path()));
}

TEST(TemporaryFolder, is_gone_with_its_files_afterwards) {
  fs::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    folder.write("deep/down/file.txt", "text");
    ASSERT_TRUE(fs::exists(path));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, reads_what_it_wrote) {
  const TemporaryFolder folder;
  EXPECT_EQ(folder.write("deep/file.txt", "one\ntwo"), folder / "deep/file.txt");
  folder.write("empty", "");
  EXPECT_EQ(folder.read("deep/file.txt"), "one\ntwo");
  EXPECT_EQ(contents_of(folder.path()),
            (std::map<std::string, std::string>{{"deep/file.txt", "one\ntwo"}, {"empty", ""}}));
}

TEST(TemporaryFolder, stays_when_it_is_cleared) {
  const TemporaryFolder folder;
  folder.write("deep/file.txt", "text");
  folder.clear();
  EXPECT_TRUE(fs::is_directory(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace cairn::testkit
