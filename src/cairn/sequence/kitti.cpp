// SPDX-License-Identifier: Apache-2.0
// The KITTI odometry benchmark's layout (Geiger et al. 2012): grey images of the left and right camera in
// image_0 and image_1, rectified; calib.txt with the 3x4 projection matrices P0 and P1; times.txt, seconds;
// poses.txt, where there is one, 3x4 world_from_camera of the left camera by rows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/trajectory_file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using Projection = std::array<double, 12>;  ///< 3x4 by rows

std::vector<fs::path> images_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw InputError({folder.string(), 0, "a folder with the images of one camera", "none",
                      "KITTI's grey stereo pairs lie in image_0 (left) and image_1 (right)."});
  }
  std::vector<fs::path> images;
  for (const fs::path& file : files_in(folder)) {
    if (file.extension() == ".png" || file.extension() == ".jpg") images.push_back(file);
  }
  return images;
}

/// Both cameras need the same file names.
void expect_pairs(const std::vector<fs::path>& left, const std::vector<fs::path>& right,
                  const fs::path& folder) {
  const auto same_name = [](const fs::path& a, const fs::path& b) { return a.filename() == b.filename(); };
  const auto [l, r] = std::mismatch(left.begin(), left.end(), right.begin(), right.end(), same_name);
  if (l == left.end() && r == right.end()) return;
  const bool right_is_missing =
      r == right.end() || (l != left.end() && *l < folder / "image_0" / r->filename());
  const fs::path& lone = right_is_missing ? *l : *r;
  throw InputError({(folder / (right_is_missing ? "image_1" : "image_0") / lone.filename()).string(), 0,
                    fmt::format("the partner of {}", lone.string()), "no such file",
                    "Delete the lone image and its lines in times.txt and poses.txt, or add the other."});
}

Projection read_projection(const TextFile& file, std::string_view name) {
  for (const TextLine& line : file.lines()) {
    if (line.fields[0] != name) continue;
    file.expect_fields(line, 13, fmt::format("{} and a 3x4 matrix by rows", name));
    Projection p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = file.number(line, i + 1, name);
    return p;
  }
  throw InputError({file.path().string(), 0, fmt::format("a line '{} ...'", name), "none",
                    "It holds the 3x4 projection matrix of that camera by rows."});
}

void read_rig(const fs::path& path, Calibration& calibration) {
  const TextFile file(path);
  const Projection left = read_projection(file, "P0:"), right = read_projection(file, "P1:");
  const auto fail = [&](std::string expected, double found) {
    throw InputError({path.string(), 0, std::move(expected), fmt::format("{}", found), "Check calib.txt."});
  };
  Camera& camera = calibration.camera;
  camera.fx = left[0];
  camera.fy = left[5];
  camera.cx = left[2];
  camera.cy = left[6];
  if (!(camera.fx > 0)) fail("a focal length above 0 in P0", camera.fx);
  if (!(camera.fy > 0)) fail("a focal length above 0 in P0", camera.fy);
  constexpr std::array<std::size_t, 4> kIntrinsics{0, 2, 5, 6};
  for (const std::size_t i : kIntrinsics) {
    if (std::abs(left[i] - right[i]) > 1e-3)
      fail(fmt::format("P1 with the focal lengths and centre of P0 (rectified images): {}", left[i]),
           right[i]);
  }
  const double baseline = (left[3] - right[3]) / camera.fx;
  if (!(baseline > 0)) fail("the right camera to the right of the left one, a baseline above 0 m", baseline);
  calibration.baseline = baseline;
}

std::vector<std::int64_t> read_times(const fs::path& path, std::size_t images) {
  const TextFile file(path);
  std::vector<std::int64_t> stamps;
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 1, "seconds");
    std::int64_t stamp_ns = 0;
    if (!parse_stamp(line.fields[0], stamp_ns)) {
      file.fail(line, "a time in seconds", fmt::format("'{}'", line.fields[0]), "Mend the line.");
    }
    if (!stamps.empty() && stamp_ns <= stamps.back()) {
      file.fail(line, fmt::format("a time after {}", format_stamp(stamps.back())), format_stamp(stamp_ns),
                "Sort the times; each image needs its own.");
    }
    stamps.push_back(stamp_ns);
  }
  if (stamps.size() == images) return stamps;
  throw InputError({path.string(), 0, fmt::format("{} times, one for each image in image_0", images),
                    fmt::format("{}", stamps.size()), "Add or delete lines, or images."});
}

/// A pose for each image, or poses with stamps of their own.
Trajectory read_poses(const fs::path& path, const std::vector<std::int64_t>& stamps, SequenceReport& report) {
  const TextFile text(path);
  constexpr std::size_t kLeast = 8;  // of any other layout
  const bool is_short = !text.lines().empty() && text.lines().front().fields.size() < kLeast;
  double value = 0;
  if (is_short && parse_number(text.lines().front().fields[0], value))
    (void)parse_matrix_pose(text, text.lines().front());  // says what is expected
  TrajectoryFile file = read_trajectory_file(path);
  if (file.key == PoseKey::stamp) return read_truth(path, false, report);
  if (file.poses.size() != stamps.size()) {
    throw InputError({path.string(), 0, fmt::format("{} poses, one for each image", stamps.size()),
                      fmt::format("{}", file.poses.size()), "Add or delete lines, or remove the file."});
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) file.poses[i].stamp_ns = stamps[i];
  return std::move(file.poses);
}

void read_calib(const fs::path& path, const fs::path& first_image, Sequence& sequence) {
  read_rig(path, sequence.calibration);
  const GrayImage first = read_gray(first_image);
  sequence.calibration.camera.width = first.width();
  sequence.calibration.camera.height = first.height();
  sequence.calibration_source = path.string();
}

}  // namespace

bool is_kitti(const fs::path& folder) {
  return fs::is_directory(folder / "image_0") &&
         (fs::exists(folder / "calib.txt") || fs::exists(folder / "times.txt"));
}

void list_kitti(const fs::path& folder, Sequence& sequence) {
  sequence.format = "KITTI";
  const auto left = images_in(folder / "image_0"), right = images_in(folder / "image_1");
  if (left.empty()) {
    throw InputError({(folder / "image_0").string(), 0, "PNG or JPEG images", "none", "Check the folder."});
  }
  expect_pairs(left, right, folder);
  const auto stamps = read_times(folder / "times.txt", left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::int64_t number = 0;
    if (!parse_integer(left[i].stem().string(), number)) number = static_cast<std::int64_t>(i);
    sequence.frames.push_back({stamps[i], number, left[i], {}, right[i]});
  }
  if (sequence.calibration_source.empty()) read_calib(folder / "calib.txt", left[0], sequence);
  if (fs::exists(folder / "poses.txt"))
    sequence.truth = read_poses(folder / "poses.txt", stamps, sequence.report);
  sequence.report.color_images = sequence.report.right_images = static_cast<std::int64_t>(left.size());
  sequence.report.associated = sequence.report.color_images;
}

}  // namespace cairn
