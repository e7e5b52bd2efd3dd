// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "cairn/image/image.h"
#include "cairn/map/map.h"

namespace cairn {

/// Holds a feature of a keyframe as pixels of the images on disk.
struct RecordedFeature {
  float u = 0, v = 0;              ///< pixel of the left image, (0, 0) the centre of the first pixel
  float right_u = 0, right_v = 0;  ///< pixel of the right image
  std::int32_t index = -1,
               right_index = -1;  ///< position in the lists of the left and right image; -1: in none
  std::int32_t landmark = -1;     ///< landmark that it shows; -1: none
  Rgb8 color;                     ///< colour of the left image at the pixel
};

/// Stores the features of all keyframes of a map in a file without a name, which vanishes with this object;
/// memory does not grow with them. Throws InputError if the disk fails.
class RecordedFeatures {
 public:
  /// Creates the file in `folder`.
  explicit RecordedFeatures(const std::filesystem::path& folder);

  /// Appends the features of the next keyframe.
  void add(std::span<const RecordedFeature> features);
  /// Returns a feature of a keyframe that was added. Throws PreconditionError if there is none such.
  [[nodiscard]] RecordedFeature at(const ObservationRef& observation);
  /// Returns whether there is such a feature.
  [[nodiscard]] bool has(const ObservationRef& observation) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<std::uint64_t> begins_{0};  // of each keyframe, and the end; in features
  bool is_flushed_ = true;
};

}  // namespace cairn
