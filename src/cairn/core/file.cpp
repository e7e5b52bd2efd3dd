// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "cairn/core/error.h"

namespace cairn {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMarker = ".cairn";

std::string remedy_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "Free some space, or write to another disk.";
    case EACCES:
    case EROFS:
    case EPERM:
      return "Write to a folder that you may write to.";
    case ENOENT:
      return "Make the folder first.";
    default:
      return "Check the path and the disk.";
  }
}

[[noreturn]] void fail_writing(const fs::path& path, std::string_view doing, int error_number) {
  throw InputError(
      {path.string(), 0, fmt::format("to {}", doing), std::strerror(error_number), remedy_for(error_number)});
}

void rename_or_fail(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) fail_writing(to, "put the finished result in place", error.value());
}

}  // namespace

std::string read_file(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    throw InputError({path.string(), 0, "a file", "a folder", "Name the file inside it."});
  }
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) {
    throw InputError(
        {path.string(), 0, "a readable file", std::strerror(errno), "Check the path and its permissions."});
  }
  std::string contents;
  const auto size = fs::file_size(path, error);
  if (!error) contents.reserve(size);
  char buffer[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(buffer, 1, sizeof buffer, file)) > 0) contents.append(buffer, got);
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) throw InputError({path.string(), 0, "a readable file", "a read error", "Check the disk."});
  return contents;
}

fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> counter = 0;  // several files of one process at once
  fs::path name = path.has_filename() ? path : path.parent_path();
  name += fmt::format(".partial-{}-{}", ::getpid(), counter++);
  return name;
}

void commit_file(const fs::path& temporary, const fs::path& path) {
  rename_or_fail(temporary, path);
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), temporary_(temporary_beside(path_)) {
  std::error_code error;
  if (fs::is_directory(path_, error)) fail_writing(path_, "write a file of this name", EISDIR);
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr) fail("create the file");
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::fail(std::string_view doing) const {
  fail_writing(path_, doing, errno);
}

void AtomicFile::write(std::string_view bytes) {
  require(file_ != nullptr, "an AtomicFile is written before it is committed");
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write the file");
}

void AtomicFile::commit() {
  require(file_ != nullptr, "an AtomicFile is committed once");
  const bool flushed = std::fflush(file_) == 0;
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!flushed || !closed) fail("write the file");
  rename_or_fail(temporary_, path_);
  temporary_.clear();
}

void write_file(const fs::path& path, std::string_view contents) {
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

OutputFolder::OutputFolder(const fs::path& target) : target_(target) {
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!fs::is_directory(target_, error)) {
      throw InputError(
          {target_.string(), 0, "a folder to write to", "a file of that name", "Choose another -o."});
    }
    if (!fs::is_empty(target_, error) && !fs::exists(target_ / kMarker, error)) {
      throw InputError({target_.string(), 0, "a new or empty folder, or one that cairn wrote",
                        "a folder with other contents", "Choose another -o; nothing in it was touched."});
    }
  }
  work_ = temporary_beside(target_);
  fs::create_directories(work_, error);
  if (error) fail_writing(target_, "create the folder", error.value());
  write_file(work_ / kMarker, "written by cairn; a later run may replace this folder\n");
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!work_.empty()) fs::remove_all(work_, ignored);
}

void OutputFolder::commit() {
  require(!work_.empty(), "an OutputFolder is committed once");
  std::error_code error;
  fs::path old;
  if (fs::exists(target_, error)) {
    old = temporary_beside(target_);
    rename_or_fail(target_, old);
  }
  rename_or_fail(work_, target_);
  work_.clear();
  if (!old.empty()) fs::remove_all(old, error);
}

}  // namespace cairn
