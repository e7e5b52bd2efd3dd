// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "cairn/features/features.h"

namespace cairn::testkit {

/// Fills a row of `descriptors` with random bytes that depend on (seed, look) only: points of one look have
/// one descriptor.
void put_look(std::uint64_t seed, std::uint64_t look, std::size_t row, Descriptors& descriptors);

}  // namespace cairn::testkit
