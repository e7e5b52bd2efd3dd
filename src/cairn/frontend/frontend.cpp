// SPDX-License-Identifier: Apache-2.0
#include "cairn/frontend/frontend.h"

#include "cairn/core/error.h"
#include "cairn/core/stopwatch.h"

namespace cairn {

Frontend::Frontend(const Sequence& sequence, const ObserverOptions& options)
    : loader_(sequence), observer_(sequence.calibration, options) {}

Arrival Frontend::operator()(std::size_t index) const {
  Arrival arrival;
  Stopwatch watch;
  try {
    const Frame frame = loader_.load({static_cast<std::int32_t>(index)});
    arrival.decode_seconds = watch.lap();
    arrival.observed = observer_.observe(frame);
    arrival.feature_seconds = watch.lap();
  } catch (const InputError& error) {
    arrival.error = error.what();
    arrival.failure = std::current_exception();
  }
  return arrival;
}

}  // namespace cairn
