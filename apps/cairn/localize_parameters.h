// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/core/parameter.h"
#include "cairn/localize/options.h"
#include "cairn/sequence/sequence.h"

namespace cairn::app {

/// Everything that `cairn localize` can be told by --config and --set.
struct LocalizeParameters {
  SequenceOptions sequence;
  LocalizeOptions localize;
  int features = 2000;                          ///< at most so many of an image
  double contrast = FeatureOptions{}.contrast;  ///< of SIFT: the least that a feature has
  std::string descriptor;                       ///< empty: the map's, which it has to be

  /// Throws InputError for a parameter out of range, or a descriptor that is not the map's.
  void validate(const MapInfo& map) const;
};

/// Visits all parameters of `cairn localize`.
void visit(LocalizeParameters& parameters, ParameterVisitor& visitor);

}  // namespace cairn::app
