// SPDX-License-Identifier: Apache-2.0
#include "cairn/simulate/write_tum.h"

#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/image/codec.h"
#include "cairn/simulate/sensor_noise.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

std::string image_name(const char* folder, std::int64_t stamp_ns) {
  return fmt::format("{}/{}.png", folder, format_stamp(stamp_ns));
}

std::string format_list(const Trajectory& truth, const char* folder) {
  std::string text = "# stamp path\n";
  for (const StampedPose& pose : truth)
    text += fmt::format("{} {}\n", format_stamp(pose.stamp_ns), image_name(folder, pose.stamp_ns));
  return text;
}

std::string format_associations(const Trajectory& truth) {
  std::string text = "# stamp rgb stamp depth\n";
  for (const StampedPose& pose : truth) {
    const std::string stamp = format_stamp(pose.stamp_ns);
    text += fmt::format("{} {} {} {}\n", stamp, image_name("rgb", pose.stamp_ns), stamp,
                        image_name("depth", pose.stamp_ns));
  }
  return text;
}

}  // namespace

SimulationReport write_tum(const SimulatedRoom& room, const fs::path& folder, const Executor& executor,
                           Progress& progress, bool depth_truth) {
  make_folder(folder / "rgb");
  make_folder(folder / "depth");
  if (depth_truth) make_folder(folder / "depth_truth");
  const double depth_scale = room.calibration().depth->scale;
  const int frames = write_frames("simulate", room.size(), executor, progress, [&](int i) {
    const SimulatedRgbdFrame frame = room.render(i);
    std::vector<fs::path> written{folder / image_name("rgb", room.stamp_ns(i)),
                                  folder / image_name("depth", room.stamp_ns(i))};
    write_png(written[0], frame.color);
    write_png(written[1], frame.depth);
    if (depth_truth) {
      written.push_back(folder / image_name("depth_truth", room.stamp_ns(i)));
      write_png(written[2], store_depth(frame.depth_true, depth_scale));
    }
    return written;
  });
  const Trajectory whole = room.truth();
  const Trajectory truth(whole.begin(), whole.begin() + frames);
  write_file(folder / "rgb.txt", format_list(truth, "rgb"));
  write_file(folder / "depth.txt", format_list(truth, "depth"));
  write_file(folder / "associations.txt", format_associations(truth));
  write_file(folder / "groundtruth.txt", format_tum_trajectory(truth));
  write_file(folder / "camera.yaml", format_calibration(room.calibration()));
  if (room.pose_error().is_any())
    write_file(folder / "given_poses.txt", format_pose_table(room.pose_error(), room.given_poses(), ' '));
  return report_on(whole, frames);
}

}  // namespace cairn
