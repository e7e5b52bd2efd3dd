// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Reads a file piece by piece. Throws InputError if it is missing, a folder or unreadable.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& path);

  /// Returns the size of the whole file in bytes; 0 if it is not a regular file.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Reads the next `count` bytes, or fewer at the end of the file; returns their number.
  [[nodiscard]] std::size_t read(char* bytes, std::size_t count);
  /// Sets the position of the next byte to be read.
  void seek(std::uint64_t position);

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  [[noreturn]] void fail(std::string found, std::string remedy) const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
};

/// Reads the whole file. Throws InputError if it is missing, a folder or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Writes a file that appears under its name only when it is complete: it is written beside it and renamed by
/// `commit`. Leaves nothing if destroyed before that. Follows a link. Throws InputError if the disk is full,
/// the folder cannot be written, or the name is that of a folder or a device.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  /// Completes the file under its name.
  void commit();

 private:
  [[noreturn]] void fail(std::string_view doing) const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::FILE* file_ = nullptr;
};

/// Writes contents that are in memory as an AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view contents);

/// Returns a path that does not exist yet, in the folder of `path`, for a library that writes a file by name.
/// Rename it to `path` by `commit_file` when it is complete.
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& path);
/// Renames a complete file from temporary_beside to `path`.
void commit_file(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Throws InputError for a write to `path` that failed while `doing` ("create the file"), from an errno.
[[noreturn]] void fail_writing(const std::filesystem::path& path, std::string_view doing, int error_number);

/// Makes a result folder that appears as a whole: everything is written into `work()`, beside the target, and
/// `commit` moves it to the target. If destroyed before that, the old folder (or none) is left unchanged.
///
/// Throws InputError if the target is a file, a non-empty folder that cairn did not write, or a folder of
/// another kind: a run must not replace the sequence that it was made from. Both are recognised by the marker
/// file `.cairn` inside.
///
/// A target that cannot be renamed (a mount point, the current folder, a folder in one that may not be
/// written) is filled in place: only there, a run that is killed within `commit` leaves a mixture.
class OutputFolder {
 public:
  /// Prepares the work folder. `kind` is a noun for the marker and for messages: "sequence", "run", "map".
  explicit OutputFolder(const std::filesystem::path& target, std::string_view kind = "result");
  /// Prepares work that is resumed after a crash: `work()` is `<target>.unfinished`, holds what an earlier
  /// run has left there, and stays if `is_worth_keeping` when this is destroyed before `commit`. Throws
  /// InputError if another run uses it.
  OutputFolder(const std::filesystem::path& target, std::string_view kind,
               std::function<bool(const std::filesystem::path& work)> is_worth_keeping);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& work() const { return work_; }
  /// Returns the target as it was given.
  [[nodiscard]] const std::filesystem::path& target() const { return given_; }
  /// Moves the work folder to the target.
  void commit();

 private:
  void prepare(const std::filesystem::path& work, std::string_view kind);
  void lock();
  void replace_target();
  void fill_target();

  std::filesystem::path given_;
  std::filesystem::path target_;  // absolute, without links
  std::filesystem::path work_;
  std::vector<std::filesystem::path> made_parents_;  // innermost first
  bool in_place_ = false;
  std::function<bool(const std::filesystem::path&)> is_worth_keeping_;
  int lock_ = -1;  // of the work folder, which only one run may use
};

}  // namespace cairn
