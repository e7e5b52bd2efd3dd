// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/resize.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

/// What one pixel takes from a row or column of the source: weights that sum to 1, from `first` on.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

/// The source's pixels that the target's pixel i covers, each by the share that it covers.
Taps covered(int i, int source, int target) {
  const double step = static_cast<double>(source) / target;
  const double begin = i * step, end = std::min<double>(source, (i + 1) * step);
  Taps taps{static_cast<int>(begin), {}};
  for (int k = taps.first; k < end; ++k)
    taps.weights.push_back(
        static_cast<float>((std::min<double>(end, k + 1) - std::max<double>(begin, k)) / (end - begin)));
  return taps;
}

/// The two pixels around the centre of the target's pixel i; one at the border.
Taps interpolated(int i, int source, int target) {
  const double centre = (i + 0.5) * source / target - 0.5;
  const double at = std::clamp<double>(centre, 0, source - 1);
  const int first = std::min(static_cast<int>(at), std::max(0, source - 2));
  if (source == 1) return {0, {1}};
  const auto right = static_cast<float>(at - first);
  return {first, {1 - right, right}};
}

std::vector<Taps> taps_of(int source, int target) {
  std::vector<Taps> taps;
  for (int i = 0; i < target; ++i)
    taps.push_back(target < source ? covered(i, source, target) : interpolated(i, source, target));
  return taps;
}

/// The weighted sum of rows of the image.
void mix_rows(const GrayImage& image, const Taps& taps, std::vector<float>& mixed) {
  std::fill(mixed.begin(), mixed.end(), 0.0F);
  for (std::size_t k = 0; k < taps.weights.size(); ++k) {
    const std::uint8_t* row = image.row(taps.first + static_cast<int>(k));
    const float weight = taps.weights[k];
    for (std::size_t u = 0; u < mixed.size(); ++u) mixed[u] += weight * static_cast<float>(row[u]);
  }
}

void require_sizes(int source_width, int source_height, int width, int height) {
  require(source_width > 0 && source_height > 0 && width > 0 && height > 0,
          "an image that is resized has pixels before and after");
}

}  // namespace

Camera resized_camera(const Camera& camera, int width, int height) {
  require_sizes(camera.width, camera.height, width, height);
  const double columns = static_cast<double>(width) / camera.width;
  const double rows = static_cast<double>(height) / camera.height;
  Camera result = camera;
  result.width = width;
  result.height = height;
  result.fx = columns * camera.fx;
  result.fy = rows * camera.fy;
  result.cx = columns * (camera.cx + 0.5) - 0.5;
  result.cy = rows * (camera.cy + 0.5) - 0.5;
  return result;
}

/// One pixel of a row whose columns are still those of the image.
std::uint8_t mix_columns(const std::vector<float>& row, const Taps& taps) {
  float sum = 0.5F;  // rounds
  for (std::size_t k = 0; k < taps.weights.size(); ++k)
    sum += taps.weights[k] * row[static_cast<std::size_t>(taps.first) + k];
  return static_cast<std::uint8_t>(std::min(sum, 255.0F));
}

GrayImage resize_image(const GrayImage& image, int width, int height) {
  require_sizes(image.width(), image.height(), width, height);
  const std::vector<Taps> columns = taps_of(image.width(), width), rows = taps_of(image.height(), height);
  GrayImage resized(width, height);
  std::vector<float> mixed(static_cast<std::size_t>(image.width()));
  for (int v = 0; v < height; ++v) {
    mix_rows(image, rows[static_cast<std::size_t>(v)], mixed);
    for (int u = 0; u < width; ++u) {
      resized(u, v) = mix_columns(mixed, columns[static_cast<std::size_t>(u)]);
    }
  }
  return resized;
}

DepthImage resize_depth(const DepthImage& depth, int width, int height) {
  require_sizes(depth.width(), depth.height(), width, height);
  const auto nearest = [](int i, int source, int target) {
    return static_cast<int>((2 * std::int64_t{i} + 1) * source / (2 * std::int64_t{target}));
  };
  DepthImage resized(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      resized(u, v) = depth(nearest(u, depth.width(), width), nearest(v, depth.height(), height));
  return resized;
}

}  // namespace cairn
