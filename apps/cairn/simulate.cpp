// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

namespace cairn::app {

int run_simulate(int /*argc*/, char** /*argv*/) {
  return 2;
}

}  // namespace cairn::app
