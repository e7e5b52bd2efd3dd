// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "cairn/slam/slam.h"

namespace cairn::testkit {

/// Writes a simulated room seen by a camera of 320x240 pixels into `folder`, which exists.
void write_small_room(const std::filesystem::path& folder, int frames);

/// Returns the root mean square distance to the truth, metres, both worlds being the first camera's.
[[nodiscard]] double error_m(const Sequence& sequence, const SlamResult& result);

}  // namespace cairn::testkit
