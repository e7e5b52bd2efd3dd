// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/simulate/scene_builder.h"

namespace cairn {

/// Describes a piece of ground along a street: asphalt with a dashed line in the middle of its road and
/// pavements. Lengths in metres.
struct StreetGround {
  bool along_x = true;       ///< the street runs along the canvas' columns, otherwise along its rows
  bool near_first = true;    ///< the pavement that is `near` lies at the canvas' upper or left border
  double near_pavement = 0;  ///< width of the pavement at that border
  double far_pavement = 0;   ///< width of the pavement at the opposite border
  double corner = 0;         ///< length at both ends over which the far pavement is missing
};

/// Paints a piece of ground.
[[nodiscard]] Painter street_ground(const StreetGround& ground);
/// Paints the front of a house: a door or a shop window below, windows above, in its own colours.
[[nodiscard]] Painter house_front();
/// Paints bare bricks.
[[nodiscard]] Painter brick_wall();
[[nodiscard]] Painter car_body();
[[nodiscard]] Painter pole();
[[nodiscard]] Painter leaves();

}  // namespace cairn
