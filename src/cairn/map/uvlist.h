// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "cairn/map/map.h"

namespace cairn {

/// The text of uvlist.txt: a table of the landmarks, one row each in their order, for people and scripts.
/// docs/map_format.md has the columns. `covariances` are one for each of `landmarks`. Observations count as
/// they are stored, so that a map that was read gives the same table.
[[nodiscard]] std::string format_uvlist(const Map& map, std::span<const LandmarkId> landmarks,
                                        std::span<const Eigen::Matrix3d> covariances);

}  // namespace cairn
