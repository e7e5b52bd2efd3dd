// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace cairn {

/// Reads a list of frames by number, in increasing order: lines of one number, or of two as the keyframe.txt
/// of RGB-D SLAM programs has them, a keyframe and its frame; more columns, words and comments are an error.
/// Numbers that repeat count once. Throws InputError with the line, and for a list of nothing.
[[nodiscard]] std::vector<std::int64_t> read_frame_list(const std::filesystem::path& path);

}  // namespace cairn
