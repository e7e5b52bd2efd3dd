// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "cairn/observe/observer.h"

namespace cairn {

/// A frame on its way from the disk to the tracker.
struct LoadedFrame {
  ObservedFrame observed;
  std::string error;           ///< not empty: it could not be decoded
  std::exception_ptr failure;  ///< the same, to be thrown again
  double decode_seconds = 0, feature_seconds = 0;
};

/// Decodes and observes frames of a sequence, which must live as long; safe to call from several threads.
class FrameObserver {
 public:
  FrameObserver(const Sequence& sequence, const ObserverOptions& options);
  /// Observes frames that are resized first: `resized` is the sequence's camera after resized_camera.
  FrameObserver(const Sequence& sequence, const ObserverOptions& options, const Camera& resized);
  [[nodiscard]] LoadedFrame load(std::size_t index) const;

 private:
  [[nodiscard]] Frame resize(Frame frame) const;

  FrameLoader loader_;
  int width_, height_;  // of the frames that are observed
  Observer observer_;
};

}  // namespace cairn
