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

/// A file that is read piece by piece. InputError where it is missing, a folder or unreadable.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& path);

  /// Bytes of the whole file; 0 of what is no regular file.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// The next `count` bytes, or fewer where the file ends; returns how many.
  [[nodiscard]] std::size_t read(char* bytes, std::size_t count);
  /// The next byte read is this one.
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

/// The whole file. InputError where it is missing, a folder or unreadable.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// A file that appears under its name only when it is complete: written beside it and renamed by `commit`.
/// Destroyed before that, it leaves nothing. A link is followed. InputError where the disk is full, the
/// folder cannot be written, or the name is that of a folder or a device.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
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

/// InputError for a write to `path` that failed while `doing` ("create the file"), from an errno.
[[noreturn]] void fail_writing(const std::filesystem::path& path, std::string_view doing, int error_number);

/// A result folder that appears as a whole: everything is written into `work()`, beside the target, and
/// `commit` puts it in the target's place. Destroyed before that, the old folder (or none) is left as it was.
///
/// Refuses (InputError) a target that is a file, a non-empty folder that cairn did not write, and a folder of
/// another kind: a run must not replace the sequence that it was made from. Both are known by the marker file
/// `.cairn` inside.
///
/// A target that cannot be renamed (a mount point, the current folder, a folder in one that may not be
/// written) is filled in place: only there, a run that is killed within `commit` leaves a mixture.
class OutputFolder {
 public:
  /// `kind` is a noun for the marker and for messages: "sequence", "run", "map".
  explicit OutputFolder(const std::filesystem::path& target, std::string_view kind = "result");
  /// For work that goes on after a crash: `work()` is `<target>.unfinished`, holds what an earlier run has
  /// left there, and stays if `is_worth_keeping` when this is destroyed before `commit`. InputError where
  /// another run is at work in it.
  OutputFolder(const std::filesystem::path& target, std::string_view kind,
               std::function<bool(const std::filesystem::path& work)> is_worth_keeping);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& work() const { return work_; }
  /// As it was given.
  [[nodiscard]] const std::filesystem::path& target() const { return given_; }
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
