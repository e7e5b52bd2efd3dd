// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Returns format, frames, association, cameras and truth of a sequence, for people. `unreadable` of its
/// frames cannot be read.
[[nodiscard]] std::string format_sequence_text(const Sequence& sequence, std::int64_t unreadable);
/// Returns the same as a JSON object, numbers in full.
[[nodiscard]] std::string format_sequence_json(const Sequence& sequence, std::int64_t unreadable);

}  // namespace cairn
