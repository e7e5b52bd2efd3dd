// SPDX-License-Identifier: Apache-2.0
#include "cairn/report/depth_noise.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

constexpr double kNear = 1, kFar = 3;  // metres

}  // namespace

Json to_json(const std::optional<DisparityNoiseEstimate>& found) {
  if (!found) return nullptr;
  return {{"sigma_disparity_px", found->noise.sigma_px},
          {"sigma_depth_m", found->noise.sigma_m},
          {"sigma_at_1_m", found->noise.of_depth(found->rig, kNear)},
          {"sigma_at_3_m", found->noise.of_depth(found->rig, kFar)},
          {"estimated_from", found->disparities}};
}

std::string describe(const std::optional<DisparityNoiseEstimate>& found) {
  if (!found) return "";
  constexpr double kMillimetres = 1000;
  const std::string source = found->disparities > 0
                                 ? fmt::format("estimated from {} readings", found->disparities)
                             : found->is_assumed ? std::string("assumed, as too few readings show it")
                                                 : std::string("as stated");
  return fmt::format(
      "depth        good to {:.1f} mm at {:g} m and {:.0f} mm at {:g} m (one standard deviation), {}",
      kMillimetres * found->noise.of_depth(found->rig, kNear), kNear,
      kMillimetres * found->noise.of_depth(found->rig, kFar), kFar, source);
}

}  // namespace cairn
