// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/progress.h"
#include "cairn/sequence/sequence.h"

namespace cairn::app {

/// Looks at a few images of a recording before the work: warns where the scale of its depth is likely
/// another. InputError where left and right images look exchanged.
void check_recording(const Sequence& sequence, Progress& progress);

}  // namespace cairn::app
