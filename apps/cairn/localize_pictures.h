// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cairn/localize/localize_sequence.h"
#include "cairn/sequence/sequence.h"

namespace cairn::app {

/// A picture NNNNNN.png of each image in a new folder, by its position: which features show which landmarks.
void draw_pictures(const std::filesystem::path& folder, const Sequence& sequence, const QueryCamera& camera,
                   const std::vector<LocalizedImage>& images);

}  // namespace cairn::app
