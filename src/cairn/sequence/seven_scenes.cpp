// SPDX-License-Identifier: Apache-2.0
// 7-Scenes (Shotton et al. 2013): frame-NNNNNN.color.png|jpg, frame-NNNNNN.depth.png, frame-NNNNNN.pose.txt
// with the 4x4 matrix world_from_camera (of which camera: `poses_are`). No time stamps: videos of a Kinect,
// 30 Hz.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/formats.h"

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

/// NaN and infinities, as recordings have them where tracking was lost.
bool is_no_number(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::string lower = lower_case(text.substr(0, 3));
  return lower == "nan" || lower == "inf";
}

void expect_four_lines(const TextFile& file) {
  if (file.lines().size() != 4)
    throw InputError({file.path().string(), 0, "4 lines, a 4x4 matrix",
                      fmt::format("{} lines", file.lines().size()), "Correct or delete the file."});
}

/// Nothing where one of its numbers is NaN or infinite.
std::optional<Eigen::Matrix4d> read_matrix(const TextFile& file) {
  expect_four_lines(file);
  bool finite = true;
  Eigen::Matrix4d matrix;
  for (std::size_t i = 0; i < 16; ++i) {
    const TextLine& line = file.lines()[i / 4];
    file.expect_fields(line, 4, "a row of a 4x4 matrix");
    finite = finite && !is_no_number(line.fields[i % 4]);
    if (!is_no_number(line.fields[i % 4]))
      matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
          file.number(line, i % 4, "the matrix");
  }
  return finite ? std::optional(matrix) : std::nullopt;
}

/// Nothing for the matrix of NaN, infinities or zeros by which the recording says that tracking was lost
/// there.
std::optional<WorldFromCamera> read_pose(const fs::path& path) {
  const TextFile file(path);
  const auto matrix = read_matrix(file);
  if (!matrix) return std::nullopt;
  const Eigen::Matrix3d rotation = matrix->topLeftCorner<3, 3>();
  if (rotation.isZero(0)) return std::nullopt;
  constexpr double kMaxDeviation = 0.05;
  const double deviation = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(deviation < kMaxDeviation) || rotation.determinant() < 0) {
    file.fail(file.lines()[0], "a rotation in the first three rows and columns",
              fmt::format("a matrix with determinant {:.4g}, {:.2g} from orthogonal", rotation.determinant(),
                          deviation),
              "Check that it is world_from_camera, or delete the file.");
  }
  if (!(matrix->row(3) - Eigen::RowVector4d(0, 0, 0, 1)).isZero(1e-6)) {
    file.fail(file.lines()[3], "a last row 0 0 0 1", "another",
              "Check that the matrix is written by rows, the translation in the last column.");
  }
  return WorldFromCamera({Eigen::Quaterniond(rotation).normalized(), matrix->topRightCorner<3, 1>()});
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
    if (const auto pose = read_pose(files.pose)) truth.push_back({stamp_ns, *pose});
  }
  sequence.report.associated = static_cast<std::int64_t>(sequence.frames.size());
  if (!truth.empty()) sequence.truth = std::move(truth);
}

}  // namespace cairn
