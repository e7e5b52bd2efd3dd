// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// Reads the points of a PCD file (Point Cloud Library), ascii, binary or binary_compressed; skips other
/// fields. Throws InputError for any defect; checks sizes before it trusts counts.
[[nodiscard]] Cloud read_pcd(const std::filesystem::path& path);

/// Writes a binary PCD file, version 0.7: x y z and PCL's packed rgb. The file appears when it is complete.
void write_pcd(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
