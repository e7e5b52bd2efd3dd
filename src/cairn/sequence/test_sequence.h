// SPDX-License-Identifier: Apache-2.0
// What the tests of the readers share: a folder that goes away, small recordings, the message of an error.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// A folder for one test's files. A base of fixtures, beside testing::Test.
class TestFolder {
 protected:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cairn_test_XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "the temporary folder can be written");
    folder_ = name;
  }
  ~TestFolder() { std::filesystem::remove_all(folder_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  void make_empty() const {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& contents) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_file(folder_ / name, contents);
    return folder_ / name;
  }
  void put(const std::string& name, const std::string& contents) const { (void)write(name, contents); }
  void put_color(const std::string& name, std::uint8_t gray = 90) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_png(folder_ / name, RgbImage(8, 6, {gray, gray, gray}));
  }
  void put_depth(const std::string& name, std::uint16_t raw = 1000) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    write_png(folder_ / name, RawDepthImage(8, 6, raw));
  }

  std::filesystem::path folder_;
};

/// camera.yaml for images of put_color and put_depth.
inline constexpr const char* kSmallCamera =
    "camera: {width: 8, height: 6, fx: 10, fy: 10, cx: 3.5, cy: 2.5}\ndepth: {scale: 1000}\n";

/// The message of the InputError that `act` throws.
template <class Act>
std::string message_of(Act act) {
  try {
    (void)act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

}  // namespace cairn
