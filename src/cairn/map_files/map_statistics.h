// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cairn/core/distribution.h"
#include "cairn/map_files/map_info.h"

namespace cairn {

/// Holds one indicator of all landmarks.
struct IndicatorDistribution {
  std::string name;  ///< column of uvlist.txt, or "largest_std": metres along the worst direction
  Distribution values;
};

/// Holds what a map contains, and how good its landmarks are.
struct MapStatistics {
  MapInfo info;
  std::map<std::int32_t, std::size_t> component_keyframes;  ///< number of keyframes by component
  std::uint32_t most_observations = 0;                      ///< largest number of observations of a landmark
  std::uint32_t without_covariance =
      /// Landmarks whose covariance is not known; their standard deviations are not counted.
      0;
  std::vector<IndicatorDistribution> indicators;  ///< in the order of uvlist.txt; largest_std after std_z
};

/// Reads all files of the map in `folder` once, piece by piece; memory does not grow with the landmarks.
/// Throws InputError if a file is missing, damaged, of another version, or does not fit the others.
[[nodiscard]] MapStatistics read_map_statistics(const std::filesystem::path& folder);

}  // namespace cairn
