// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/dense/cloud.h"

namespace cairn {

/// The vertices of a PLY file, ascii or binary little endian; other properties and what follows the vertices
/// (faces) are skipped. InputError for whatever is wrong; sizes are checked before counts are believed.
[[nodiscard]] Cloud read_ply(const std::filesystem::path& path);

/// Binary little endian: x y z as float, red green blue as uchar. The file appears when it is complete.
void write_ply(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace cairn
