// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>

namespace cairn {

/// Reports bad data from outside: a file, a configuration, a command line. Thrown by whatever reads, caught
/// once in `main`, shown as one message, exit code 2.
class InputError : public std::runtime_error {
 public:
  /// Holds the parts of the message.
  struct Details {
    std::string file;      ///< path or option name
    int line = 0;          ///< 1-based, 0 if there is no line
    std::string expected;  ///< what would have been right
    std::string found;     ///< what was found instead
    std::string remedy;    ///< what to do, a whole sentence
  };

  explicit InputError(Details details);
  [[nodiscard]] const Details& details() const { return details_; }

 private:
  Details details_;
};

/// Reports a broken precondition: an error of the calling code, thrown in every build type.
class PreconditionError : public std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws PreconditionError that names `requirement` and the caller's location unless `condition` holds.
void require(bool condition, std::string_view requirement,
             const std::source_location& where = std::source_location::current());

}  // namespace cairn
