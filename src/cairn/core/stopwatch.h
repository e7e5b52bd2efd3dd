// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace cairn {

/// Measures wall-clock seconds since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return since(begun_); }
  /// Returns the seconds since the last lap, or since it was made.
  double lap() {
    const double seconds = since(lap_);
    lap_ = Clock::now();
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  Clock::time_point begun_ = Clock::now();
  Clock::time_point lap_ = begun_;
};

}  // namespace cairn
