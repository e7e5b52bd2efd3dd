// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "cairn/features/extractor.h"
#include "cairn/features/sift_extrema.h"

namespace cairn {

/// Sets SIFT's detector and descriptor.
struct SiftOptions {
  int count = 1000;  ///< maximum number of features per image, at least 1
  int layers = 3;  ///< levels per octave in which extrema are found: most are repeated (Lowe 2004, figure 3)
  bool root = false;  ///< RootSIFT: matches better with the same distance, but does not mix with SIFT
  SiftExtremaOptions extrema;

  /// Throws InputError if a value is out of range.
  void validate() const;
};

/// Makes an extractor of SIFT (Lowe 2004) with descriptors of 128 bytes to compare by Norm::l2.
/// Keypoint::size is the width of the 4x4 cells, 12 sigmas; Keypoint::response is |D| in grey levels;
/// keypoints come strongest first. Throws InputError if an option is out of range.
[[nodiscard]] std::unique_ptr<Extractor> make_sift_extractor(const SiftOptions& options);

}  // namespace cairn
