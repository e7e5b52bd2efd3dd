// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/sequence/sequence.h"

namespace cairn {

/// What the depth images of a recording show, metres.
struct DepthFigures {
  double nearest = 0;  ///< 2 % of the readings are nearer
  double median = 0;
  double farthest = 0;  ///< 2 % are farther
};

/// The figures of depths in metres, of which some are 0 for unknown; nothing where fewer than 1000 are known.
[[nodiscard]] std::optional<DepthFigures> depth_figures(std::vector<float> depths);

/// The scale, units per metre, that is likelier than `scale`, with which the figures were made: where they
/// are none of a depth camera, which sees from some tens of centimetres to some metres, and 5 times as much
/// or as little would be (millimetres or the TUM benchmark's fifths of them), or where they are off by a
/// hundred and 1000 or 5000 would not be. Nothing where the figures are a depth camera's or no such scale
/// explains them.
[[nodiscard]] std::optional<double> likelier_scale(const DepthFigures& figures, double scale);

/// A sentence for people where likelier_scale knows one; `where` names what holds the scale.
[[nodiscard]] std::optional<std::string> doubt_depth_scale(const DepthFigures& figures, double scale,
                                                           const std::string& where);

/// A sentence for people where a few depth images of the sequence say that its scale is likely another;
/// nothing where it may be right, or there is no depth. Images that cannot be read are passed over.
[[nodiscard]] std::optional<std::string> doubt_depth_scale(const Sequence& sequence);

}  // namespace cairn
