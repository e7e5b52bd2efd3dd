// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// Tells whether one word may be the other misspelt: whether at most two letters in five differ.
[[nodiscard]] bool are_alike(std::string_view a, std::string_view b);

/// Returns "Did you mean '...'?" with the nearest of the known names if it is alike, else `otherwise`. Throws
/// PreconditionError if no name is known.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known,
                                     std::string_view otherwise);

}  // namespace cairn
