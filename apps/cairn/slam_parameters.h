// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/parameter.h"
#include "cairn/dense/cloud.h"
#include "cairn/dense/occupancy.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"

namespace cairn::app {

/// Everything that `cairn slam` can be told by --config and --set.
struct SlamParameters {
  SequenceOptions sequence;
  SlamOptions slam;
  CloudOptions cloud;
  OccupancyOptions octree;

  /// Throws InputError for a parameter out of range.
  void validate() const;
};

/// Visits all parameters of `cairn slam`, in the order of config.yaml.
void visit(SlamParameters& parameters, ParameterVisitor& visitor);

}  // namespace cairn::app
