// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace cairn {

/// Owns uninitialised floats that begin at a cache line, so that vectors of a row do not straddle two. Large
/// blocks are placed in large pages if the system has them: the patches of keypoints lie on hundreds of small
/// pages, more than a processor caches the addresses of.
class AlignedFloats {
 public:
  explicit AlignedFloats(std::size_t count);
  [[nodiscard]] float* data() const { return floats_.get(); }

 private:
  struct Free {
    void operator()(float* floats) const;
  };
  std::unique_ptr<float, Free> floats_;
};

}  // namespace cairn
