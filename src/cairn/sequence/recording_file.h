// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cairn {

/// Throws InputError if `path` is a video or a ROS bag, by its content or, of a ROS 2 bag, its folder: the
/// message says what it is and how its frames become a folder that is read.
void refuse_recording(const std::filesystem::path& path);

/// Describes the first video or photo of a kind that is not read in a folder; nullopt if there is none.
[[nodiscard]] std::optional<std::string> recording_in(const std::filesystem::path& folder);

}  // namespace cairn
