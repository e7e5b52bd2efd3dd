// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/spool.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

std::string read_all(Spool& spool) {
  std::string all;
  spool.read([&](std::string_view piece) { all += piece; });
  return all;
}

TEST(Spool, goes_on_from_its_state) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  SpoolState state;
  {
    Spool spool(path);
    spool.append("kept ");
    state = spool.sync();
    spool.append("lost in the crash");
  }
  Spool spool(path, state);
  spool.append("and more");
  EXPECT_EQ(read_all(spool), "kept and more");
  spool.append("!");  // also after reading
  EXPECT_EQ(read_all(spool), "kept and more!");
  EXPECT_EQ(spool.sync(), (SpoolState{14, crc32("kept and more!")}));
  EXPECT_EQ(read_file(path), "kept and more!");
}

TEST(Spool, hands_out_more_than_a_piece) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  Spool spool(path);
  std::string written;
  for (int i = 0; i < 300'000; ++i) {
    const std::string number = std::to_string(i);
    spool.append(number);
    written += number;
  }
  EXPECT_EQ(read_all(spool), written);
}

TEST(Spool, finds_what_was_changed_or_lost) {
  const testkit::TemporaryFolder folder;
  const std::filesystem::path path = folder / "spool";
  SpoolState state;
  {
    Spool spool(path);
    spool.append("ten bytes.");
    state = spool.sync();
  }
  write_file(path, "Ten bytes.");
  Spool changed(path, state);
  EXPECT_THROW(read_all(changed), InputError);
  write_file(path, "nine byte");
  EXPECT_THROW(Spool(path, state), InputError);
  std::filesystem::remove(path);
  EXPECT_THROW(Spool(path, state), InputError);
  EXPECT_THROW(Spool(path / "no" / "folder"), InputError);
}

}  // namespace
}  // namespace cairn
