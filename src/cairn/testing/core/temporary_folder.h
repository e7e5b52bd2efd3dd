// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace cairn::testkit {

/// Owns an empty folder of its own among the system's temporary files, and removes it with all that it holds.
/// Two of them never share a folder, in one process or in several.
class TemporaryFolder {
 public:
  /// Creates the folder. Throws InputError if the system's temporary folder cannot be written.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Returns the absolute path, without links, of the folder.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Returns the path of `name` in the folder, whether there is such a file or not.
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Creates `name`, a folder in this folder, with those above it, and returns its path.
  [[nodiscard]] std::filesystem::path make_folder(std::string_view name) const;
  /// Writes the file `name`, creates the folders above it, and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view contents) const;
  /// Returns the bytes of the file `name`. Throws InputError if it cannot be read.
  [[nodiscard]] std::string read(std::string_view name) const;
  /// Removes all that the folder holds.
  void clear() const;

 private:
  std::filesystem::path path_;
};

/// Returns the bytes of all files below `folder`, by their paths relative to it.
[[nodiscard]] std::map<std::string, std::string> contents_of(const std::filesystem::path& folder);

}  // namespace cairn::testkit
