// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/held_out_file.h"

#include <fmt/format.h>

#include "cairn/core/text.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_text_files.h"

namespace cairn {
namespace {

constexpr const char* kLayout =
    "keyframe, then rx ry rz x y z of: error to the map's pose, error to the given pose, formal variance, "
    "stated variance";
constexpr std::size_t kColumns = 25;

void append(const Vector6d& values, std::string& line) {
  for (const double value : values) line += fmt::format(" {}", value);
}

Vector6d six_numbers(const TextFile& file, const TextLine& line, std::size_t first) {
  Vector6d values;
  for (Eigen::Index i = 0; i < 6; ++i)
    values[i] = file.number(line, first + static_cast<std::size_t>(i), "error or variance");
  return values;
}

}  // namespace

std::string format_held_out(std::span<const HeldOutFrame> frames) {
  std::string text =
      fmt::format("# {}  (radians and metres, of camera_from_world, camera's axes)\n", kLayout);
  for (const HeldOutFrame& frame : frames) {
    std::string line = fmt::format("{}", frame.keyframe.value);
    for (const Vector6d* values : {&frame.to_map, &frame.to_given, &frame.formal, &frame.stated})
      append(*values, line);
    text += line + "\n";
  }
  return text;
}

std::vector<HeldOutFrame> read_held_out(const std::filesystem::path& folder, const MapInfo& info) {
  std::vector<HeldOutFrame> frames;
  if (!info.checksum_of(kHeldOutFile)) return frames;
  check_map_text(folder, info, kHeldOutFile);
  const TextFile file(folder / kHeldOutFile);
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, kColumns, kLayout);
    const std::int64_t keyframe = file.integer(line, 0, "keyframe");
    if (keyframe < 0 || keyframe >= std::ssize(info.keyframes))
      file.fail(line, fmt::format("a keyframe from 0 to {}", info.keyframes.size() - 1),
                fmt::format("{}", keyframe), std::string(kMapRemedy));
    HeldOutFrame& frame = frames.emplace_back();
    frame.keyframe = {static_cast<std::int32_t>(keyframe)};
    frame.to_map = six_numbers(file, line, 1);
    frame.to_given = six_numbers(file, line, 7);
    frame.formal = six_numbers(file, line, 13);
    frame.stated = six_numbers(file, line, 19);
    if (frame.formal.minCoeff() < 0 || frame.stated.minCoeff() < 0)
      file.fail(line, "variances from 0", "a negative one", std::string(kMapRemedy));
  }
  return frames;
}

}  // namespace cairn
