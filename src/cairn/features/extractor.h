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

/// ORB and SIFT are cairn's own and describe only what they detect, SIFT also as ROOTSIFT; OPENCV_ORB,
/// OPENCV_SIFT, AKAZE and BRISK are OpenCV's and go together in any pair that fits. Case does not matter.
struct FeatureOptions {
  std::string detector = "ORB";    ///< see detector_names()
  std::string descriptor = "ORB";  ///< see descriptor_names()
  int count = 1000;  ///< at most so many per image: enough for any pose, few enough to match in 3 ms
  /// SIFT alone: the weakest that is taken, see SiftExtremaOptions. Less gives more features of dim texture.
  double contrast = 0.02;

  /// Throws InputError for a name that does not exist, a pair that does not fit together, a number out of
  /// range.
  void validate() const;
};

/// Visits detector, descriptor, features and contrast.
void visit(FeatureOptions& options, ParameterVisitor& visitor);

[[nodiscard]] const std::vector<std::string>& detector_names();
[[nodiscard]] const std::vector<std::string>& descriptor_names();

/// Finds and describes features. Deterministic: the same bits at any number of threads and on any instruction
/// set (of cairn's own methods). One object may be used by several threads.
class Extractor {
 public:
  virtual ~Extractor() = default;
  /// Any image, also one too small for a patch: then there are no features.
  [[nodiscard]] virtual Features extract(const GrayImage& image, const Executor& executor) const = 0;
  /// On one thread.
  [[nodiscard]] Features extract(const GrayImage& image) const { return extract(image, Executor()); }
};

/// The extractor that the options name; validates them.
[[nodiscard]] std::unique_ptr<Extractor> make_extractor(const FeatureOptions& options);

}  // namespace cairn
