// SPDX-License-Identifier: Apache-2.0
#include "cairn/observe/pair_order.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "cairn/core/error.h"
#include "cairn/features/extractor.h"
#include "cairn/matching/matching.h"
#include "cairn/sequence/sample_frames.h"

namespace cairn {
namespace {

constexpr std::size_t kPairs = 5;
constexpr int kEnough = 40;  // matches: chance makes a few
constexpr int kTimes = 4;    // as many one way as the other: clear
// A point infinitely far away has no disparity, and a calibration is wrong by a pixel or two.
constexpr double kMinDisparityPx = 3;
constexpr double kMaxRowErrorPx = 2;
constexpr double kNearest = 0.5;  // metres: with the baseline, the largest disparity

/// Counts the matches on one row by the sign of the disparity.
struct Signs {
  int positive = 0, negative = 0;
};

bool is_clear(int many, int few) {
  return many >= kEnough && many >= kTimes * few;
}

/// Matches the images of one pair and counts the signs of the disparities.
class SignCounter {
 public:
  explicit SignCounter(const Calibration& calibration)
      : extractor_(make_extractor({.detector = "ORB", .descriptor = "ORB", .count = 800})),
        max_disparity_(calibration.camera.fx * calibration.baseline.value_or(0) / kNearest) {}

  [[nodiscard]] Signs operator()(const Frame& frame) const {
    const Features left = extractor_->extract(frame.gray), right = extractor_->extract(frame.right);
    MatchOptions options{descriptor_limit(left.descriptors), 0.9, true};
    Signs signs;
    for (const Match& match : match_descriptors(left.descriptors, right.descriptors, options)) {
      const Keypoint& l = left.keypoints[static_cast<std::size_t>(match.query)];
      const Keypoint& r = right.keypoints[static_cast<std::size_t>(match.train)];
      const double disparity = static_cast<double>(l.u) - static_cast<double>(r.u);
      const double row_error = std::abs(static_cast<double>(l.v) - static_cast<double>(r.v));
      const bool fits = row_error <= kMaxRowErrorPx * static_cast<double>(l.sigma_px) &&
                        std::abs(disparity) >= kMinDisparityPx && std::abs(disparity) <= max_disparity_;
      if (fits) ++(disparity > 0 ? signs.positive : signs.negative);
    }
    return signs;
  }

 private:
  std::unique_ptr<Extractor> extractor_;
  double max_disparity_;
};

Sequence exchanged(Sequence sequence) {
  for (FrameFiles& files : sequence.frames) std::swap(files.color, files.right);
  return sequence;
}

/// Loads a frame. Returns nullopt if it cannot be read.
std::optional<Frame> load(const FrameLoader& loader, FrameId id) {
  try {
    return loader.load(id);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string remedy(const Sequence& sequence) {
  const bool is_euroc = sequence.format == "EuRoC";
  return fmt::format(
      "Exchange the images of {}, or, where they are right, correct {} in {}.",
      is_euroc ? "cam0 and cam1" : "image_0 and image_1",
      sequence.calibration.raw_stereo ? "left_from_right (T_BS of each camera)" : "the sign of the baseline",
      sequence.calibration_source);
}

}  // namespace

bool PairOrder::looks_exchanged() const {
  return is_clear(exchanged, as_given);
}

PairOrder measure_pair_order(const Sequence& sequence) {
  PairOrder order;
  if (!is_stereo(sequence)) return order;
  const SignCounter count(sequence.calibration);
  const FrameLoader loader(sequence);
  const Sequence other = exchanged(sequence);
  std::optional<FrameLoader> other_loader;
  for (const FrameId id : sample_frames(sequence.frames.size(), kPairs)) {
    const auto frame = load(loader, id);
    if (!frame) continue;
    const Signs signs = count(*frame);
    ++order.pairs;
    order.as_given += signs.positive;
    if (is_clear(signs.positive, signs.negative)) return order;
    if (!other_loader) other_loader.emplace(other);
    if (const auto turned = load(*other_loader, id)) order.exchanged += count(*turned).positive;
    if (order.looks_exchanged()) return order;
  }
  return order;
}

void check_pair_order(const Sequence& sequence) {
  const PairOrder order = measure_pair_order(sequence);
  if (!order.looks_exchanged()) return;
  throw InputError(
      {sequence.folder.string(), 0,
       "left images of the left camera, in which things lie further right than in the right images",
       fmt::format("left and right images that look exchanged: {} matches of {} {} have a positive "
                   "disparity as given, {} with left and right exchanged",
                   order.as_given, order.pairs, order.pairs == 1 ? "pair" : "pairs", order.exchanged),
       remedy(sequence)});
}

}  // namespace cairn
