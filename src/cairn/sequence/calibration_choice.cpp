// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/calibration_choice.h"

#include "cairn/core/error.h"
#include "cairn/sequence/calibration_formats.h"
#include "cairn/sequence/camera_numbers.h"
#include "cairn/sequence/formats.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

void take_file(const fs::path& path, ChosenCalibration& chosen) {
  const fs::path file = fs::is_directory(path) ? find_calibration(path).value_or(path) : path;
  chosen.whole = read_calibration(file);
  chosen.source = file.string();
}

void take_named(const std::string& camera, ChosenCalibration& chosen) {
  if (!known_calibration(camera) && fs::exists(camera)) return take_file(camera, chosen);
  chosen.whole = read_named_calibration(camera);
  chosen.source = camera;
}

/// KITTI's and EuRoC's, which say more than a file that happens to lie beside them.
bool carries_calibration(const fs::path& folder) {
  return fs::exists(folder / "calib.txt") || fs::exists(folder / "cam0/sensor.yaml") ||
         fs::exists(folder / "mav0/cam0/sensor.yaml");
}

bool shows_pairs(const Sequence& sequence) {
  return !sequence.frames.empty() && !sequence.frames.front().right.empty();
}

}  // namespace

void ChosenCalibration::apply(Sequence& sequence) const {
  Calibration& calibration = sequence.calibration;
  if (whole) {
    calibration = *whole;
    sequence.calibration_source = source;
    const auto right = right_beside(source);
    if (right && !calibration.baseline && shows_pairs(sequence)) calibration = read_ros_pair(source, *right);
  }
  if (addition) complete_calibration(*addition, calibration);
}

ChosenCalibration choose_calibration(const fs::path& folder, const SequenceOptions& options) {
  ChosenCalibration chosen;
  const fs::path own = folder / "camera.yaml";
  if (fs::exists(own)) chosen.addition = read_calibration_addition(own);
  if (!options.camera.empty() && !gives_numbers(options.camera))
    take_named(options.camera, chosen);
  else if (fs::exists(own) && !chosen.addition)
    take_file(own, chosen);
  else if (const auto found = find_foreign_calibration(folder); found && !carries_calibration(folder))
    take_file(*found, chosen);
  return chosen;
}

}  // namespace cairn
