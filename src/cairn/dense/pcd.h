// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// The points of a PCD file (Point Cloud Library), ascii or binary; other fields are skipped. InputError for
/// whatever is wrong, binary_compressed included; sizes are checked before counts are believed.
[[nodiscard]] Cloud read_pcd(const std::filesystem::path& path);

/// Binary, version 0.7: x y z and PCL's packed rgb. The file appears when it is complete.
void write_pcd(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
