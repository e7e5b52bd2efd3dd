// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/landmark_ply.h"

#include <fmt/format.h>

#include "cairn/core/file.h"
#include "cairn/map_files/landmark_stream.h"
#include "cairn/map_files/map_file.h"
#include "cairn/report/colors.h"

namespace cairn {
namespace {

constexpr std::size_t kLandmarksAtOnce = 4096;

std::string format_header(std::uint32_t landmarks) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by cairn, metres\n"
      "comment colour: standard deviation along the worst direction, logarithmic, dark blue {} m or less to "
      "orange {} m or more, grey unknown\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float std\nend_header\n",
      kLowStd, kHighStd, landmarks);
}

void put_vertex(const StoredLandmark& landmark, ByteWriter& writer) {
  const double std = largest_std(landmark);
  const Rgb8 color = std_rgb(std);
  for (const double coordinate : landmark.point_in_world) writer.put(coordinate);
  for (const std::uint8_t channel : {color.r, color.g, color.b}) writer.put(channel);
  writer.put(static_cast<float>(std));
}

}  // namespace

void write_landmark_ply(const std::filesystem::path& map_folder, const std::filesystem::path& path) {
  const std::filesystem::path folder = require_map_folder(map_folder);
  const MapInfo info = read_map_info(folder / kMapInfoFile);
  LandmarkStream landmarks(folder, info);
  AtomicFile file(path);
  file.write(format_header(info.landmarks));
  ByteWriter writer;
  for (std::uint32_t i = 1; const auto landmark = landmarks.next(); ++i) {
    put_vertex(*landmark, writer);
    if (i % kLandmarksAtOnce != 0) continue;
    file.write(writer.bytes());
    writer = {};
  }
  file.write(writer.bytes());
  file.commit();
}

}  // namespace cairn
