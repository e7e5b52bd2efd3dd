// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/depth_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "cairn/core/error.h"
#include "cairn/sequence/sample_frames.h"

namespace cairn {
namespace {

constexpr std::size_t kFrames = 5;
constexpr std::size_t kFewest = 1000;  // readings
constexpr double kFactor = 5;          // between millimetres and the TUM benchmark's units

bool is_between(double value, double low, double high) {
  return value >= low && value <= high;
}

DepthFigures scaled(const DepthFigures& figures, double factor) {
  return {factor * figures.nearest, factor * figures.median, factor * figures.farthest};
}

/// Returns whether the figures are usual for a depth camera: it is blind below some 0.3 m and beyond 10 m.
bool is_usual(const DepthFigures& figures) {
  return figures.nearest >= 0.25 && is_between(figures.median, 0.4, 5) && figures.farthest <= 10;
}

/// Returns whether much lies nearer than a depth camera sees, or nothing is an arm's length away.
bool is_too_near(const DepthFigures& figures) {
  return figures.median < 0.65 && (figures.nearest < 0.25 || figures.farthest < 1);
}

/// Returns whether nothing is near, and much at the end of what a depth camera sees or beyond.
bool is_too_far(const DepthFigures& figures) {
  return figures.nearest > 1.8 && figures.farthest > 7.5;
}

std::vector<float> sample_depths(const Sequence& sequence) {
  constexpr std::size_t kStep = 7;  // pixels
  const FrameLoader loader(sequence);
  std::vector<float> depths;
  for (const FrameId id : sample_frames(sequence.frames.size(), kFrames)) {
    try {
      const DepthImage depth = loader.load_depth(id);
      for (std::size_t i = 0; i < depth.size(); i += kStep) depths.push_back(depth.data()[i]);
    } catch (const InputError&) {
      continue;  // skipped and counted by whoever reads all
    }
  }
  return depths;
}

}  // namespace

std::optional<DepthFigures> depth_figures(std::vector<float> depths) {
  std::erase_if(depths, [](float depth) { return !(depth > 0); });
  if (depths.size() < kFewest) return std::nullopt;
  std::sort(depths.begin(), depths.end());
  const auto at = [&](double share) {
    return static_cast<double>(
        depths[static_cast<std::size_t>(share * static_cast<double>(depths.size() - 1))]);
  };
  return DepthFigures{at(0.02), at(0.5), at(0.98)};
}

std::optional<double> likelier_scale(const DepthFigures& figures, double scale) {
  if (is_too_near(figures) && is_usual(scaled(figures, kFactor))) return scale / kFactor;
  if (is_too_far(figures) && is_usual(scaled(figures, 1 / kFactor))) return scale * kFactor;
  constexpr double kFarOff = 20;
  if (is_between(figures.median, 0.4 / kFarOff, 5 * kFarOff)) return std::nullopt;
  for (const double other : {1000.0, 5000.0})
    if (is_usual(scaled(figures, scale / other))) return other;
  return std::nullopt;
}

std::optional<std::string> doubt_depth_scale(const DepthFigures& figures, double scale,
                                             const std::string& where) {
  const auto other = likelier_scale(figures, scale);
  if (!other) return std::nullopt;
  return fmt::format(
      "The depth images show a median depth of {:.2f} m (most from {:.2f} to {:.2f} m) with depth.scale "
      "{:g}; "
      "with {:g} it would be {:.2f} m, as a depth camera sees. Check {}.",
      figures.median, figures.nearest, figures.farthest, scale, *other, figures.median * scale / *other,
      where);
}

std::optional<std::string> doubt_depth_scale(const Sequence& sequence) {
  if (!sequence.calibration.depth || sequence.frames.empty()) return std::nullopt;
  const auto figures = depth_figures(sample_depths(sequence));
  if (!figures) return std::nullopt;
  return doubt_depth_scale(*figures, sequence.calibration.depth->scale,
                           fmt::format("'depth: {{scale: ...}}' in {}", sequence.calibration_source));
}

}  // namespace cairn
