// SPDX-License-Identifier: Apache-2.0
#include "map_parameters.h"

namespace cairn::app {

void visit(MapParameters& parameters, ParameterVisitor& visitor) {
  visit(parameters.sequence, visitor);
  visit(parameters.survey, visitor);
}

}  // namespace cairn::app
