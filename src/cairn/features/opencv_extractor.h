// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/features/extractor.h"

namespace cairn {

/// Makes an extractor of OpenCV's detectors and descriptors. The names must be valid, fit together and be in
/// capitals.
[[nodiscard]] std::unique_ptr<Extractor> make_opencv_extractor(const FeatureOptions& options);

}  // namespace cairn
