// SPDX-License-Identifier: Apache-2.0
#include "localize_parameters.h"

#include <fmt/format.h>

#include "cairn/core/error.h"
#include "cairn/core/parameter.h"
#include "observer_parameters.h"

namespace cairn::app {

SettingTable LocalizeParameters::table() {
  SettingTable table;
  bind_sequence(sequence, table);
  table.bind("features", features);
  table.bind("contrast", contrast);
  table.bind("descriptor", descriptor);
  table.bind("keyframes", localize.keyframes);
  table.bind("more_keyframes", localize.more_keyframes);
  table.bind("nearby_keyframes", localize.nearby_keyframes);
  table.bind("max_ratio", localize.max_ratio);
  table.bind("prior_radius_px", localize.prior_radius_px);
  table.bind("radius_px", localize.radius_px);
  table.bind("ransac_iterations", localize.ransac_iterations);
  TrustOptions& trust = localize.trust;
  table.bind("trust.min_inliers", trust.min_inliers);
  table.bind("trust.min_independent", trust.min_independent);
  table.bind("trust.min_cells", trust.min_cells);
  table.bind("trust.max_gdop", trust.max_gdop);
  table.bind("trust.max_position", trust.max_position);
  table.bind("trust.max_angle_deg", trust.max_angle_deg);
  table.bind("trust.max_acceleration", trust.max_acceleration);
  table.bind("trust.max_angular_acceleration", trust.max_angular_acceleration);
  return table;
}

void LocalizeParameters::validate(const MapInfo& map) const {
  localize.validate();
  check_parameter(features >= 1, "features", "at least 1", features);
  if (!descriptor.empty() && descriptor != map.descriptor.name)
    throw InputError({"descriptor", 0, fmt::format("{}, as the map has", map.descriptor.name), descriptor,
                      "Leave it out: images are described as the map is."});
}

}  // namespace cairn::app
