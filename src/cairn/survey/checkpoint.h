// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "cairn/survey/state.h"

namespace cairn {

/// What a run needs to go on after it was stopped or killed.
struct Checkpoint {
  SurveyState state;
  MapWriterState writer;
};

/// Gives frames, whose place in the sequence is observed.frame, again what was observed in them (those
/// features that they kept) and their given poses.
using ObserveAgain = std::function<void(std::vector<SurveyFrame>& frames)>;

/// Writes the checkpoint beside the pieces of the map that it belongs to, in place of the one before.
/// `identity` stands for input and options. Features are not stored: whoever goes on finds them again.
void write_checkpoint(const std::filesystem::path& folder, std::uint32_t identity, const SurveyState& state,
                      const MapWriterState& writer);

/// The checkpoint in the folder; nothing where there is none, or one of another input, other options or
/// another version, or it is damaged: then the work begins anew.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& folder,
                                                        std::uint32_t identity, const ObserveAgain& observe);

[[nodiscard]] bool has_checkpoint(const std::filesystem::path& folder);
void remove_checkpoint(const std::filesystem::path& folder);

}  // namespace cairn
