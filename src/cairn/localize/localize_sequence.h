// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/executor.h"
#include "cairn/core/progress.h"
#include "cairn/localize/localizer.h"
#include "cairn/observe/frame_observer.h"
#include "cairn/sequence/sequence.h"

namespace cairn {

/// What became of one image.
struct LocalizedImage {
  std::int64_t position = 0, stamp_ns = 0;  ///< in the sequence
  std::string file;                         ///< of the image
  Localization found;
  double feature_seconds = 0, localize_seconds = 0;
};

struct LocalizeSequenceOptions {
  /// Where each image of the sequence is thought to be; empty: nothing is known.
  std::vector<std::optional<WorldFromCamera>> priors;
  bool follow = false;  ///< the last good pose is the prior of the next image, and `priors` are not used
  TrustOptions trust;   ///< for the motion between images with times (MotionCheck)
};

struct LocalizedSequence {
  std::vector<LocalizedImage> images;   ///< those that could be read, in order
  std::vector<std::string> unreadable;  ///< what is wrong with each of the others
};

/// Localizes the images of a sequence, one beside the other unless each follows the one before, until a stop
/// is requested. The same result at any number of threads. Throws InputError if no image can be read.
[[nodiscard]] LocalizedSequence localize_sequence(const Localizer& localizer, const Sequence& sequence,
                                                  const FrameObserver& observer,
                                                  const LocalizeSequenceOptions& options,
                                                  const Executor& executor, Progress& progress);

}  // namespace cairn
