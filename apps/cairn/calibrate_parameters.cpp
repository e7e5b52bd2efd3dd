// SPDX-License-Identifier: Apache-2.0
#include "calibrate_parameters.h"

namespace cairn::app {

void visit(CalibrateParameters& parameters, ParameterVisitor& visitor) {
  visit(parameters.sequence, visitor);
  visit(parameters.slam, visitor);
}

}  // namespace cairn::app
