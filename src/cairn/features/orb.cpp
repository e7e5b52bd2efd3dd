// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/orb.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "cairn/features/image_pyramid.h"
#include "cairn/features/kernels/orb_kernels.h"
#include "cairn/features/orb_pattern.h"
#include "cairn/features/uniform_selection.h"

namespace cairn {
namespace {

constexpr float kPatch = 31;                // pixels, diameter of the described disc
constexpr int kBorder = kPatternReach + 1;  // pixels between a keypoint and the image's edge
constexpr std::size_t kBytes = kBriefBits / 8;
constexpr std::size_t kKeypointsPerTask = 128;

/// Direction of the intensity centroid as a unit vector.
struct Direction {
  float cosine = 1, sine = 0;

  [[nodiscard]] float degrees() const {
    const float angle = std::atan2(sine, cosine) * static_cast<float>(180 / std::numbers::pi);
    const float turned = angle < 0 ? angle + 360 : angle;
    return turned < 360 ? turned : 0;
  }
};

Direction direction_of(const GrayImage& image, int u, int v) {
  std::int32_t m10 = 0, m01 = 0;
  orb_kernels().moments(image.row(v) + u, image.width(), &m10, &m01);
  const double length = std::sqrt(static_cast<double>(m10) * m10 + static_cast<double>(m01) * m01);
  if (!(length > 0)) return {};
  return {static_cast<float>(m10 / length), static_cast<float>(m01 / length)};
}

void describe(const GrayImage& smooth, int u, int v, const Direction& direction, std::uint8_t* bits) {
  orb_kernels().brief(smooth.row(v) + u, smooth.width(), orb_pattern(), direction.cosine, direction.sine,
                      bits);
}

bool has_patch(const GrayImage& image, int u, int v) {
  return u >= kBorder && v >= kBorder && u < image.width() - kBorder && v < image.height() - kBorder;
}

/// How many of `count` keypoints each level gets. A level has fewer pixels than the one below by the scale's
/// square; coarse corners are found again over larger changes of distance, so they get some more than that:
/// the power is 1.5. What a level cannot fill goes to the others.
std::vector<int> quotas(const std::vector<std::vector<Corner>>& corners, int count, double scale) {
  constexpr double kPower = 1.5;
  const auto weight = [&](std::size_t level) {
    return std::pow(scale, -kPower * static_cast<double>(level));
  };
  std::vector<int> quota(corners.size(), 0);
  std::vector<bool> full(corners.size(), false);
  for (bool again = true; again;) {
    again = false;
    int left = count;
    double shares = 0;
    for (std::size_t l = 0; l < corners.size(); ++l) {
      if (full[l])
        left -= quota[l];
      else
        shares += weight(l);
    }
    for (std::size_t l = 0; l < corners.size(); ++l) {
      if (full[l]) continue;
      const double share = left * weight(l) / shares;
      quota[l] = static_cast<int>(share);
      if (corners[l].size() > static_cast<std::size_t>(quota[l])) continue;
      quota[l] = static_cast<int>(corners[l].size());
      full[l] = again = true;
    }
  }
  int left = count - std::accumulate(quota.begin(), quota.end(), 0);  // lost in rounding
  for (std::size_t l = 0; l < quota.size() && left > 0; ++l) {
    if (full[l]) continue;
    ++quota[l];
    --left;
  }
  return quota;
}

/// The corners with the highest scores, twice as many as are wanted, in their order: Harris' measure then
/// chooses.
void drop_weakest(std::vector<Corner>& corners, int wanted) {
  const std::size_t limit = 2 * static_cast<std::size_t>(wanted);
  if (corners.size() <= limit) return;
  std::vector<std::size_t> with_score(256);
  for (const Corner& corner : corners) ++with_score[static_cast<std::size_t>(corner.score)];
  int score = 255;
  for (std::size_t above = 0; score > 0 && above + with_score[static_cast<std::size_t>(score)] <= limit;
       --score)
    above += with_score[static_cast<std::size_t>(score)];
  std::erase_if(corners, [score](const Corner& corner) { return corner.score < score; });
}

struct Selected {
  std::int32_t u = 0, v = 0;
  float harris = 0;
};

/// At most `count` corners, the strongest first.
std::vector<Selected> select(std::vector<Corner> corners, int count, const GrayImage& image) {
  drop_weakest(corners, count);
  std::vector<Selected> strongest_first;
  strongest_first.reserve(corners.size());
  for (const Corner& corner : corners)
    strongest_first.push_back({corner.u, corner.v, harris_measure(image, corner.u, corner.v)});
  std::stable_sort(strongest_first.begin(), strongest_first.end(),
                   [](const Selected& a, const Selected& b) { return a.harris > b.harris; });
  std::vector<PixelPosition> places;
  places.reserve(corners.size());
  for (const Selected& corner : strongest_first)
    places.push_back({static_cast<float>(corner.u), static_cast<float>(corner.v)});
  std::vector<Selected> selected;
  for (const std::size_t i :
       select_uniform(places, image.width(), image.height(), static_cast<std::size_t>(count)))
    selected.push_back(strongest_first[i]);
  return selected;
}

std::vector<std::vector<Selected>> corners_of(const ImagePyramid& pyramid, const OrbOptions& options,
                                              const Executor& executor) {
  std::vector<std::vector<Corner>> corners;
  FastOptions fast;
  fast.threshold = options.threshold;
  fast.retry_threshold = options.retry_threshold;
  fast.border = kBorder;
  for (const ImagePyramid::Level& level : pyramid.levels)
    corners.push_back(detect_fast(level.image, fast, executor));
  const std::vector<int> quota = quotas(corners, options.count, options.scale);
  return executor.map<std::vector<Selected>>(corners.size(), [&](std::size_t l) {
    return select(std::move(corners[l]), quota[l], pyramid.levels[l].image);
  });
}

Keypoint keypoint_of(const ImagePyramid::Level& level, const Selected& corner, const Direction& direction) {
  const auto scale = static_cast<float>(std::sqrt(level.scale_u * level.scale_v));
  return {static_cast<float>(level.u_in_image(corner.u)),
          static_cast<float>(level.v_in_image(corner.v)),
          kPatch * scale,
          direction.degrees(),
          corner.harris,
          std::max(scale, 1.0F)};
}

class OrbExtractor : public Extractor {
 public:
  explicit OrbExtractor(const OrbOptions& options) : options_(options) {}
  using Extractor::extract;
  [[nodiscard]] Features extract(const GrayImage& image, const Executor& executor) const override {
    return extract_orb(image, options_, executor);
  }

 private:
  OrbOptions options_;
};

}  // namespace

Features extract_orb(const GrayImage& image, const OrbOptions& options, const Executor& executor) {
  require(options.count >= 1, "at least one keypoint is asked for");
  const ImagePyramid pyramid =
      build_pyramid(image, {options.levels, options.scale, 2 * kBorder + 1}, executor);
  const auto corners = corners_of(pyramid, options, executor);
  std::size_t count = 0;
  for (const auto& of_level : corners) count += of_level.size();
  Features features{std::vector<Keypoint>(count), Descriptors(Norm::hamming, kBytes, count)};
  std::size_t begin = 0;
  for (std::size_t l = 0; l < corners.size(); ++l) {
    const ImagePyramid::Level& level = pyramid.levels[l];
    const GrayImage smooth = smooth_for_brief(level.image, executor);
    executor.for_each_chunk(corners[l].size(), kKeypointsPerTask, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        const Selected& corner = corners[l][i];
        const Direction direction = direction_of(level.image, corner.u, corner.v);
        features.keypoints[begin + i] = keypoint_of(level, corner, direction);
        describe(smooth, corner.u, corner.v, direction, features.descriptors.row(begin + i));
      }
    });
    begin += corners[l].size();
  }
  return features;
}

std::unique_ptr<Extractor> make_orb_extractor(const OrbOptions& options) {
  return std::make_unique<OrbExtractor>(options);
}

float angle_by_moments(const GrayImage& image, int u, int v) {
  require(has_patch(image, u, v), "the patch around the pixel lies in the image");
  return direction_of(image, u, v).degrees();
}

OrbDescriptions describe_orb(const GrayImage& image, std::span<const Keypoint> keypoints,
                             const Executor& executor) {
  OrbDescriptions described{std::vector<float>(keypoints.size(), -1),
                            Descriptors(Norm::hamming, kBytes, keypoints.size()),
                            std::vector<bool>(keypoints.size(), true), 0};
  const GrayImage smooth = smooth_for_brief(image, executor);
  executor.for_each_chunk(keypoints.size(), kKeypointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float u = std::round(keypoints[i].u), v = std::round(keypoints[i].v);
      const bool in_image = u >= 0 && v >= 0 && u < static_cast<float>(image.width()) &&
                            v < static_cast<float>(image.height());  // false for NaN
      if (!in_image || !has_patch(image, static_cast<int>(u), static_cast<int>(v))) continue;
      const Direction direction = direction_of(image, static_cast<int>(u), static_cast<int>(v));
      described.angles_deg[i] = direction.degrees();
      describe(smooth, static_cast<int>(u), static_cast<int>(v), direction, described.descriptors.row(i));
    }
  });
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    described.bad[i] = described.angles_deg[i] < 0;
    described.bad_count += described.bad[i] ? 1 : 0;
  }
  return described;
}

}  // namespace cairn
