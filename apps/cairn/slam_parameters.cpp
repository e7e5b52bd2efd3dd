// SPDX-License-Identifier: Apache-2.0
#include "slam_parameters.h"

namespace cairn::app {

void visit(SlamParameters& parameters, ParameterVisitor& visitor) {
  visit(parameters.sequence, visitor);
  visit(parameters.slam, visitor);
  visit(parameters.cloud, visitor);
  visit(parameters.octree, visitor);
}

void SlamParameters::validate() const {
  slam.validate();
  cloud.validate();
  octree.validate();
}

}  // namespace cairn::app
