// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// Something found in an image, and how strong it is.
struct Candidate {
  float u = 0, v = 0;
  float strength = 0;
};

/// Positions of at most `count` candidates in an image of this size, ascending: the strongest, but not all
/// from one corner. The image is divided into cells; no cell gives more than `crowding` times its even share
/// before all others had theirs, then the strongest of the rest follow. Ties go to the lower position.
[[nodiscard]] std::vector<std::int32_t> select_spread(std::span<const Candidate> candidates, int count,
                                                      int width, int height, double crowding = 3);

}  // namespace cairn
