// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/core/parameter.h"
#include "cairn/sequence/sequence.h"
#include "cairn/survey/options.h"

namespace cairn::app {

/// Everything that `cairn map` can be told by --config and --set.
struct MapParameters {
  SequenceOptions sequence;
  SurveyOptions survey;
};

/// Visits all parameters of `cairn map`, in the order of config.yaml.
void visit(MapParameters& parameters, ParameterVisitor& visitor);

}  // namespace cairn::app
