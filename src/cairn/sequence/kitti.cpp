// SPDX-License-Identifier: Apache-2.0
// The KITTI odometry benchmark's layout (Geiger et al. 2012): grey images of the left and right camera in
// image_0 and image_1, rectified; calib.txt with the 3x4 projection matrices P0 and P1; times.txt, seconds;
// poses.txt, where there is one, 3x4 world_from_camera of the left camera by rows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
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
  for (const fs::path& file : files_in(folder))
    if (is_image_name(file)) images.push_back(file);
  return images;
}

/// File names in natural order, each once.
struct NaturalOrder {
  bool operator()(const std::string& a, const std::string& b) const { return comes_naturally_before(a, b); }
};
using Names = std::set<std::string, NaturalOrder>;

Names names_of(const std::vector<fs::path>& images) {
  Names names;
  for (const fs::path& image : images) names.insert(image.filename().string());
  return names;
}

/// The first name that only one of the cameras has.
[[noreturn]] void fail_lone(const Names& left, const Names& right, const fs::path& folder) {
  Names lone;
  std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                std::inserter(lone, lone.end()), NaturalOrder());
  const std::string& name = *lone.begin();
  const char* const has = left.contains(name) ? "image_0" : "image_1";
  const char* const lacks = left.contains(name) ? "image_1" : "image_0";
  throw InputError({(folder / lacks / name).string(), 0,
                    fmt::format("the partner of {}", (folder / has / name).string()), "no such file",
                    "Delete the lone image and its lines in times.txt and poses.txt, or add the other."});
}

/// The names 000000.png ... of `count` pairs, of which some are missing on disk: where all names there are
/// positions among them. Nothing otherwise.
/// Names the empty places of a list by their number, as `pattern` is.
void fill_places(const fs::path& pattern, std::vector<std::string>& by_position) {
  for (std::size_t i = 0; i < by_position.size(); ++i) {
    if (by_position[i].empty())
      by_position[i] =
          fmt::format("{:0{}}{}", i, pattern.stem().string().size(), pattern.extension().string());
  }
}

std::optional<Names> names_by_position(const Names& names, std::size_t count) {
  std::vector<std::string> by_position(count);
  for (const std::string& name : names) {
    const auto position = parse_frame_number(fs::path(name).stem().string());
    if (!position || *position >= static_cast<std::int64_t>(count)) return std::nullopt;
    std::string& place = by_position[static_cast<std::size_t>(*position)];
    if (!place.empty()) return std::nullopt;
    place = name;
  }
  fill_places(*names.begin(), by_position);
  return Names(by_position.begin(), by_position.end());
}

/// The file names of all pairs that times.txt lists. A file that is missing on disk is one that cannot be
/// read like any other; but where the times do not say that it was there, one does not know which time is
/// whose.
Names names_of_pairs(const Names& left, const Names& right, std::size_t times, const fs::path& folder) {
  Names names = left;
  names.insert(right.begin(), right.end());
  if (right.empty()) fail_lone(left, right, folder);
  if (names.size() == times) return names;
  if (auto all = names_by_position(names, times); names.size() < times && all) return *all;
  if (left != right) fail_lone(left, right, folder);
  throw InputError({(folder / "times.txt").string(), 0,
                    fmt::format("{} times, one for each image in image_0", left.size()),
                    fmt::format("{}", times), "Add or delete lines, or images."});
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

std::int64_t read_time(const TextFile& file, const TextLine& line) {
  file.expect_fields(line, 1, "seconds");
  std::int64_t stamp_ns = 0;
  if (!parse_stamp(line.fields[0], stamp_ns))
    file.fail(line, "a time in seconds", fmt::format("'{}'", line.fields[0]), "Correct the line.");
  return stamp_ns;
}

std::vector<std::int64_t> read_times(const fs::path& path) {
  const TextFile file(path);
  std::vector<std::int64_t> stamps;
  for (const TextLine& line : file.lines()) {
    const std::int64_t stamp_ns = read_time(file, line);
    if (!stamps.empty() && stamp_ns <= stamps.back()) {
      file.fail(line, fmt::format("a time after {}", format_stamp(stamps.back())), format_stamp(stamp_ns),
                "Sort the times; each image needs its own.");
    }
    stamps.push_back(stamp_ns);
  }
  return stamps;
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

void read_calib(const fs::path& path, const std::vector<fs::path>& images, Sequence& sequence) {
  read_rig(path, sequence.calibration);
  const ImageSize size = size_of_images(images);
  sequence.calibration.camera.width = size.width;
  sequence.calibration.camera.height = size.height;
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
  const auto stamps = read_times(folder / "times.txt");
  const Names left_names = names_of(left), right_names = names_of(right);
  for (const std::string& name : names_of_pairs(left_names, right_names, stamps.size(), folder)) {
    if (left_names.contains(name) && right_names.contains(name)) ++sequence.report.associated;
    const std::size_t i = sequence.frames.size();
    const auto number = parse_frame_number(fs::path(name).stem().string());
    sequence.frames.push_back({stamps[i],
                               number.value_or(static_cast<std::int64_t>(i)),
                               folder / "image_0" / name,
                               {},
                               folder / "image_1" / name});
  }
  if (sequence.calibration_source.empty()) read_calib(folder / "calib.txt", left, sequence);
  if (fs::exists(folder / "poses.txt"))
    sequence.truth = read_poses(folder / "poses.txt", stamps, sequence.report);
  sequence.report.color_images = static_cast<std::int64_t>(left.size());
  sequence.report.right_images = static_cast<std::int64_t>(right.size());
}

}  // namespace cairn
