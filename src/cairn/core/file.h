// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace cairn {

/// The whole file. InputError where it is missing, a folder or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// A file that appears under its name only when it is complete: written beside it and renamed by `commit`.
/// Destroyed before that, it leaves nothing. InputError where the disk is full or the folder cannot be
/// written.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void commit();

 private:
  [[noreturn]] void fail(std::string_view doing) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

/// AtomicFile for contents that are in memory already.
void write_file(const std::filesystem::path& path, std::string_view contents);

/// A path that does not exist yet, in the folder of `path`, for a file written by a library that wants a
/// name. Rename it to `path` with `commit_file` when it is complete.
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& path);
void commit_file(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// A result folder that appears as a whole: everything is written into `work()`, beside the target, and
/// `commit` puts it in the target's place. Destroyed before that, the old folder (or none) is left as it was.
/// Refuses (InputError) a target that is a file, or a non-empty folder that cairn did not write, which it
/// knows by the marker file `.cairn` inside.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& target);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& work() const { return work_; }
  [[nodiscard]] const std::filesystem::path& target() const { return target_; }
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path work_;
};

}  // namespace cairn
