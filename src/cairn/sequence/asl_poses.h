// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "cairn/core/text.h"

namespace cairn {

/// Parses the stamp in a line's first field, whole nanoseconds. Throws InputError unless it comes after
/// `before`, if that is given.
[[nodiscard]] std::int64_t parse_asl_stamp(const TextFile& file, const TextLine& line,
                                           const std::int64_t* before);

}  // namespace cairn
