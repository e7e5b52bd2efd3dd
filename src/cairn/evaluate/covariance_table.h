// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cairn/geometry/rigid3.h"

namespace cairn {

/// Prefixes of the 21 columns of a covariance in localization.csv: absolute, that is with what the map itself
/// is uncertain by, and within the map alone.
inline constexpr std::array<std::string_view, 2> kLocalizationPrefixes = {"abs_cov_", "cov_"};
/// Prefixes in keyframe_covariances.csv: of the motion from the first keyframe of the component, and from the
/// keyframe of the row before.
inline constexpr std::array<std::string_view, 2> kKeyframePrefixes = {"first_cov_", "previous_cov_"};

/// Returns the names of the 21 columns of a covariance: PREFIXrx_rx, PREFIXrx_ry, ..., PREFIXz_z, the upper
/// triangle by rows.
[[nodiscard]] std::vector<std::string> covariance_columns(std::string_view prefix);

/// Holds what a row of a table states of one pose.
struct CovarianceRow {
  std::int64_t stamp_ns = 0;
  int line = 0;          ///< 1-based
  bool is_weak = false;  ///< the table calls the pose weak, that is, not to be trusted
  /// For each of CovarianceTable::prefixes, of the left perturbation of camera_from_world, rotation first
  /// (radians, metres), symmetric and positive definite. Nullopt if the row states none: the fields are
  /// empty, all zero or not finite, or the pose is weak and the covariance not positive definite.
  std::vector<std::optional<Matrix6d>> covariances;
};

/// Holds the covariances of poses that a CSV file states.
struct CovarianceTable {
  std::filesystem::path path;
  int header_line = 0;                ///< 1-based
  std::vector<std::string> prefixes;  ///< those of the prefixes asked for that the file has, in their order
  std::vector<CovarianceRow> rows;    ///< stamps strictly increase
};

/// Reads the covariances of poses in a CSV file: lines that begin with '#' are comments, the first other one
/// names the columns. `stamp_s` is needed; of the 21 columns of a covariance, PREFIXrx_rx, PREFIXrx_ry, ...,
/// PREFIXz_z (the upper triangle by rows), a file has all or none. If there is a column `verdict`, rows of
/// the verdict `none` are left out. Commas in a column `file` do no harm. Throws InputError if the file
/// cannot be read, is not such a table, stamps do not increase, or the covariance of a pose that is not weak
/// is not positive definite.
[[nodiscard]] CovarianceTable read_covariance_table(const std::filesystem::path& path,
                                                    std::span<const std::string_view> prefixes);

}  // namespace cairn
