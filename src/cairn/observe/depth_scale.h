// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/sequence/sequence.h"

namespace cairn {

/// Holds how far away things are in the depth images of a recording, metres.
struct DepthFigures {
  double nearest = 0;  ///< 2 % quantile of the readings
  double median = 0;
  double farthest = 0;  ///< 98 % quantile of the readings
};

/// Computes the figures of depths in metres, 0 for unknown. Returns nullopt if fewer than 1000 are known.
[[nodiscard]] std::optional<DepthFigures> depth_figures(std::vector<float> depths);

/// Returns a scale, units per metre, that is likelier than `scale`, with which the figures were made. Returns
/// nullopt if the figures are those of a depth camera, which sees from some tens of centimetres to some
/// metres, or if no likelier scale is known. Tried are 5 times as much and as little (millimetres, and the
/// TUM benchmark's fifths of them) and, if the figures are far off, 1000 and 5000.
[[nodiscard]] std::optional<double> likelier_scale(const DepthFigures& figures, double scale);

/// Returns a sentence for people that names the scale of likelier_scale, or nullopt if that has none; `where`
/// names what holds the scale.
[[nodiscard]] std::optional<std::string> doubt_depth_scale(const DepthFigures& figures, double scale,
                                                           const std::string& where);

/// Returns a sentence for people if a few depth images of the sequence say that its depth scale is likely
/// another; nullopt if it may be right, or if there is no depth. Images that cannot be read are ignored.
[[nodiscard]] std::optional<std::string> doubt_depth_scale(const Sequence& sequence);

}  // namespace cairn
