// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/dense/cloud.h"
#include "cairn/dense/occupancy.h"
#include "cairn/sequence/sequence.h"
#include "cairn/sequence/settings.h"
#include "cairn/slam/options.h"

namespace cairn::app {

/// Everything that `cairn slam` can be told by --config and --set.
struct SlamParameters {
  SequenceOptions sequence;
  SlamOptions slam;
  CloudOptions cloud;
  OccupancyOptions octree;

  /// The names of the parameters, bound to these fields. Not to be used longer than this object lives.
  [[nodiscard]] SettingTable table();
  void validate() const;
};

}  // namespace cairn::app
