// SPDX-License-Identifier: Apache-2.0
// Pairs of image folders, or of series in one folder, without lists: the names say which images belong
// together and when they were taken. Beside them there may be the poses and the calibration of ScanNet's
// export (pose/N.txt, intrinsic/intrinsic_color.txt), of Replica (traj.txt), or trajectory.txt.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/formats.h"
#include "cairn/sequence/image_folders.h"
#include "cairn/sequence/matrix_pose.h"
#include "cairn/sequence/trajectory_file.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using PositionPairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<std::int64_t> keys_of(const KeyedSeries& series) {
  std::vector<std::int64_t> keys;
  for (const KeyedFile& file : series.files) keys.push_back(file.key);
  return keys;
}

PositionPairs pairs_by_name(const KeyedSeries& first, const KeyedSeries& second) {
  std::map<std::string, std::size_t> partners;
  for (std::size_t i = 0; i < second.files.size(); ++i) partners.emplace(second.files[i].file.name, i);
  PositionPairs pairs;
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    const auto partner = partners.find(first.files[i].file.name);
    if (partner != partners.end()) pairs.emplace_back(i, partner->second);
  }
  return pairs;
}

PositionPairs pairs_of(const KeyedSeries& first, const KeyedSeries& second, double max_gap_s) {
  if (first.kind == SeriesKey::name) return pairs_by_name(first, second);
  const bool have_stamps = first.kind == SeriesKey::stamp;
  return associate_stamps(keys_of(first), keys_of(second), have_stamps ? std::llround(max_gap_s * 1e9) : 0);
}

std::string describe(SeriesKey kind) {
  if (kind == SeriesKey::stamp) return "time stamps";
  return kind == SeriesKey::number ? "numbers" : "names without a number";
}

void expect_same_kind(const ImagePair& pair, const KeyedSeries& first, const KeyedSeries& second) {
  if (first.kind == second.kind || second.files.empty() || first.files.empty()) return;
  throw InputError(
      {pair.second.place, 0,
       fmt::format("files named by {}, as in {}", describe(first.kind), pair.first.place),
       fmt::format("{}, {}", describe(second.kind), second.files.front().file.path.filename().string()),
       "Name the partners alike, or list both with stamps (TUM)."});
}

void expect_pairs(const ImagePair& pair, const KeyedSeries& first, const KeyedSeries& second,
                  const PositionPairs& pairs, double max_gap_s) {
  if (!pairs.empty() || first.files.empty() || second.files.empty()) return;
  const std::string how = first.kind == SeriesKey::stamp ? fmt::format("within {} s of", max_gap_s)
                                                         : std::string("of the number or name of");
  throw InputError({pair.second.place, 0, fmt::format("an image {} one in {}", how, pair.first.place),
                    fmt::format("none: {} and {}", first.files.front().file.path.filename().string(),
                                second.files.front().file.path.filename().string()),
                    "Check that both are of one recording; max_stamp_gap_s sets the largest gap."});
}

/// Counts the files that the series have; the warning, all images of their folders.
void report_pairs(const ImagePair& pair, const KeyedSeries& first, const KeyedSeries& second,
                  std::size_t pairs, Sequence& sequence) {
  SequenceReport& report = sequence.report;
  report.color_images = static_cast<std::int64_t>(first.files.size());
  (pair.is_stereo ? report.right_images : report.depth_images) =
      static_cast<std::int64_t>(second.files.size());
  report.associated = static_cast<std::int64_t>(pairs);
  const std::size_t lefts = pair.first.files.size(), rights = pair.second.files.size();
  if (lefts == pairs && rights == pairs) return;
  report.warnings.push_back(
      fmt::format("{} holds {} images, {} holds {}: {} and {} of them have no partner and are left out.",
                  pair.first.place, lefts, pair.second.place, rights, lefts - pairs, rights - pairs));
}

void add_frames(const ImagePair& pair, const SequenceOptions& options, Sequence& sequence) {
  const KeyedSeries first = read_series(pair.first.files), second = read_series(pair.second.files);
  expect_same_kind(pair, first, second);
  const PositionPairs pairs = pairs_of(first, second, options.max_stamp_gap_s);
  expect_pairs(pair, first, second, pairs, options.max_stamp_gap_s);
  const bool have_stamps = first.kind == SeriesKey::stamp;
  sequence.format = have_stamps ? "stamped" : "numbered";
  sequence.has_times = have_stamps || sequence.calibration.rate_hz.has_value();
  if (have_stamps) sequence.report.associated_by = "time, nearest stamp";
  for (const auto& [i, j] : pairs) {
    const std::int64_t key = first.files[i].key;
    const auto position = static_cast<std::int64_t>(sequence.frames.size());
    FrameFiles files;
    files.stamp_ns = have_stamps ? key : stamp_of_number(key, sequence.calibration.stamp_rate_hz());
    files.number = have_stamps ? position : key;
    files.color = first.files[i].file.path;
    (pair.is_stereo ? files.right : files.depth) = second.files[j].file.path;
    sequence.frames.push_back(std::move(files));
    if (!have_stamps) continue;
    const double gap_s = 1e-9 * std::abs(static_cast<double>(key - second.files[j].key));
    sequence.report.max_stamp_gap_s = std::max(sequence.report.max_stamp_gap_s, gap_s);
  }
  report_pairs(pair, first, second, pairs.size(), sequence);
}

/// Reads pose/N.txt, which has the key of its image.
std::optional<Trajectory> read_pose_files(const fs::path& folder, const Sequence& sequence) {
  std::vector<SeriesFile> names;
  for (const fs::path& file : files_in(folder))
    if (lower_case(file.extension().string()) == ".txt") names.push_back({file, file.stem().string()});
  const KeyedSeries series = read_series(names);
  const bool are_stamps = sequence.format == "stamped";
  if (series.files.empty() || are_stamps != (series.kind == SeriesKey::stamp)) return std::nullopt;
  std::map<std::int64_t, fs::path> by_key;
  for (const KeyedFile& file : series.files) by_key.emplace(file.key, file.file.path);
  Trajectory truth;
  for (const FrameFiles& frame : sequence.frames) {
    const auto found = by_key.find(are_stamps ? frame.stamp_ns : frame.number);
    if (found == by_key.end()) continue;
    if (const auto pose = read_matrix_pose(found->second)) truth.push_back({frame.stamp_ns, *pose});
  }
  return truth.empty() ? std::nullopt : std::optional(std::move(truth));
}

/// Reads traj.txt, which has a line for each colour image.
Trajectory read_pose_lines(const fs::path& path, const Sequence& sequence) {
  const auto poses = read_matrix_lines(path);
  if (poses.size() != sequence.frames.size()) {
    throw InputError({path.string(), 0, fmt::format("{} poses, one for each frame", sequence.frames.size()),
                      fmt::format("{}", poses.size()), "Add or delete lines, or remove the file."});
  }
  Trajectory truth;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (poses[i]) truth.push_back({sequence.frames[i].stamp_ns, *poses[i]});
  return truth;
}

void read_numbered_truth(const fs::path& path, Sequence& sequence) {
  if (!fs::exists(path) || !has_frame_numbers(path)) return;
  TrajectoryFile file = read_trajectory_file(path, {.may_have_numbers = true});
  if (file.key != PoseKey::number) return;
  for (StampedPose& pose : file.poses)
    pose.stamp_ns = stamp_of_number(pose.stamp_ns, sequence.calibration.stamp_rate_hz());
  sequence.truth = std::move(file.poses);
  sequence.report.warnings.insert(sequence.report.warnings.end(), file.warnings.begin(), file.warnings.end());
}

/// Reads poses by time from the file of the TUM benchmark's name.
void read_stamped_truth(const fs::path& folder, Sequence& sequence) {
  const fs::path path = folder / "groundtruth.txt";
  if (fs::exists(path)) sequence.truth = read_truth(path, false, sequence.report);
}

void read_poses(const fs::path& folder, Sequence& sequence) {
  for (const char* name : {"pose", "poses"}) {
    if (!fs::is_directory(folder / name)) continue;
    sequence.truth = read_pose_files(folder / name, sequence);
    if (sequence.truth) return;
  }
  if (fs::exists(folder / "traj.txt")) {
    sequence.truth = read_pose_lines(folder / "traj.txt", sequence);
    return;
  }
  if (sequence.format == "stamped") return read_stamped_truth(folder, sequence);
  read_numbered_truth(folder / "trajectory.txt", sequence);
}

ImageSize size_of_side(const ImageSide& side) {
  std::vector<fs::path> paths;
  for (const SeriesFile& file : side.files) paths.push_back(file.path);
  return size_of_images(paths);
}

/// Reads the intrinsics of a camera from the corner of a 4x4 matrix.
Camera read_intrinsics(const fs::path& path, const ImageSize& size) {
  const auto matrix = read_matrix_file(path);
  if (!matrix || !((*matrix)(0, 0) > 0) || !((*matrix)(1, 1) > 0)) {
    throw InputError({path.string(), 0, "a matrix with focal lengths above 0", "another",
                      "Give the calibration by --camera FILE, or as camera.yaml in the folder."});
  }
  Camera camera;
  camera.width = size.width;
  camera.height = size.height;
  camera.fx = (*matrix)(0, 0);
  camera.fy = (*matrix)(1, 1);
  camera.cx = (*matrix)(0, 2);
  camera.cy = (*matrix)(1, 2);
  return camera;
}

/// Reads the calibration of ScanNet's export: depth in millimetres by a camera of its own, at the place of
/// the colour camera.
void read_scannet_calibration(const fs::path& folder, const ImagePair& pair, Sequence& sequence) {
  const fs::path color = folder / "intrinsic/intrinsic_color.txt";
  const fs::path depth = folder / "intrinsic/intrinsic_depth.txt";
  if (pair.is_stereo || !sequence.calibration_source.empty() || !fs::exists(color) || !fs::exists(depth))
    return;
  constexpr double kMillimetres = 1000;
  Calibration& calibration = sequence.calibration;
  calibration.camera = read_intrinsics(color, size_of_side(pair.first));
  calibration.depth =
      DepthCalibration{kMillimetres, {0}, read_intrinsics(depth, size_of_side(pair.second)), {}};
  sequence.calibration_source = color.string();
}

}  // namespace

bool is_image_pairs(const fs::path& folder, const SequenceOptions& options) {
  return find_image_pair(folder, options).has_value();
}

void list_image_pairs(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  const ImagePair pair = find_image_pair(folder, options).value();
  for (const ImageSide* side : {&pair.first, &pair.second})
    if (!side->warning.empty()) sequence.report.warnings.push_back(side->warning);
  add_frames(pair, options, sequence);
  read_poses(folder, sequence);
  read_scannet_calibration(folder, pair, sequence);
}

}  // namespace cairn
