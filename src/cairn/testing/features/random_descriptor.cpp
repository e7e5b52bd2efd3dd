// SPDX-License-Identifier: Apache-2.0
#include "cairn/testing/features/random_descriptor.h"

#include "cairn/core/random.h"

namespace cairn::testkit {

void put_look(std::uint64_t seed, std::uint64_t look, std::size_t row, Descriptors& descriptors) {
  Random bytes(seed, look);
  for (std::size_t b = 0; b < descriptors.bytes(); ++b)
    descriptors.row(row)[b] = static_cast<std::uint8_t>(bytes.index(256));
}

}  // namespace cairn::testkit
