// SPDX-License-Identifier: Apache-2.0
#include "cairn/sequence/skipped_frames.h"

#include <fmt/format.h>

#include <utility>

namespace cairn {
namespace {

constexpr std::int64_t kMostWarnings = 10;

InputError input_error(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const InputError& error) {
    return error;
  }
}

}  // namespace

void SkippedFrames::skip(const std::exception_ptr& failure, std::string warning) {
  const InputError error = input_error(failure);
  if (!first_) first_ = error;
  messages_.emplace_back(error.what());
  any_read_ ? warn(warning) : held_back_.push_back(std::move(warning));
}

void SkippedFrames::skip(const std::exception_ptr& failure) {
  skip(failure, fmt::format("{} The {} is skipped.", input_error(failure).what(), noun_));
}

void SkippedFrames::take() {
  any_read_ = true;
  for (const std::string& message : std::exchange(held_back_, {})) warn(message);
}

void SkippedFrames::warn(const std::string& message) {
  if (++warned_ <= kMostWarnings) progress_.warn(message);
}

void SkippedFrames::finish() {
  if (first_ && !any_read_) {
    InputError::Details details = first_->details();
    if (count() > 1) details.found += fmt::format("; and none of {} {}s can be read", count(), noun_);
    throw InputError(details);
  }
  if (warned_ <= kMostWarnings) return;
  progress_.warn(fmt::format("{} more {}s cannot be read and are skipped.", warned_ - kMostWarnings, noun_));
  warned_ = 0;
}

}  // namespace cairn
