// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// Tells whether the name ends in .ply or .pcd, in capitals or not.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);
/// Throws InputError unless the name ends in .ply or .pcd; to be called before long work.
void require_cloud_file(const std::filesystem::path& path);

/// Reads a cloud in the format of the extension, see ply.h and pcd.h.
[[nodiscard]] Cloud read_cloud(const std::filesystem::path& path);
/// Writes a cloud in the format of the extension, see ply.h and pcd.h.
void write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
