// SPDX-License-Identifier: Apache-2.0
// Put before every source by run_tidy.py only: libstdc++ 12 has no std::source_location for clang 14.
#pragma once
#pragma GCC system_header  // our naming rules do not hold for it
#if defined(__clang__) && !__has_builtin(__builtin_source_location)
namespace std {  // NOLINT
struct source_location {
  static constexpr source_location current(const char* file = __builtin_FILE(),
                                           const char* function = __builtin_FUNCTION(),
                                           unsigned line = __builtin_LINE()) {
    return {file, function, line};
  }
  constexpr const char* file_name() const { return file_; }
  constexpr const char* function_name() const { return function_; }
  constexpr unsigned line() const { return line_; }
  const char* file_;
  const char* function_;
  unsigned line_;
};
}  // namespace std
#endif
