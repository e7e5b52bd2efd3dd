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

/// One indicator of all landmarks.
struct IndicatorDistribution {
  std::string name;  ///< a column of uvlist.txt, or "largest_std": metres along the worst direction
  Distribution values;
};

/// What a map holds, and how good its landmarks are.
struct MapStatistics {
  MapInfo info;
  std::map<std::int32_t, std::size_t> component_keyframes;  ///< by component
  std::uint32_t most_observations = 0;                      ///< of one landmark
  std::uint32_t without_covariance =
      0;  ///< landmarks whose covariance was not computed: no "std" of theirs is counted
  std::vector<IndicatorDistribution> indicators;  ///< in the order of uvlist.txt
};

/// Reads all files of the map in `folder` once, piece by piece: the memory that it needs does not grow with
/// the landmarks. InputError where a file is missing, damaged, of another version, or does not fit the
/// others.
[[nodiscard]] MapStatistics read_map_statistics(const std::filesystem::path& folder);

}  // namespace cairn
