// SPDX-License-Identifier: Apache-2.0
#include "recording_checks.h"

#include "cairn/observe/depth_scale.h"
#include "cairn/observe/pair_order.h"

namespace cairn::app {

void check_recording(const Sequence& sequence, Progress& progress) {
  check_pair_order(sequence);
  if (const auto doubt = doubt_depth_scale(sequence)) progress.warn(*doubt);
}

}  // namespace cairn::app
