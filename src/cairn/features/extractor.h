// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cairn/features/features.h"
#include "cairn/image/image.h"

namespace cairn {

struct FeatureOptions {
  std::string detector = "ORB";    ///< see detector_names()
  std::string descriptor = "ORB";  ///< see descriptor_names()
  int count = 1000;  ///< at most so many per image: enough for any pose, few enough to match in 3 ms

  /// InputError for a name that does not exist, a pair that does not fit together, a count below 1.
  void validate() const;
};

[[nodiscard]] const std::vector<std::string>& detector_names();
[[nodiscard]] const std::vector<std::string>& descriptor_names();

/// Finds and describes features. Deterministic; one object may be used by several threads.
class Extractor {
 public:
  virtual ~Extractor() = default;
  [[nodiscard]] virtual Features extract(const GrayImage& image) const = 0;
};

/// The extractor that the options name; validates them.
[[nodiscard]] std::unique_ptr<Extractor> make_extractor(const FeatureOptions& options);

}  // namespace cairn
