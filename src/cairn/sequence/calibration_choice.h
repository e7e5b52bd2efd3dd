// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds what is stated about the cameras of a sequence beside what its format carries.
struct ChosenCalibration {
  std::optional<Calibration> whole;     ///< replaces the format's own
  std::string source;                   ///< of `whole`, for people
  std::optional<Calibration> addition;  ///< completes the one or the other: a camera.yaml without camera

  /// Sets the sequence's calibration; twice has the effect of once. If the frames are listed and are pairs, a
  /// left file of ROS is read with the right one beside it.
  void apply(Sequence& sequence) const;
};

/// Chooses in the order of who may say: --camera, camera.yaml in the folder, one of another program there
/// unless the format carries its own. `folder` may be one image, beside which nothing is looked for. Throws
/// InputError for any defect.
[[nodiscard]] ChosenCalibration choose_calibration(const std::filesystem::path& folder,
                                                   const SequenceOptions& options);

}  // namespace cairn
