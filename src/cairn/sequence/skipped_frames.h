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

/// Keeps account of the frames of a recording that cannot be read and are left out: an image that is missing,
/// empty, cut or of another size. Warns of each as soon as one frame could be read, and of none where none
/// can: then one error says so. Of very many it warns of the first ten one by one.
class SkippedFrames {
 public:
  /// `noun`: what a frame is called in what is said of it.
  explicit SkippedFrames(Progress& progress, std::string noun = "frame")
      : progress_(progress), noun_(std::move(noun)) {}

  /// A frame cannot be read, for the InputError `failure`; `warning` is what to say of it.
  void skip(const std::exception_ptr& failure, std::string warning);
  /// The same, with what the InputError says and that the frame is skipped.
  void skip(const std::exception_ptr& failure);
  /// A frame could be read.
  void take();
  /// Says how many frames were skipped without a word of their own. InputError where frames were skipped and
  /// none could be read: that of the first, with their number.
  void finish();

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(messages_.size()); }
  /// What is wrong with each, in the order of the frames.
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
