// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cairn {

/// Decompresses what LZF made (M. Lehmann's liblzf), as PCL's binary_compressed has it, into `size` bytes.
/// Returns nullopt unless the bytes are whole and give exactly as many; allocates no more than 264 times
/// their number.
[[nodiscard]] std::optional<std::string> decompress_lzf(std::string_view packed, std::size_t size);

}  // namespace cairn
