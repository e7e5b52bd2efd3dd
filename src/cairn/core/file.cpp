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

FileReader::FileReader(const fs::path& path) : path_(path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw InputError({path.string(), 0, "a file", "a folder", "Name the file inside it."});
  file_.reset(std::fopen(path.c_str(), "rb"));
  if (!file_) fail(std::strerror(errno), "Check the path and its permissions.");
  const auto size = fs::file_size(path, error);
  if (!error) size_ = size;
}

void FileReader::fail(std::string found, std::string remedy) const {
  throw InputError({path_.string(), 0, "a readable file", std::move(found), std::move(remedy)});
}

std::size_t FileReader::read(char* bytes, std::size_t count) {
  const std::size_t got = std::fread(bytes, 1, count, file_.get());
  if (std::ferror(file_.get()) != 0) fail("a read error", "Check the disk.");
  return got;
}

void FileReader::seek(std::uint64_t position) {
  if (::fseeko(file_.get(), static_cast<off_t>(position), SEEK_SET) != 0)
    fail(std::strerror(errno), "Check the disk.");
}

std::string read_file(const fs::path& path) {
  FileReader file(path);
  std::string contents;
  contents.reserve(file.size());
  char buffer[1 << 16];
  while (const std::size_t got = file.read(buffer, sizeof buffer)) contents.append(buffer, got);
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
  if (bytes.empty()) return;
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
