// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/write_kitti.h"

#include <fmt/format.h>

#include <exception>
#include <optional>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/given_poses.h"
#include "cairn/sequence/skipped_frames.h"
#include "cairn/simulate/sensor_noise.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

constexpr double kDepthScale = 256;  // units per metre, as KITTI's depth maps

/// A line of calib.txt: the 3x4 projection matrix of a camera `baseline` to the right of the first.
std::string format_projection(const char* name, const Camera& camera, double baseline) {
  return fmt::format("{}: {:.12e} 0 {:.12e} {:.12e} 0 {:.12e} {:.12e} 0 0 0 1 0\n", name, camera.fx,
                     camera.cx, 0.0 - camera.fx * baseline, camera.fy, camera.cy);
}

std::string format_poses(const Trajectory& truth) {
  std::string text;
  for (const auto& [stamp_ns, pose] : truth) {
    const Eigen::Matrix3d r = pose.matrix3();
    for (int i = 0; i < 3; ++i)
      text += fmt::format("{:.12e} {:.12e} {:.12e} {:.12e}{}", r(i, 0), r(i, 1), r(i, 2), pose.translation[i],
                          i < 2 ? ' ' : '\n');
  }
  return text;
}

std::string format_calib(const Calibration& calibration) {
  return format_projection("P0", calibration.camera, 0) +
         format_projection("P1", calibration.camera, *calibration.baseline);
}

/// Formats poses of a body as EuRoC has them, whose names of columns say that they are a body's.
std::string format_body_poses(const SimulatedStreet& street) {
  std::string text =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
  for (const auto& [stamp_ns, pose] : street.body_poses()) {
    const auto& t = pose.translation;
    const auto& q = pose.rotation;
    text += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f}\n", stamp_ns, t.x(), t.y(),
                        t.z(), q.w(), q.x(), q.y(), q.z());
  }
  return text;
}

/// Writes the poses with planted errors, if there are any.
void write_given_poses(const SimulatedStreet& street, const fs::path& folder) {
  if (!street.pose_error().is_any()) return;
  const bool are_of_body = street.calibration().body_from_camera.has_value();
  write_file(folder / (are_of_body ? "given_body_poses.csv" : "given_poses.txt"),
             format_pose_table(street.pose_error(), street.given_poses(), are_of_body ? ',' : ' '));
}

/// Writes left and right image of frame i; the paths written.
std::vector<fs::path> write_pair(const fs::path& folder, int i, const GrayImage& left,
                                 const GrayImage& right) {
  const std::string name = fmt::format("{:06}.png", i);
  std::vector<fs::path> written{folder / "image_0" / name, folder / "image_1" / name};
  write_png(written[0], left);
  write_png(written[1], right);
  return written;
}

/// Nothing, and `failure` the InputError, where it cannot be read.
std::optional<Frame> try_to_load(const FrameLoader& loader, FrameId id, std::exception_ptr& failure) {
  try {
    return loader.load(id);
  } catch (const InputError&) {
    failure = std::current_exception();
    return std::nullopt;
  }
}

/// Says which frames were left out, null for those that were not; their number.
int report_skipped(const std::vector<std::exception_ptr>& failures, Progress& progress) {
  SkippedFrames skipped(progress);
  for (const std::exception_ptr& failure : failures) failure ? skipped.skip(failure) : skipped.take();
  skipped.finish();
  return static_cast<int>(skipped.count());
}

void expect_stereo(const Sequence& sequence) {
  if (sequence.calibration.baseline && !sequence.frames.front().right.empty()) return;
  throw InputError({sequence.folder.string(), 0, "a stereo sequence with both cameras calibrated",
                    fmt::format("a sequence of format {}{}", sequence.format,
                                sequence.calibration.baseline ? "" : " without 'right' in its calibration"),
                    "Name a stereo sequence, or give --camera FILE (README, \"Calibration\")."});
}

/// Writes a camera.yaml that states the field of disparities, which the images of a corrected pair still
/// have: FrameLoader takes off only the rows.
void write_remaining_correction(const Calibration& recorded, const fs::path& folder) {
  if (!recorded.right_correction || recorded.right_correction->disparity.isZero(0)) return;
  Calibration rectified;
  rectified.camera = recorded.camera;
  rectified.baseline = recorded.baseline;
  rectified.right_correction.emplace().disparity = recorded.right_correction->disparity;
  write_file(folder / "camera.yaml", format_calibration(rectified));
}

}  // namespace

SimulationReport write_kitti(const SimulatedStreet& street, const fs::path& folder, bool depth_truth,
                             const Executor& executor, Progress& progress) {
  make_folder(folder / "image_0");
  make_folder(folder / "image_1");
  if (depth_truth) make_folder(folder / "depth_truth");
  const int frames = write_frames("simulate", street.size(), executor, progress, [&](int i) {
    const SimulatedStereoFrame frame = street.render(i);
    std::vector<fs::path> written = write_pair(folder, i, frame.left, frame.right);
    if (depth_truth) {
      written.push_back(folder / "depth_truth" / written[0].filename());
      write_png(written[2], store_depth(frame.depth_true, kDepthScale));
    }
    return written;
  });
  const Trajectory whole = street.truth();
  const Trajectory truth(whole.begin(), whole.begin() + frames);
  std::string times;
  for (const StampedPose& pose : truth) times += format_stamp(pose.stamp_ns) + '\n';
  write_file(folder / "calib.txt", format_calib(street.calibration()));
  write_file(folder / "times.txt", times);
  write_file(folder / "poses.txt", format_poses(truth));
  if (street.calibration().body_from_camera) {
    write_file(folder / "camera.yaml", format_calibration(street.calibration()));
    write_file(folder / "body_poses.csv", format_body_poses(street));
  }
  write_given_poses(street, folder);
  return report_on(whole, frames);
}

RectifiedReport write_rectified(const Sequence& sequence, const fs::path& folder, const Executor& executor,
                                Progress& progress) {
  expect_stereo(sequence);
  make_folder(folder / "image_0");
  make_folder(folder / "image_1");
  const FrameLoader loader(sequence);
  RectifiedReport report;
  const auto count = static_cast<int>(sequence.frames.size());
  std::vector<std::exception_ptr> failures(sequence.frames.size());
  const int done = write_frames("rectify", count, executor, progress, [&](int i) {
    const auto frame = try_to_load(loader, FrameId{i}, failures[static_cast<std::size_t>(i)]);
    return frame ? write_pair(folder, i, frame->gray, frame->right) : std::vector<fs::path>();
  });
  report.stopped = done < count;
  failures.resize(static_cast<std::size_t>(done));
  report.unreadable = report_skipped(failures, progress);
  report.frames = done - report.unreadable;
  const auto poses =
      sequence.truth ? poses_of_frames(sequence, {}) : std::vector<std::optional<WorldFromCamera>>();
  std::string times;
  Trajectory truth;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (failures[i]) continue;
    const std::int64_t stamp_ns = sequence.frames[i].stamp_ns;
    times += format_stamp(stamp_ns) + '\n';
    if (!poses.empty() && poses[i]) truth.push_back({stamp_ns, *poses[i]});
  }
  report.has_poses = static_cast<int>(truth.size()) == report.frames;
  write_file(folder / "calib.txt", format_calib(sequence.calibration));
  write_remaining_correction(sequence.calibration, folder);
  write_file(folder / "times.txt", times);
  if (report.has_poses) write_file(folder / "poses.txt", format_poses(truth));
  return report;
}

}  // namespace cairn
