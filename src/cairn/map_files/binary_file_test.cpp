// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/binary_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

using testkit::TemporaryFolder;

constexpr BinaryKind kKind{"TESTFILE", 3};

/// All bytes after the version, asked for in steps that fit no block.
std::string read_all(const std::filesystem::path& path, std::size_t bytes) {
  BinaryReader reader(path, kKind);
  std::string all;
  for (std::size_t step = 1; all.size() < bytes; step = 3 * step + 1) {
    const std::size_t count = std::min(step, bytes - all.size());
    all.append(reader.get_bytes(count), count);
  }
  reader.expect_bytes(0, 1);
  return all;
}

BinaryWriter writer_of(std::size_t bytes) {
  BinaryWriter writer(kKind);
  for (std::size_t i = 12; i < bytes; ++i) writer.put(static_cast<std::uint8_t>(i * i + i / 251));
  return writer;
}

TEST(BinaryFile, the_seal_has_a_checksum_for_each_block) {
  for (const std::size_t bytes : {12UL, 4095UL, 4096UL, 4097UL, 3 * 4096UL, 3 * 4096UL + 1, 20000UL}) {
    const std::string file = writer_of(bytes).finish();
    const std::size_t blocks = (bytes + 4095) / 4096;
    ASSERT_EQ(file.size(), bytes + 4 * blocks + 4);
    EXPECT_EQ(sealed_bytes(file.size()), bytes);
    for (std::size_t block = 0; block < blocks; ++block) {
      std::uint32_t checksum = 0;
      std::memcpy(&checksum, file.data() + bytes + 4 * block, 4);
      EXPECT_EQ(checksum, crc32(std::string_view(file).substr(0, bytes).substr(block * 4096, 4096)));
    }
    EXPECT_EQ(stored_checksum(file), crc32(std::string_view(file).substr(bytes, 4 * blocks)));
  }
}

TEST(BinaryFile, no_other_size_is_a_files) {
  std::size_t possible = 0;
  for (std::uint64_t body = 0; body < 20000; ++body) {
    const std::uint64_t size = body + 4 * ((body + 4095) / 4096) + 4;
    EXPECT_EQ(sealed_bytes(size), body);
  }
  for (std::uint64_t size = 0; size < 20000; ++size) possible += sealed_bytes(size) ? 1 : 0;
  EXPECT_EQ(possible, 20000U - 4 - 4 * 5);  // nothing below 4, and 4 bytes for each block begun
}

TEST(BinaryFile, the_file_that_is_written_in_pieces_is_the_same) {
  const TemporaryFolder folder;
  const std::string whole = writer_of(10000).finish();
  const std::string_view body = std::string_view(whole).substr(0, 10000);
  BinaryFileWriter file(folder.path() / "file", writer_of(40));
  for (std::size_t i = 40, step = 1; i < body.size(); i += step, step = 2 * step + 1)
    file.write(body.substr(i, step));
  EXPECT_EQ(file.finish(), stored_checksum(whole));
  EXPECT_EQ(read_file(folder.path() / "file"), whole);
}

TEST(BinaryFile, is_read_in_pieces_larger_and_smaller_than_what_is_checked_at_once) {
  const TemporaryFolder folder;
  const std::size_t bytes = 700'001;
  const std::string whole = writer_of(bytes).finish();
  write_file(folder.path() / "file", whole);
  EXPECT_EQ(read_all(folder.path() / "file", bytes - 12), whole.substr(12, bytes - 12));
}

TEST(BinaryFile, hands_out_nothing_of_a_damaged_block) {
  const TemporaryFolder folder;
  std::string changed = writer_of(600'000).finish();
  changed[500'000] ^= 1;
  write_file(folder.path() / "file", changed);
  BinaryReader reader(folder.path() / "file", kKind);
  EXPECT_EQ(*reader.get_bytes(1), changed[12]);
  EXPECT_THROW((void)reader.get_bytes(500'000), InputError);
}

TEST(BinaryFile, finds_what_was_changed_and_names_old_versions) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "file";
  const std::string whole = writer_of(9000).finish();
  for (const std::size_t place : {20UL, 4100UL, 8999UL, 9000UL, whole.size() - 1}) {
    std::string changed = whole;
    changed[place] ^= 1;
    write_file(path, changed);
    EXPECT_THROW((void)read_all(path, 9000 - 12), InputError) << place;
  }
  write_file(path, whole);
  EXPECT_EQ(read_all(path, 9000 - 12), whole.substr(12, 9000 - 12));
  try {
    BinaryReader(path, {"TESTFILE", 4});
    FAIL() << "read another version";
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().found, "version 3");
    EXPECT_EQ(error.details().remedy, kVersionRemedy);
  }
}

}  // namespace
}  // namespace cairn
