// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// True for a name that ends in .ply or .pcd.
[[nodiscard]] bool is_cloud_file(const std::filesystem::path& path);
/// InputError unless the name ends in .ply or .pcd: to be called before long work.
void require_cloud_file(const std::filesystem::path& path);

/// By the extension: see ply.h and pcd.h.
[[nodiscard]] Cloud read_cloud(const std::filesystem::path& path);
void write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
