// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// Wraps an index so that it cannot be mixed up with an index of another kind.
template <class Tag>
struct Id {
  std::int32_t value = -1;

  [[nodiscard]] bool valid() const { return value >= 0; }
  /// Returns the id, which must be valid, as the position in a container.
  [[nodiscard]] std::size_t index() const { return static_cast<std::size_t>(value); }
  auto operator<=>(const Id&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 errs
};

using FrameId = Id<struct FrameTag>;        ///< position of a frame in its sequence, from 0
using KeyframeId = Id<struct KeyframeTag>;  ///< number of a keyframe in its map, from 0
using LandmarkId = Id<struct LandmarkTag>;  ///< number of a landmark in its map, from 0

}  // namespace cairn
