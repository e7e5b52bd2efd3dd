// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMarker = ".cairn";  // its first word is the kind of the folder

fs::path absolute_without_link(const fs::path& target) {
  std::error_code error;
  const fs::path absolute = fs::absolute(target).lexically_normal();
  fs::path path = fs::weakly_canonical(absolute, error);
  if (error) path = absolute;
  return path.has_filename() ? path : path.parent_path();
}

/// The kind of the folder, if cairn wrote it.
std::optional<std::string> kind_written(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kMarker, error)) return std::nullopt;
  const std::string marker = read_file(folder / kMarker);
  return marker.substr(0, marker.find(':'));
}

void require_ours(const fs::path& target, std::string_view kind) {
  std::error_code error;
  if (!fs::exists(target, error)) return;
  if (!fs::is_directory(target, error))
    throw InputError(
        {target.string(), 0, "a folder to write to", "a file of that name", "Choose another -o."});
  if (fs::is_empty(target, error)) return;
  const auto written = kind_written(target);
  if (written == kind) return;
  throw InputError({target.string(), 0, fmt::format("a new or empty folder, or a {} that cairn wrote", kind),
                    written ? fmt::format("a {} that cairn wrote", *written) : "a folder with other contents",
                    "Choose another -o; nothing in it was touched."});
}

bool is_mount_point(const fs::path& path) {
  struct statx status {};
  return ::statx(AT_FDCWD, path.c_str(), 0, STATX_BASIC_STATS, &status) == 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
}

bool can_be_renamed(const fs::path& folder) {
  std::error_code error;
  return !is_mount_point(folder) && !fs::equivalent(folder, fs::current_path(error), error) &&
         ::access(folder.parent_path().c_str(), W_OK) == 0;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, error)) paths.push_back(entry.path());
  return paths;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target, std::string_view kind)
    : given_(target), target_(absolute_without_link(target)) {
  require_ours(target, kind);
  std::error_code error;
  in_place_ = fs::exists(target_, error) && !can_be_renamed(target_);
  prepare(temporary_beside(in_place_ ? target_ / "result" : target_), kind);
}

OutputFolder::OutputFolder(const fs::path& target, std::string_view kind,
                           std::function<bool(const fs::path& work)> is_worth_keeping)
    : given_(target), target_(absolute_without_link(target)) {
  std::error_code error;
  in_place_ = fs::exists(target_, error) && !can_be_renamed(target_);
  const fs::path unfinished = (in_place_ ? target_ / "result" : target_).string() + ".unfinished";
  if (entries_of(target_) != std::vector{unfinished}) require_ours(target, kind);
  require_ours(unfinished, kind);
  prepare(unfinished, kind);
  lock();
  is_worth_keeping_ = std::move(is_worth_keeping);
}

void OutputFolder::prepare(const fs::path& work, std::string_view kind) {
  work_ = work;
  std::error_code error;
  for (fs::path parent = work_.parent_path(); !fs::exists(parent, error); parent = parent.parent_path())
    made_parents_.push_back(parent);
  fs::create_directories(work_, error);
  if (error) fail_writing(given_, "create the folder", error.value());
  write_file(work_ / kMarker, fmt::format("{}: written by cairn, which may replace this folder\n", kind));
}

void OutputFolder::lock() {
  lock_ = ::open(work_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  if (lock_ >= 0) ::close(lock_);
  const std::string work = work_.string();
  work_.clear();
  throw InputError({work, 0, "unfinished work that nobody is at", "another run that works in it",
                    "Wait for it, or choose another -o."});
}

OutputFolder::~OutputFolder() {
  if (!work_.empty() && !(is_worth_keeping_ && is_worth_keeping_(work_))) {
    std::error_code ignored;
    fs::remove_all(work_, ignored);
    for (const fs::path& parent : made_parents_) fs::remove(parent, ignored);  // only where it is empty
  }
  if (lock_ >= 0) ::close(lock_);
}

void OutputFolder::commit() {
  require(!work_.empty(), "an OutputFolder is committed once");
  std::error_code error;
  if (in_place_) {
    fill_target();
  } else if (fs::exists(target_, error)) {
    replace_target();
  } else {
    commit_file(work_, target_);
  }
  work_.clear();
}

/// Exchanges both in one step where the file system can, else in two.
void OutputFolder::replace_target() {
  std::error_code ignored;
  if (::renameat2(AT_FDCWD, work_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
    fs::remove_all(work_, ignored);
    return;
  }
  const fs::path old = temporary_beside(target_);
  commit_file(target_, old);
  commit_file(work_, target_);
  fs::remove_all(old, ignored);
}

/// The marker comes first, so that a folder that was left half way is known as ours.
void OutputFolder::fill_target() {
  commit_file(work_ / kMarker, target_ / kMarker);
  std::error_code error;
  for (const fs::path& old : entries_of(target_)) {
    if (old.filename() == kMarker || old == work_) continue;
    fs::remove_all(old, error);
    if (error) fail_writing(old, "remove the result of an earlier run", error.value());
  }
  for (const fs::path& made : entries_of(work_)) commit_file(made, target_ / made.filename());
  fs::remove_all(work_, error);
}

}  // namespace cairn
