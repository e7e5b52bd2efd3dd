// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/sample_frames.h"

#include <algorithm>

namespace cairn {

std::vector<FrameId> sample_frames(std::size_t count, std::size_t wanted) {
  const std::size_t chosen = std::min(count, wanted);
  std::vector<FrameId> frames;
  for (std::size_t i = 0; i < chosen; ++i)
    frames.push_back({static_cast<std::int32_t>(chosen < 2 ? 0 : i * (count - 1) / (chosen - 1))});
  return frames;
}

}  // namespace cairn
