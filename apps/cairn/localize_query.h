// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cairn/localize/options.h"
#include "cairn/map_files/map_info.h"
#include "cairn/sequence/sequence.h"

namespace cairn::app {

/// Images to be found in a map: a sequence, a folder of images or one image. Of images that come without a
/// calibration it is that of the map's own camera, without distortion: InputError unless they have its size.
/// `mono`: left images or colour only.
[[nodiscard]] Sequence open_query(const std::string& path, const SequenceOptions& options, const MapInfo& map,
                                  bool mono);

/// The camera of the sequence after camera_for_queries, as a rig.
[[nodiscard]] QueryCamera query_camera(const Sequence& sequence, const MapInfo& map);

}  // namespace cairn::app
