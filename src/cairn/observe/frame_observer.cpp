// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/frame_observer.h"

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"
#include "cairn/image/resize.h"

namespace cairn {

namespace {

/// Returns the calibration of resized images.
Calibration with_camera(Calibration calibration, const Camera& camera) {
  if (calibration.right_correction)
    calibration.right_correction->disparity *= camera.fx / calibration.camera.fx;
  calibration.camera = camera;
  return calibration;
}

}  // namespace

FrameObserver::FrameObserver(const Sequence& sequence, const ObserverOptions& options)
    : FrameObserver(sequence, options, sequence.calibration.camera) {}

FrameObserver::FrameObserver(const Sequence& sequence, const ObserverOptions& options, const Camera& resized)
    : loader_(sequence),
      width_(resized.width),
      height_(resized.height),
      observer_(with_camera(sequence.calibration, resized), options) {}

Frame FrameObserver::resize(Frame frame) const {
  if (frame.gray.width() == width_ && frame.gray.height() == height_) return frame;
  frame.gray = resize_image(frame.gray, width_, height_);
  if (!frame.right.empty()) frame.right = resize_image(frame.right, width_, height_);
  if (!frame.depth.empty()) frame.depth = resize_depth(frame.depth, width_, height_);
  return frame;
}

LoadedFrame FrameObserver::load(std::size_t index) const {
  LoadedFrame loaded;
  Stopwatch watch;
  try {
    Frame frame = loader_.load({static_cast<std::int32_t>(index)});
    loaded.decode_seconds = watch.lap();
    loaded.observed = observer_.observe(resize(std::move(frame)));
    loaded.feature_seconds = watch.lap();
  } catch (const InputError& error) {
    loaded.error = error.what();
    loaded.failure = std::current_exception();
  }
  return loaded;
}

}  // namespace cairn
