// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/geometry/rigid3.h"

namespace cairn::testkit {

/// Returns pose `i` of the drive in evaluate/evaluation_reference.py: 1.3 km, about 3 m a frame.
[[nodiscard]] Rigid3 true_drive(int i);

/// Returns its estimate, 1 % too long and slowly turning away.
[[nodiscard]] Rigid3 estimated_drive(int i);

}  // namespace cairn::testkit
