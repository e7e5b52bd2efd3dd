// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// Reads the vertices of a PLY file, ascii or binary little endian; skips other properties, lists among them,
/// and what follows the vertices (faces). Throws InputError for any defect; checks sizes before it trusts
/// counts.
[[nodiscard]] Cloud read_ply(const std::filesystem::path& path);

/// Writes a PLY file, binary little endian: x y z as float, red green blue as uchar. The file appears when it
/// is complete.
void write_ply(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
