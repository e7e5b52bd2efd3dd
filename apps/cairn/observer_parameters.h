// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cairn/frontend/observer.h"
#include "cairn/sequence/sequence.h"
#include "cairn/sequence/settings.h"

namespace cairn::app {

/// Parameters by which a sequence is read.
void bind_sequence(SequenceOptions& sequence, SettingTable& table);
/// Parameters by which its frames become features with depth.
void bind_observer(ObserverOptions& observer, SettingTable& table);

}  // namespace cairn::app
