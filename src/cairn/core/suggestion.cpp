// SPDX-License-Identifier: Apache-2.0
#include "cairn/core/suggestion.h"

#include <fmt/format.h>

#include <algorithm>

#include "cairn/core/text.h"

namespace cairn {

bool are_alike(std::string_view a, std::string_view b) {
  return 5 * edit_distance(a, b) <= 2 * std::max(a.size(), b.size());
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known,
                       std::string_view otherwise) {
  const std::string nearest = nearest_name(word, known);
  return are_alike(word, nearest) ? fmt::format("Did you mean '{}'?", nearest) : std::string(otherwise);
}

}  // namespace cairn
