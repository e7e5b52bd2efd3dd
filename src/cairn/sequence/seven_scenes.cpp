// SPDX-License-Identifier: Apache-2.0
// 7-Scenes (Shotton et al. 2013): frame-NNNNNN.color.png|jpg, frame-NNNNNN.depth.png, frame-NNNNNN.pose.txt
// with the 4x4 matrix world_from_camera (of which camera: `poses_are`). No time stamps.
#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "frame-";

/// The number of frame-NNNNNN.<kind>.<extension>, or nothing.
std::optional<std::int64_t> frame_number(const std::string& name, std::string_view kind) {
  if (!name.starts_with(kPrefix)) return std::nullopt;
  const std::size_t dot = name.find('.');
  std::int64_t number = 0;
  if (dot == std::string::npos ||
      !parse_integer(std::string_view(name).substr(kPrefix.size(), dot - kPrefix.size()), number))
    return std::nullopt;
  if (!std::string_view(name).substr(dot + 1).starts_with(kind)) return std::nullopt;
  return number;
}

/// Nothing for the matrix of NaN or zeros by which the recording says that tracking was lost there.
std::optional<Rigid3> read_matrix(const fs::path& path) {
  const TextFile file(path);
  if (file.lines().size() != 4) {
    throw InputError({path.string(), 0, "4 lines, a 4x4 matrix", fmt::format("{} lines", file.lines().size()),
                      "Mend or delete the file."});
  }
  Eigen::Matrix4d matrix;
  for (std::size_t row = 0; row < 4; ++row) {
    const TextLine& line = file.lines()[row];
    file.expect_fields(line, 4, "a row of a 4x4 matrix");
    for (std::size_t column = 0; column < 4; ++column) {
      double value = 0;
      if (!parse_number(line.fields[column], value)) return std::nullopt;
      matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = value;
    }
  }
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  constexpr double kMaxDeviation = 0.05;
  if (!((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() < kMaxDeviation) ||
      rotation.determinant() < 0) {
    return std::nullopt;
  }
  return Rigid3{Eigen::Quaterniond(rotation).normalized(), matrix.topRightCorner<3, 1>()};
}

struct FoundFiles {
  fs::path color, depth, pose;
};

std::map<std::int64_t, FoundFiles> find_files(const fs::path& folder) {
  std::map<std::int64_t, FoundFiles> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (const auto number = frame_number(name, "color.")) found[*number].color = entry.path();
    if (const auto number = frame_number(name, "depth.")) found[*number].depth = entry.path();
    if (const auto number = frame_number(name, "pose.txt")) found[*number].pose = entry.path();
  }
  return found;
}

}  // namespace

bool is_seven_scenes(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (frame_number(entry.path().filename().string(), "color.")) return true;
  }
  return false;
}

void list_seven_scenes(const fs::path& folder, Sequence& sequence) {
  sequence.format = "7-Scenes";
  Trajectory truth;
  for (const auto& [number, files] : find_files(folder)) {
    sequence.report.color_images += files.color.empty() ? 0 : 1;
    sequence.report.depth_images += files.depth.empty() ? 0 : 1;
    if (files.color.empty() || files.depth.empty()) continue;
    const std::int64_t stamp_ns = stamp_of_number(number, sequence.calibration.rate_hz);
    sequence.frames.push_back({stamp_ns, number, files.color, files.depth, {}});
    if (files.pose.empty()) continue;
    if (const auto pose = read_matrix(files.pose)) truth.push_back({stamp_ns, *pose});
  }
  sequence.report.associated = static_cast<std::int64_t>(sequence.frames.size());
  if (!truth.empty()) sequence.truth = std::move(truth);
}

}  // namespace cairn
