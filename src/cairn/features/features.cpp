// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/features.h"

#include <cstring>

namespace cairn {

Descriptors select(const Descriptors& all, std::span<const std::size_t> rows) {
  Descriptors some(all.norm(), all.bytes(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) std::memcpy(some.row(i), all.row(rows[i]), all.stride());
  return some;
}

}  // namespace cairn
