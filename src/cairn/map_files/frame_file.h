// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// What a file in frames/ holds of keyframe number `number`: feature i was observed as `observed` says and
/// shows landmark number landmarks[i], or none where that is not valid.
struct FrameFile {
  KeyframeId number;
  ObservedFrame observed;
  std::vector<LandmarkId> landmarks;
};

/// An observation as it is stored: in single precision.
[[nodiscard]] Observation as_stored(const Observation& seen);

/// The contents of the file. The features are described as `kind` says, which matters where there are none.
[[nodiscard]] std::string format_frame_file(KeyframeId number, const ObservedFrame& observed,
                                            std::span<const LandmarkId> landmarks,
                                            const DescriptorKind& kind);

/// Keyframe `number` of the map in `folder`, as `info` announces it. Its keypoints have no response.
/// InputError where the file is missing, damaged, of another version, not the one that was announced, or
/// holds impossible values.
[[nodiscard]] FrameFile read_frame_file(const std::filesystem::path& folder, const MapInfo& info,
                                        KeyframeId number);

}  // namespace cairn
