// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "cairn/observe/observer.h"

namespace cairn {

/// Holds a decoded and observed frame, or why it could not be decoded.
struct LoadedFrame {
  ObservedFrame observed;
  std::string error;           ///< why it could not be decoded; empty if it could
  std::exception_ptr failure;  ///< the InputError of `error`, to be thrown again; null if it could be decoded
  double decode_seconds = 0, feature_seconds = 0;
};

/// Decodes and observes frames of a sequence, which must live as long. Safe to use from several threads.
class FrameObserver {
 public:
  FrameObserver(const Sequence& sequence, const ObserverOptions& options);
  /// Observes frames that are resized first: `resized` is the sequence's camera after resized_camera.
  FrameObserver(const Sequence& sequence, const ObserverOptions& options, const Camera& resized);
  /// Decodes and observes the frame at position `index`. An InputError is stored in the result, not thrown.
  [[nodiscard]] LoadedFrame load(std::size_t index) const;

 private:
  [[nodiscard]] Frame resize(Frame frame) const;

  FrameLoader loader_;
  int width_, height_;  // of the frames that are observed
  Observer observer_;
};

}  // namespace cairn
