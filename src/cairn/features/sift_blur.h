// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cairn/core/executor.h"
#include "cairn/features/sift_rows.h"

namespace cairn {

/// Computes the weights of a sampled Gaussian's centre and of its neighbours on one side. Their variance is
/// sigma^2, although the Gaussian is truncated.
[[nodiscard]] std::vector<float> gaussian_weights(double sigma);

/// Filters along columns and rows; the border's pixels repeat outside. `to` has the size of `from`.
void blur(const ScaleLevel& from, const std::vector<float>& weights, const ScaleLevel& to,
          const Executor& executor);

}  // namespace cairn
