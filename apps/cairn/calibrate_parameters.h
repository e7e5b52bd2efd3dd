// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/parameter.h"
#include "cairn/sequence/sequence.h"
#include "cairn/slam/options.h"

namespace cairn::app {

/// Everything that `cairn calibrate` can be told by --config and --set.
struct CalibrateParameters {
  SequenceOptions sequence;
  SlamOptions slam;
};

/// Visits all parameters of `cairn calibrate`.
void visit(CalibrateParameters& parameters, ParameterVisitor& visitor);

}  // namespace cairn::app
