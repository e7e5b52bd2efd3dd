// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/sequence/sequence.h"
#include "cairn/sequence/settings.h"
#include "cairn/survey/options.h"

namespace cairn::app {

/// Everything that `cairn map` can be told by --config and --set.
struct MapParameters {
  SequenceOptions sequence;
  SurveyOptions survey;

  /// The names of the parameters, bound to these fields. Not to be used longer than this object lives.
  [[nodiscard]] SettingTable table();
};

}  // namespace cairn::app
