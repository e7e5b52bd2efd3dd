// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/append_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

std::string read_all(AppendFile& append_file) {
  std::string all;
  append_file.read([&](std::string_view piece) { all += piece; });
  return all;
}

TEST(AppendFile, goes_on_from_its_state) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  AppendFileState state;
  {
    AppendFile append_file(path);
    append_file.append("kept ");
    state = append_file.sync();
    append_file.append("lost in the crash");
  }
  AppendFile append_file(path, state);
  append_file.append("and more");
  EXPECT_EQ(read_all(append_file), "kept and more");
  append_file.append("!");  // also after reading
  EXPECT_EQ(read_all(append_file), "kept and more!");
  EXPECT_EQ(append_file.sync(), (AppendFileState{14, crc32("kept and more!")}));
  EXPECT_EQ(read_file(path), "kept and more!");
}

TEST(AppendFile, hands_out_more_than_a_piece) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  AppendFile append_file(path);
  std::string written;
  for (int i = 0; i < 300'000; ++i) {
    const std::string number = std::to_string(i);
    append_file.append(number);
    written += number;
  }
  EXPECT_EQ(read_all(append_file), written);
}

TEST(AppendFile, finds_what_was_changed_or_lost) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  AppendFileState state;
  {
    AppendFile append_file(path);
    append_file.append("ten bytes.");
    state = append_file.sync();
  }
  write_file(path, "Ten bytes.");
  AppendFile changed(path, state);
  EXPECT_THROW(read_all(changed), InputError);
  write_file(path, "nine byte");
  EXPECT_THROW(AppendFile(path, state), InputError);
  std::filesystem::remove(path);
  EXPECT_THROW(AppendFile(path, state), InputError);
  EXPECT_THROW(AppendFile(path / "no" / "folder"), InputError);
}

}  // namespace
}  // namespace cairn
