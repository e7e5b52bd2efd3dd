// SPDX-License-Identifier: Apache-2.0
#include "cairn/frontend/frontend.h"

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/image/resize.h"

namespace cairn {

namespace {

Calibration with_camera(Calibration calibration, const Camera& camera) {
  calibration.camera = camera;
  return calibration;
}

}  // namespace

Frontend::Frontend(const Sequence& sequence, const ObserverOptions& options)
    : Frontend(sequence, options, sequence.calibration.camera) {}

Frontend::Frontend(const Sequence& sequence, const ObserverOptions& options, const Camera& resized)
    : loader_(sequence),
      width_(resized.width),
      height_(resized.height),
      observer_(with_camera(sequence.calibration, resized), options) {}

Frame Frontend::resize(Frame frame) const {
  if (frame.gray.width() == width_ && frame.gray.height() == height_) return frame;
  frame.gray = resize_image(frame.gray, width_, height_);
  if (!frame.right.empty()) frame.right = resize_image(frame.right, width_, height_);
  if (!frame.depth.empty()) frame.depth = resize_depth(frame.depth, width_, height_);
  return frame;
}

Arrival Frontend::operator()(std::size_t index) const {
  Arrival arrival;
  Stopwatch watch;
  try {
    Frame frame = loader_.load({static_cast<std::int32_t>(index)});
    arrival.decode_seconds = watch.lap();
    arrival.observed = observer_.observe(resize(std::move(frame)));
    arrival.feature_seconds = watch.lap();
  } catch (const InputError& error) {
    arrival.error = error.what();
    arrival.failure = std::current_exception();
  }
  return arrival;
}

}  // namespace cairn
