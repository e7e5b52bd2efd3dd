// SPDX-License-Identifier: Apache-2.0
#include "cairn/survey/identity.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "cairn/core/checksum.h"

namespace cairn {
namespace {

namespace fs = std::filesystem;

template <class Matrix>
void append_numbers(const Matrix& matrix, std::string& text) {
  text.append(reinterpret_cast<const char*>(matrix.data()),
              static_cast<std::size_t>(matrix.size()) * sizeof(double));
}

void append_pose(const GivenPose& pose, std::string& text) {
  append_numbers(pose.world_from_camera.translation, text);
  append_numbers(pose.world_from_camera.rotation.coeffs(), text);
  if (!pose.uncertainty) return;
  append_numbers(pose.uncertainty->position, text);
  append_numbers(pose.uncertainty->rotation, text);
  append_numbers(pose.uncertainty->position_rotation, text);
}

/// Appends name, size and time of modification. A file without them is left to whoever reads it.
void append_file(const fs::path& path, std::string& text) {
  if (path.empty()) return;
  std::error_code no_size, no_time;
  const auto bytes = fs::file_size(path, no_size);
  const auto time = fs::last_write_time(path, no_time);
  text += fmt::format("{} {} {}\n", path.string(), no_size ? 0 : bytes,
                      no_time ? 0 : time.time_since_epoch().count());
}

void append_origin(const GeodeticOrigin& origin, std::string& text) {
  text += fmt::format("{} {} {}\n", origin.latitude_deg, origin.longitude_deg, origin.height_m);
}

}  // namespace

std::uint32_t identity_of(const SurveyInput& input) {
  const Sequence& sequence = input.sequence;
  std::string text = CAIRN_VERSION "\n" + input.settings + format_calibration(sequence.calibration);
  if (input.poses.origin) append_origin(*input.poses.origin, text);
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const FrameFiles& files = sequence.frames[i];
    text += fmt::format("{} {}\n", files.stamp_ns, files.number);
    for (const fs::path* image : {&files.color, &files.depth, &files.right}) append_file(*image, text);
    text += input.poses.frames[i] ? (input.poses.frames[i]->uncertainty ? 'u' : 'p') : '-';
    if (input.poses.frames[i]) append_pose(*input.poses.frames[i], text);
  }
  return crc32(text);
}

}  // namespace cairn
