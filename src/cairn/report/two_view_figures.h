// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/report/two_view_report.h"

namespace cairn {

/// Returns the reprojection error of the points, root mean square over both views, pixels. There are points.
[[nodiscard]] double rms_px(const TwoViewReport& report);

}  // namespace cairn
