// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/parameter.h"
#include "cairn/features/features.h"
#include "cairn/image/image.h"

namespace cairn {

/// Selects a detector and a descriptor. ORB and SIFT are cairn's own and describe only what they detect, SIFT
/// also as ROOTSIFT; OPENCV_ORB, OPENCV_SIFT, AKAZE and BRISK are OpenCV's and can be combined if they fit
/// together. Case does not matter.
struct FeatureOptions {
  std::string detector = "ORB";    ///< see detector_names()
  std::string descriptor = "ORB";  ///< see descriptor_names()
  int count = 1000;  ///< maximum number per image: enough for any pose, few enough to match in 3 ms
  /// SIFT only: contrast of the weakest feature, see SiftExtremaOptions. Less gives more features on dim
  /// texture.
  double contrast = 0.02;

  /// Throws InputError if a name is unknown, the pair does not fit together, or a number is out of range.
  void validate() const;
};

/// Visits detector, descriptor, features and contrast.
void visit(FeatureOptions& options, ParameterVisitor& visitor);

/// Returns the known names of detectors, in capitals.
[[nodiscard]] const std::vector<std::string>& detector_names();
/// Returns the known names of descriptors, in capitals.
[[nodiscard]] const std::vector<std::string>& descriptor_names();

/// Detects and describes features. Deterministic: the same bits at any number of threads and on any
/// instruction set (cairn's own methods). One object may be used by several threads.
class Extractor {
 public:
  virtual ~Extractor() = default;
  /// Extracts the features of an image; an image that is too small for a patch has none.
  [[nodiscard]] virtual Features extract(const GrayImage& image, const Executor& executor) const = 0;
  /// Extracts the features on one thread.
  [[nodiscard]] Features extract(const GrayImage& image) const { return extract(image, Executor()); }
};

/// Makes the extractor that the options name. Throws InputError if they are invalid.
[[nodiscard]] std::unique_ptr<Extractor> make_extractor(const FeatureOptions& options);

}  // namespace cairn
