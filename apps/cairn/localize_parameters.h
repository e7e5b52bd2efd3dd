// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/localize/options.h"
#include "cairn/sequence/sequence.h"
#include "cairn/sequence/settings.h"

namespace cairn::app {

/// Everything that `cairn localize` can be told by --config and --set.
struct LocalizeParameters {
  SequenceOptions sequence;
  LocalizeOptions localize;
  int features = 2000;                          ///< at most so many of an image
  double contrast = FeatureOptions{}.contrast;  ///< of SIFT: the least that a feature has
  std::string descriptor;                       ///< empty: the map's, which it has to be

  /// The names of the parameters, bound to these fields. Not to be used longer than this object lives.
  [[nodiscard]] SettingTable table();
  /// InputError for a parameter out of range, or a descriptor that is not the map's.
  void validate(const MapInfo& map) const;
};

}  // namespace cairn::app
