// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

#include "cairn/core/checksum.h"

namespace cairn {

/// How far a AppendFile had come.
struct AppendFileState {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;  ///< CRC-32 of them
  bool operator==(const AppendFileState&) const = default;
};

/// A file that grows at its end and, after a crash, goes on from where its state was last taken. InputError
/// where the disk does not do as it should.
class AppendFile {
 public:
  /// Begins anew; a file of that name is emptied.
  explicit AppendFile(const std::filesystem::path& path);
  /// Goes on after `state`; what was appended later is cut off. InputError where the file is shorter.
  AppendFile(const std::filesystem::path& path, const AppendFileState& state);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view bytes);
  /// Returns when everything that was appended is on the disk, also should the power fail.
  [[nodiscard]] AppendFileState sync();
  /// Hands out all that was appended, in order and in pieces. InputError at the end where the file holds
  /// something else by now.
  void read(const std::function<void(std::string_view piece)>& take);

 private:
  void flush();
  [[noreturn]] void fail(std::string_view doing) const;

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
  Crc32 checksum_;
};

/// Returns when the file or folder is on the disk. InputError where the disk fails.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace cairn
