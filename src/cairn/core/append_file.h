// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string_view>

#include "cairn/core/checksum.h"

namespace cairn {

/// Describes the state of an AppendFile.
struct AppendFileState {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;  ///< CRC-32 of the bytes
  bool operator==(const AppendFileState&) const = default;
};

/// Appends to a file that, after a crash, is resumed from its last recorded state. Throws InputError if the
/// disk fails.
class AppendFile {
 public:
  /// Begins a new file; an existing file of that name is emptied.
  explicit AppendFile(const std::filesystem::path& path);
  /// Resumes after `state`; what was appended later is cut off. Throws InputError if the file is shorter.
  AppendFile(const std::filesystem::path& path, const AppendFileState& state);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view bytes);
  /// Returns the state once everything appended is on the disk, safe against a power failure.
  [[nodiscard]] AppendFileState sync();
  /// Passes all that was appended to `take`, in order and in pieces. Throws InputError at the end if the file
  /// has changed meanwhile.
  void read(const std::function<void(std::string_view piece)>& take);

 private:
  void flush();
  [[noreturn]] void fail(std::string_view doing) const;

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::uint64_t bytes_ = 0;
  Crc32 checksum_;
};

/// Returns once the file or folder is on the disk. Throws InputError if the disk fails.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace cairn
