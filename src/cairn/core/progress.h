// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cairn {

/// Receives the progress of long work and tells whether to stop. The library calls it from one thread at a
/// time; the program shows it as a bar. This base is silent and never stops.
class Progress {
 public:
  virtual ~Progress() = default;

  /// Begins a stage of `total` items called `unit` ("frames").
  virtual void start(std::string_view stage, std::int64_t total, std::string_view unit) {
    (void)stage, (void)total, (void)unit;
  }
  /// Reports that `done` items of the stage are finished.
  virtual void update(std::int64_t done) { (void)done; }
  /// Ends the stage.
  virtual void finish() {}
  /// Reports something a person should know, such as a frame that was skipped.
  virtual void warn(const std::string& message) { (void)message; }
  /// Returns true once the user has asked to stop (Ctrl-C): finish the outputs of what is done.
  [[nodiscard]] virtual bool stop_requested() const { return false; }
};

}  // namespace cairn
