// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace cairn {

/// Collects a text for people piece by piece.
class TextBuilder {
 public:
  /// Appends the arguments as `format` has them, in the syntax of fmt.
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  /// Appends a text as it is.
  void append(const std::string& text) { text_ += text; }
  /// Returns what was collected and leaves nothing behind.
  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

 private:
  std::string text_;
};

}  // namespace cairn
