// SPDX-License-Identifier: Apache-2.0
#include "cairn/map_files/map_text_files.h"

#include <fmt/format.h>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/text.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

void check_map_text(const std::filesystem::path& folder, const MapInfo& info, const char* name) {
  const std::filesystem::path path = folder / name;
  if (info.checksum_of(name) != crc32(read_file(path)))
    throw InputError({path.string(), 0, "contents that fit their CRC-32 in map.json",
                      "others: the file is damaged or was changed", std::string(kMapRemedy)});
}

std::vector<WorldFromCamera> read_map_poses(const std::filesystem::path& folder, const MapInfo& info) {
  check_map_text(folder, info, kPosesFile);
  const TextFile file(folder / kPosesFile);
  if (file.lines().size() != info.keyframes.size())
    throw InputError({file.path().string(), 0,
                      fmt::format("{} poses, as map.json says", info.keyframes.size()),
                      fmt::format("{}", file.lines().size()), std::string(kMapRemedy)});
  std::vector<WorldFromCamera> poses;
  for (const TextLine& line : file.lines()) {
    file.expect_fields(line, 8, "t tx ty tz qx qy qz qw");
    const StampedPose pose = parse_tum_pose(file, line, 0);
    if (const auto stamp_ns = info.keyframes[poses.size()].stamp_ns; pose.stamp_ns != stamp_ns)
      file.fail(line, fmt::format("the stamp {}, as map.json says", format_stamp(stamp_ns)),
                format_stamp(pose.stamp_ns), std::string(kMapRemedy));
    poses.push_back(pose.world_from_camera);
  }
  return poses;
}

}  // namespace cairn
