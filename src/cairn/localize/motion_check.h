// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/localize/localizer.h"
#include "cairn/sequence/trajectory.h"

namespace cairn {

/// Checks whether the poses of successive images can be those of one camera in motion. With the times t01 and
/// t12 between three poses, the third must lie within a t12 (t12 + t01) / 2 of where a steady motion leads,
/// for a bounded acceleration a, plus the error that is allowed for a trusted pose; for position and rotation
/// each.
class MotionCheck {
 public:
  explicit MotionCheck(const TrustOptions& options) : options_(options) {}

  /// Makes a good pose weak if it does not fit. To be called in the order of stamps; images without a pose
  /// are ignored.
  void check(std::int64_t stamp_ns, Localization& found);

 private:
  [[nodiscard]] bool fits(const StampedPose& now) const;

  TrustOptions options_;
  std::optional<StampedPose> before_, last_;
};

}  // namespace cairn
