// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/core/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "cairn/core/error.h"
#include "cairn/core/file.h"

namespace cairn::testkit {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  const fs::path parent = fs::canonical(fs::temp_directory_path());
  std::string name = (parent / "cairn_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw InputError({.file = parent.string(),
                      .expected = "a folder that can be written",
                      .found = std::generic_category().message(errno),
                      .remedy = "Set TMPDIR to a folder for temporary files."});
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a test may have taken the folder away, or its own right to write there
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::make_folder(std::string_view name) const {
  fs::create_directories(path_ / name);
  return path_ / name;
}

fs::path TemporaryFolder::write(std::string_view name, std::string_view contents) const {
  fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  write_file(file, contents);
  return file;
}

std::string TemporaryFolder::read(std::string_view name) const {
  return read_file(path_ / name);
}

void TemporaryFolder::clear() const {
  for (const auto& entry : fs::directory_iterator(path_)) fs::remove_all(entry.path());
}

std::map<std::string, std::string> contents_of(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      contents[entry.path().lexically_relative(folder).string()] = read_file(entry.path());
  return contents;
}

}  // namespace cairn::testkit
