// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Makes a sequence of one frame from a colour image and the depth image that belongs to it. `camera` is what
/// --camera takes (camera_numbers.h); numbers are those of a camera of the colour image's size. Throws
/// InputError if the camera has no scale of depth or the colour image cannot be read.
[[nodiscard]] Sequence open_image_pair(const std::filesystem::path& color, const std::filesystem::path& depth,
                                       const std::string& camera);

}  // namespace cairn
