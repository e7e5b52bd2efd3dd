// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "Begin anew: what was there was changed or lost.";

std::uint64_t size_of(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return error ? 0 : size;
}

void cut(const fs::path& path, const AppendFileState& state) {
  if (const std::uint64_t found = size_of(path); found < state.bytes)
    throw InputError({path.string(), 0, fmt::format("at least {} bytes to go on from", state.bytes),
                      fmt::format("{}", found), kRemedy});
  std::error_code error;
  fs::resize_file(path, state.bytes, error);
  if (error) fail_writing(path, "cut the file", error.value());
}

}  // namespace

AppendFile::AppendFile(const fs::path& path) : path_(path), file_(std::fopen(path.c_str(), "w+b")) {
  if (file_ == nullptr) fail("create the file");
}

AppendFile::AppendFile(const fs::path& path, const AppendFileState& state)
    : path_(path), bytes_(state.bytes), checksum_(state.checksum) {
  cut(path, state);
  file_ = std::fopen(path.c_str(), "a+b");
  if (file_ == nullptr) fail("open the file");
}

AppendFile::~AppendFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void AppendFile::fail(std::string_view doing) const {
  fail_writing(path_, doing, errno);
}

void AppendFile::append(std::string_view bytes) {
  if (bytes.empty()) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("write the file");
  bytes_ += bytes.size();
  checksum_.add(bytes);
}

void AppendFile::flush() {
  if (std::fflush(file_) != 0) fail("write the file");
}

AppendFileState AppendFile::sync() {
  flush();
  if (::fdatasync(::fileno(file_)) != 0) fail("write the file");
  return {bytes_, checksum_.value()};
}

void AppendFile::read(const std::function<void(std::string_view piece)>& take) {
  flush();
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::vector<char> piece(kPiece);
  Crc32 found;
  std::uint64_t place = 0;
  while (place < bytes_) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, bytes_ - place));
    const ssize_t got = ::pread(::fileno(file_), piece.data(), wanted, static_cast<off_t>(place));
    if (got < 0) fail("read the file");
    if (got == 0) break;
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(got));
    found.add(bytes);
    take(bytes);
    place += bytes.size();
  }
  if (place != bytes_ || found.value() != checksum_.value())
    throw InputError(
        {path_.string(), 0, fmt::format("the {} bytes that were written", bytes_), "others", kRemedy});
}

void sync_to_disk(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const int error_number = errno;
  if (file >= 0) ::close(file);
  if (!synced) fail_writing(path, "write the file", error_number);
}

}  // namespace cairn
