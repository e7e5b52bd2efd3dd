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

/// The file that a link leads to, so that the link stays and what it leads to is replaced.
fs::path without_link(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path destination = fs::weakly_canonical(path, error);
  return error ? path : destination;
}

void require_regular_or_absent(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (type == fs::file_type::directory)
    throw InputError({path.string(), 0, "the name of a file to write", "a folder", "Name a file inside it."});
  if (type != fs::file_type::regular && type != fs::file_type::not_found && type != fs::file_type::none)
    throw InputError(
        {path.string(), 0, "the name of a file to write", "a device or pipe", "Name a file on a disk."});
}

}  // namespace

void fail_writing(const fs::path& path, std::string_view doing, int error_number) {
  throw InputError(
      {path.string(), 0, fmt::format("to {}", doing), std::strerror(error_number), remedy_for(error_number)});
}

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
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) fail_writing(path, "put the finished result in place", error.value());
}

AtomicFile::AtomicFile(const fs::path& path)
    : path_(without_link(path)), temporary_(temporary_beside(path_)) {
  require_regular_or_absent(path_);
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
  commit_file(temporary_, path_);
  temporary_.clear();
}

void write_file(const fs::path& path, std::string_view contents) {
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

}  // namespace cairn
