// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "cairn/core/text.h"
#include "cairn/geometry/rigid3.h"

namespace cairn {

struct StampedBodyPose {
  std::int64_t stamp_ns = 0;
  Rigid3 world_from_body;
};

/// The stamp in a line's first field, whole nanoseconds; InputError unless it comes after `before`, where
/// that is given.
[[nodiscard]] std::int64_t parse_asl_stamp(const TextFile& file, const TextLine& line,
                                           const std::int64_t* before);

/// The body's poses in a data.csv of the ASL layout, `stamp, px, py, pz, qw, qx, qy, qz, ...`; a sensor.yaml
/// beside it says which sensor was tracked. Stamps increase. InputError with the line for whatever is wrong.
[[nodiscard]] std::vector<StampedBodyPose> read_asl_poses(const std::filesystem::path& data_csv);

}  // namespace cairn
