// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/checksum.h"

#include <zlib.h>

namespace cairn {

void Crc32::add(std::string_view bytes) {
  if (bytes.empty()) return;  // for a null pointer zlib returns 0, not the value so far
  value_ = static_cast<std::uint32_t>(
      ::crc32_z(value_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::uint32_t crc32(std::string_view bytes) {
  Crc32 checksum;
  checksum.add(bytes);
  return checksum.value();
}

}  // namespace cairn
