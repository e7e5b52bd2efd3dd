// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/core/error.h"

namespace cairn::testkit {

/// Returns the message of the InputError that `act` throws, or "no InputError" if it throws none.
template <class Act>
std::string message_of(Act act) {
  try {
    (void)act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

}  // namespace cairn::testkit
