// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace cairn {

/// Summarises a set of errors, in their unit, as evo and the TUM tools (numpy) do.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0;  ///< sqrt(mean of squares)
  double mean = 0;
  double median = 0;  ///< of an even number: mean of the two in the middle
  double std = 0;     ///< about the mean, divided by count (not by count - 1)
  double min = 0;
  double max = 0;
};

/// Computes the statistics. Returns nullopt for no errors. Sums run in order: the same bits each time.
[[nodiscard]] std::optional<ErrorStatistics> summarize_errors(std::span<const double> errors);

/// Returns the error that `percent` (0 to 100) of the errors do not exceed, interpolated linearly between two
/// of them as numpy's percentile does. Throws PreconditionError for no errors or another percentage.
[[nodiscard]] double percentile_of(std::span<const double> errors, double percent);

}  // namespace cairn
