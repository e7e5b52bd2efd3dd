// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace cairn {

/// CRC-32 as in zlib, PNG and Python's zlib.crc32 (polynomial 0xEDB88320, reflected).
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

}  // namespace cairn
