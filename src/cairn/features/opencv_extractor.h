// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/features/extractor.h"

namespace cairn {

/// OpenCV's detectors and descriptors; the names are valid, fit together and are in capitals.
[[nodiscard]] std::unique_ptr<Extractor> make_opencv_extractor(const FeatureOptions& options);

}  // namespace cairn
