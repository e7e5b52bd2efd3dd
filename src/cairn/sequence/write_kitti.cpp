// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/write_kitti.h"

#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/image/codec.h"
#include "cairn/sequence/sensor_noise.h"

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

std::string format_times(const Trajectory& truth) {
  std::string text;
  for (const StampedPose& pose : truth)
    text += fmt::format("{:.9e}\n", 1e-9 * static_cast<double>(pose.stamp_ns));
  return text;
}

}  // namespace

SimulationReport write_kitti(const SimulatedStreet& street, const fs::path& folder, bool depth_truth,
                             const Executor& executor, Progress& progress) {
  make_folder(folder / "image_0");
  make_folder(folder / "image_1");
  if (depth_truth) make_folder(folder / "depth_truth");
  const int frames = write_frames(street.size(), executor, progress, [&](int i) {
    const SimulatedStereoFrame frame = street.render(i);
    const std::string name = fmt::format("{:06}.png", i);
    std::vector<fs::path> written{folder / "image_0" / name, folder / "image_1" / name};
    write_png(written[0], frame.left);
    write_png(written[1], frame.right);
    if (depth_truth) {
      written.push_back(folder / "depth_truth" / name);
      write_png(written[2], store_depth(frame.depth_true, kDepthScale));
    }
    return written;
  });
  const Trajectory whole = street.truth();
  const Trajectory truth(whole.begin(), whole.begin() + frames);
  const Calibration calibration = street.calibration();
  write_file(folder / "calib.txt", format_projection("P0", calibration.camera, 0) +
                                       format_projection("P1", calibration.camera, *calibration.baseline));
  write_file(folder / "times.txt", format_times(truth));
  write_file(folder / "poses.txt", format_poses(truth));
  return report_on(whole, frames);
}

}  // namespace cairn
