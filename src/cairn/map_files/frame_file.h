// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cairn/map/map.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// Holds the contents of a file in frames/: feature i of keyframe `number` was observed as `observed` says
/// and shows landmark landmarks[i], none if that is not valid.
struct FrameFile {
  KeyframeId number;
  ObservedFrame observed;
  std::vector<LandmarkId> landmarks;
};

/// Returns an observation as it is stored, that is, in single precision.
[[nodiscard]] Observation as_stored(const Observation& seen);

/// Returns the bytes of a file in frames/. `kind` is that of the descriptors, also if there are no features.
/// Throws PreconditionError for impossible values, or for another number or kind of descriptors.
[[nodiscard]] std::string format_frame_file(KeyframeId number, const ObservedFrame& observed,
                                            std::span<const LandmarkId> landmarks,
                                            const DescriptorKind& kind);

/// Reads keyframe `number` of the map in `folder`, as announced by `info`. Its keypoints have no response.
/// Throws InputError if the file is missing, damaged, of another version, not the one announced, or holds
/// impossible values.
[[nodiscard]] FrameFile read_frame_file(const std::filesystem::path& folder, const MapInfo& info,
                                        KeyframeId number);

}  // namespace cairn
