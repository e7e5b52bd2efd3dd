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

/// Holds the result of localising one image.
struct LocalizedImage {
  std::int64_t position = 0, stamp_ns = 0;  ///< of the image in the sequence; nanoseconds
  std::string file;                         ///< name of the image file
  Localization found;
  double feature_seconds = 0, localize_seconds = 0;
};

/// Holds the options of localising a sequence.
struct LocalizeSequenceOptions {
  /// Prior pose of each image of the sequence, nullopt if it has none; empty: no image has one.
  std::vector<std::optional<WorldFromCamera>> priors;
  bool follow = false;  ///< use the last good pose as the prior of the next image, instead of `priors`
  TrustOptions trust;   ///< limits on the motion between images with times (MotionCheck)
};

/// Holds the results of localising a sequence.
struct LocalizedSequence {
  std::vector<LocalizedImage> images;   ///< results of the images that could be read, in order
  std::vector<std::string> unreadable;  ///< messages about the other images
};

/// Localises the images of a sequence until a stop is requested, several at once unless `follow` is set.
/// Poses are checked against the motion if the sequence has times. The same result at any number of threads.
/// Throws InputError if no image can be read, and PreconditionError if there are priors, but not one for each
/// image.
[[nodiscard]] LocalizedSequence localize_sequence(const Localizer& localizer, const Sequence& sequence,
                                                  const FrameObserver& observer,
                                                  const LocalizeSequenceOptions& options,
                                                  const Executor& executor, Progress& progress);

}  // namespace cairn
