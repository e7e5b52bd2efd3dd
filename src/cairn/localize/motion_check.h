// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cairn/localize/localizer.h"

namespace cairn {

/// Whether the poses of images in a row can be those of one camera on its way: each has to lie where the two
/// before it and a bounded acceleration a let it, at most a t12 (t12 + t01) / 2 away from where a steady
/// motion leads (t01, t12: the times between the three), plus what a trusted pose may be off.
class MotionCheck {
 public:
  explicit MotionCheck(const TrustOptions& options) : options_(options) {}

  /// Calls a good pose weak where it does not fit. Images in the order of their stamps; those without a pose
  /// are passed over.
  void check(std::int64_t stamp_ns, Localization& found);

 private:
  struct StampedPose {
    std::int64_t stamp_ns = 0;
    WorldFromCamera world_from_camera;
  };
  [[nodiscard]] bool fits(const StampedPose& now) const;

  TrustOptions options_;
  std::optional<StampedPose> before_, last_;
};

}  // namespace cairn
