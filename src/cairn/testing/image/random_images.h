// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/image/image.h"

namespace cairn::testkit {

/// Returns an image whose grey levels are uniform and independent.
[[nodiscard]] GrayImage random_image(int width, int height, std::uint64_t seed);

/// Returns an image of few grey levels in patches, so that corners, ties and plain ground all occur.
[[nodiscard]] GrayImage blocky_image(int width, int height, std::uint64_t seed);

}  // namespace cairn::testkit
