// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "cairn/survey/state.h"

namespace cairn {

/// Holds what a run needs to resume after it was stopped or killed.
struct Checkpoint {
  SurveyState state;
  MapWriterState writer;
};

/// Fills frames, whose position in the sequence is observed.frame, with what was observed in them (the
/// features that they kept) and with their given poses.
using ObserveAgain = std::function<void(std::vector<SurveyFrame>& frames)>;

/// Writes the checkpoint into the folder of the map's pieces, in place of the last one. `identity` stands for
/// input and options (identity_of). Features are not stored: a run that resumes finds them again.
void write_checkpoint(const std::filesystem::path& folder, std::uint32_t identity, const SurveyState& state,
                      const MapWriterState& writer);

/// Reads the checkpoint in the folder. Returns nullopt if there is none, if it is of another input, other
/// options or another version, or if it is damaged; the work then starts anew.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                                        std::uint32_t identity, const ObserveAgain& observe);

[[nodiscard]] bool has_checkpoint(const std::filesystem::path& folder);
void remove_checkpoint(const std::filesystem::path& folder);

}  // namespace cairn
