// SPDX-License-Identifier: Apache-2.0
// The ASL layout of the EuRoC recordings (Burri et al. 2016): cam0 (left) and cam1 (right), each with
// data.csv, which lists `stamp in nanoseconds, file name`, the images in data/ and sensor.yaml; perhaps the
// body's true poses in state_groundtruth_estimate0/data.csv, `stamp, position, quaternion w x y z, ...`. All
// may lie in a folder mav0. The images are raw.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"
#include "cairn/core/text.h"
#include "cairn/sequence/asl_poses.h"
#include "cairn/sequence/asl_sensor.h"
#include "cairn/sequence/association.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

fs::path root_of(const fs::path& folder) {
  return fs::is_directory(folder / "mav0") ? folder / "mav0" : folder;
}

/// One camera's images, as its data.csv lists them.
struct ImageList {
  std::vector<std::int64_t> stamps;
  std::vector<fs::path> paths;
};

ImageList read_images(const fs::path& camera_folder) {
  const TextFile file(camera_folder / "data.csv", Separator::commas);
  ImageList images;
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 2, "stamp in nanoseconds, file name");
    images.stamps.push_back(
        parse_asl_stamp(file, line, images.stamps.empty() ? nullptr : &images.stamps.back()));
    images.paths.push_back(camera_folder / "data" / std::string(line.fields[1]));
  }
  return images;
}

void pair_images(const fs::path& root, double max_gap_s, Sequence& sequence) {
  const ImageList left = read_images(root / "cam0"), right = read_images(root / "cam1");
  const auto pairs = associate_stamps(left.stamps, right.stamps, std::llround(max_gap_s * 1e9));
  SequenceReport& report = sequence.report;
  for (const auto& [l, r] : pairs) {
    const auto number = static_cast<std::int64_t>(sequence.frames.size());
    sequence.frames.push_back({left.stamps[l], number, left.paths[l], {}, right.paths[r]});
    const double gap_s = 1e-9 * std::abs(static_cast<double>(left.stamps[l] - right.stamps[r]));
    report.max_stamp_gap_s = std::max(report.max_stamp_gap_s, gap_s);
  }
  report.color_images = static_cast<std::int64_t>(left.stamps.size());
  report.right_images = static_cast<std::int64_t>(right.stamps.size());
  report.associated = static_cast<std::int64_t>(pairs.size());
  report.associated_by = "time, nearest stamp";
  if (!pairs.empty() || left.stamps.empty()) return;
  throw InputError({(root / "cam1/data.csv").string(), 0,
                    fmt::format("images within {} s of those in cam0/data.csv", max_gap_s), "none",
                    "Check that both cameras have one clock."});
}

/// Poses of the left camera, before rectification.
Trajectory read_truth_of_left(const fs::path& poses, const Rigid3& body_from_left, SequenceReport& report) {
  Trajectory truth = read_truth(poses, true, report);
  for (StampedPose& pose : truth)
    pose.world_from_camera = WorldFromCamera(pose.world_from_camera * body_from_left);
  return truth;
}

}  // namespace

bool is_euroc(const fs::path& folder) {
  const fs::path camera = root_of(folder) / "cam0";
  return fs::exists(camera / "data.csv") || fs::exists(camera / "sensor.yaml");
}

void list_euroc(const fs::path& folder, const SequenceOptions& options, Sequence& sequence) {
  sequence.format = "EuRoC";
  const fs::path root = root_of(folder);
  pair_images(root, options.max_stamp_gap_s, sequence);
  const fs::path left = root / "cam0/sensor.yaml", right = root / "cam1/sensor.yaml";
  if (sequence.calibration_source.empty()) {
    const Rigid3 body_from_left = read_body_from_sensor(left);
    auto& stated = sequence.calibration.body_from_camera;
    if (!stated) stated = body_from_left;
    const LeftFromRight left_from_right(body_from_left.inverse() * read_body_from_sensor(right));
    set_raw_stereo({read_asl_camera(left), read_asl_camera(right), left_from_right}, {right.string()},
                   sequence.calibration);
    sequence.calibration_source = fmt::format("{} and cam1", left.string());
  }
  const fs::path truth = root / "state_groundtruth_estimate0/data.csv";
  if (!fs::exists(truth)) return;
  const auto& stated = sequence.calibration.body_from_camera;  // goes before what the format carries
  sequence.truth = read_truth_of_left(truth, stated ? *stated : read_body_from_sensor(left), sequence.report);
}

}  // namespace cairn
