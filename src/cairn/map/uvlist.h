// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "cairn/map/indicators.h"

namespace cairn {

/// First line of uvlist.txt, a table of the landmarks, one row each, for people and scripts.
/// docs/map_format.md has the columns.
[[nodiscard]] std::string uvlist_header();

/// The row of landmark `number`. `covariance` is of the point, square metres.
[[nodiscard]] std::string format_uvlist_row(std::uint32_t number, const Eigen::Vector3d& point_in_world,
                                            const Eigen::Matrix3d& covariance,
                                            const LandmarkIndicators& indicators);

}  // namespace cairn
