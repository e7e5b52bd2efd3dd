// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/core/error.h"
#include "cairn/core/progress.h"

namespace cairn {

/// Counts the frames of a recording that cannot be read and are left out: an image that is missing, empty,
/// truncated or of another size. Warns of each once one frame could be read, and of none if none can: then
/// one error says so. Of very many it warns of the first ten one by one.
class SkippedFrames {
 public:
  /// Reports to `progress`; `noun` is the word for a frame in messages.
  explicit SkippedFrames(Progress& progress, std::string noun = "frame")
      : progress_(progress), noun_(std::move(noun)) {}

  /// Skips a frame that cannot be read because of the InputError `failure`; `warning` is the message.
  void skip(const std::exception_ptr& failure, std::string warning);
  /// Skips a frame that cannot be read because of the InputError `failure`; warns with its message and that
  /// the frame is skipped.
  void skip(const std::exception_ptr& failure);
  /// Notes that a frame could be read.
  void take();
  /// Warns of the number of frames that were skipped without a warning of their own. Throws InputError if
  /// frames were skipped and none could be read: that of the first, with their number.
  void finish();

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(messages_.size()); }
  /// Returns the message for each skipped frame, in the order of the frames.
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  void warn(const std::string& message);

  Progress& progress_;
  std::string noun_;
  bool any_read_ = false;
  std::int64_t warned_ = 0;
  std::optional<InputError> first_;
  std::vector<std::string> messages_, held_back_;
};

}  // namespace cairn
