// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/recording_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using std::string_view_literals::operator""sv;

enum class RecordingKind { video, heic, ros_bag };

struct Recording {
  RecordingKind kind;
  const char* name;
};

/// Recognises a file by its first bytes.
std::optional<Recording> recognise(const fs::path& path) {
  if (!fs::is_regular_file(path)) return std::nullopt;
  constexpr std::size_t kHead = 16;
  std::array<char, kHead> bytes{};
  const std::string_view head(bytes.data(), FileReader(path).read(bytes.data(), bytes.size()));
  if (head.starts_with("#ROSBAG V"sv)) return Recording{RecordingKind::ros_bag, "a ROS 1 bag"};
  if (head.starts_with("SQLite format 3"sv))
    return Recording{RecordingKind::ros_bag, "a SQLite database, as ROS 2 bags are"};
  if (head.starts_with("\x89MCAP"sv))
    return Recording{RecordingKind::ros_bag, "an MCAP file, as ROS 2 bags are"};
  if (head.starts_with("\x1a\x45\xdf\xa3"sv))
    return Recording{RecordingKind::video, "a Matroska or WebM video"};
  if (head.starts_with("RIFF"sv) && head.substr(8).starts_with("AVI "sv))
    return Recording{RecordingKind::video, "an AVI video"};
  if (head.size() < 12 || head.substr(4, 4) != "ftyp"sv) return std::nullopt;
  constexpr std::array kPhotos{"heic"sv, "heix"sv, "mif1"sv, "msf1"sv, "heim"sv, "heis"sv, "avif"sv};
  const bool is_photo = std::find(kPhotos.begin(), kPhotos.end(), head.substr(8, 4)) != kPhotos.end();
  if (is_photo) return Recording{RecordingKind::heic, "a HEIC or AVIF photo"};
  return Recording{RecordingKind::video, "an MP4 or QuickTime video"};
}

std::string remedy_for(RecordingKind kind, const fs::path& path) {
  const std::string file = path.string();
  if (kind == RecordingKind::video) {
    return fmt::format(
        "Extract its frames: mkdir frames && ffmpeg -i '{}' frames/%06d.png. One camera alone suffices for "
        "'cairn localize'; SLAM needs depth or a second camera.",
        file);
  }
  if (kind == RecordingKind::heic)
    return fmt::format("Convert it: heif-convert '{}' photo.jpg (Debian package libheif-examples).", file);
  return "Export the images of its topics into two folders, color/ and depth/ or left/ and right/, named by "
         "their stamps (seconds, or nanoseconds as whole numbers), and the calibration as camera.yaml; in "
         "ROS 1 "
         "image_view's extract_images, anywhere the Python package 'rosbags' reads both kinds.";
}

/// Returns the first file of a ROS 2 bag in its folder.
std::optional<fs::path> ros2_bag_in(const fs::path& folder) {
  if (!fs::is_directory(folder) || !fs::exists(folder / "metadata.yaml")) return std::nullopt;
  for (const fs::path& file : files_in(folder))
    if (file.extension() == ".db3" || file.extension() == ".mcap") return file;
  return std::nullopt;
}

}  // namespace

void refuse_recording(const fs::path& path) {
  const auto bag = ros2_bag_in(path);
  const auto recording = recognise(bag.value_or(path));
  if (!recording) return;
  throw InputError({path.string(), 0, "a folder with a sequence",
                    fmt::format("{}{}", recording->name, bag ? ", in its folder" : ""),
                    remedy_for(recording->kind, path)});
}

std::optional<std::string> recording_in(const fs::path& folder) {
  for (const fs::path& file : files_in(folder)) {
    const auto recording = recognise(file);
    if (recording) {
      return fmt::format("{} ({}). {}", file.filename().string(), recording->name,
                         remedy_for(recording->kind, file));
    }
  }
  return std::nullopt;
}

}  // namespace cairn
