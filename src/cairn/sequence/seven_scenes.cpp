// SPDX-License-Identifier: Apache-2.0
// 7-Scenes (Shotton et al. 2013): frame-NNNNNN.color.png|jpg, frame-NNNNNN.depth.png, frame-NNNNNN.pose.txt
// with the 4x4 matrix world_from_camera (of which camera: `poses_are`). No time stamps: videos of a Kinect,
// 30 Hz.
#include <algorithm>
#include <map>

#include "cairn/sequence/formats.h"
#include "cairn/sequence/matrix_pose.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "frame-";

/// A file of a frame: its number and what stands behind it, "color.png".
struct FrameName {
  std::int64_t number;
  std::string rest;
};

/// Of frame-NNNNNN.color.png and the like; nothing for other names.
std::optional<FrameName> parse_name(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (!name.starts_with(kPrefix) || dot == std::string::npos) return std::nullopt;
  const auto number = parse_frame_number(std::string_view(name).substr(kPrefix.size(), dot - kPrefix.size()));
  if (!number) return std::nullopt;
  return FrameName{*number, name.substr(dot + 1)};
}

/// "color.png", but not "color.proj.png".
bool is_image_of(const FrameName& name, const char* kind) {
  const fs::path rest(name.rest);
  return is_image_name(rest) && rest.stem() == kind;
}

struct FoundFiles {
  fs::path color, depth, pose;
};

std::map<std::int64_t, FoundFiles> find_files(const fs::path& folder) {
  std::map<std::int64_t, FoundFiles> found;
  for (const fs::path& file : files_in(folder)) {
    const auto name = parse_name(file.filename().string());
    if (!name) continue;
    if (is_image_of(*name, "color")) found[name->number].color = file;
    if (is_image_of(*name, "depth")) found[name->number].depth = file;
    if (name->rest == "pose.txt") found[name->number].pose = file;
  }
  return found;
}

}  // namespace

bool is_seven_scenes(const fs::path& folder) {
  const auto files = files_in(folder);
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) {
    const auto name = parse_name(file.filename().string());
    return name && is_image_of(*name, "color");
  });
}

void list_seven_scenes(const fs::path& folder, Sequence& sequence) {
  sequence.format = "7-Scenes";
  Trajectory truth;
  for (const auto& [number, files] : find_files(folder)) {
    sequence.report.color_images += files.color.empty() ? 0 : 1;
    sequence.report.depth_images += files.depth.empty() ? 0 : 1;
    if (files.color.empty() || files.depth.empty()) continue;
    const std::int64_t stamp_ns = stamp_of_number(number, sequence.calibration.stamp_rate_hz());
    sequence.frames.push_back({stamp_ns, number, files.color, files.depth, {}});
    if (files.pose.empty()) continue;
    if (const auto pose = read_matrix_pose(files.pose)) truth.push_back({stamp_ns, *pose});
  }
  sequence.report.associated = static_cast<std::int64_t>(sequence.frames.size());
  if (!truth.empty()) sequence.truth = std::move(truth);
}

}  // namespace cairn
