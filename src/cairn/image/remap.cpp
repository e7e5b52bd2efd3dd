// SPDX-License-Identifier: Apache-2.0
#include "cairn/image/remap.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/error.h"

namespace cairn {
namespace {

constexpr int kOne = 256;               // a whole pixel
constexpr int kHalf = kOne * kOne / 2;  // rounds a sum of products of two shares
constexpr int kShift = 16;
constexpr std::size_t kRowsPerChunk = 32;

/// Shares (of 256) of the pixels to the right and below.
struct Shares {
  int right, below;
};

std::uint8_t blend(const Shares& shares, std::uint8_t upper_left, std::uint8_t upper_right,
                   std::uint8_t lower_left, std::uint8_t lower_right) {
  const int upper = upper_left * kOne + (upper_right - upper_left) * shares.right;
  const int lower = lower_left * kOne + (lower_right - lower_left) * shares.right;
  return static_cast<std::uint8_t>((upper * kOne + (lower - upper) * shares.below + kHalf) >> kShift);
}

Rgb8 blend(const Shares& shares, const Rgb8& upper_left, const Rgb8& upper_right, const Rgb8& lower_left,
           const Rgb8& lower_right) {
  return {blend(shares, upper_left.r, upper_right.r, lower_left.r, lower_right.r),
          blend(shares, upper_left.g, upper_right.g, lower_left.g, lower_right.g),
          blend(shares, upper_left.b, upper_right.b, lower_left.b, lower_right.b)};
}

/// A coordinate as the first of two neighbouring pixels and the second one's share of 256.
struct Interpolation {
  int first;
  int share;
};

/// `coordinate` in [0, size - 1]; the last pixel is the second of the last two.
Interpolation interpolation_at(double coordinate, int size) {
  const auto fixed = static_cast<int>(std::lround(coordinate * kOne));
  const int first = std::clamp(fixed / kOne, 0, std::max(0, size - 2));
  return {first, fixed - first * kOne};
}

}  // namespace

ImageRemap::ImageRemap(const Camera& source, const Camera& target,
                       const Eigen::Quaterniond& source_from_target, const Executor& executor)
    : ImageRemap(
          {source.width, source.height}, {target.width, target.height},
          [&, rotation = source_from_target.toRotationMatrix().eval()](const Eigen::Vector2d& pixel) {
            const auto ray = target.unproject(pixel);
            return ray ? source.project(rotation * ray->homogeneous()) : std::nullopt;
          },
          executor) {}

ImageRemap::ImageRemap(const ImageSize& source, const ImageSize& target,
                       const std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>& source_of,
                       const Executor& executor)
    : source_width_(source.width), source_height_(source.height), origins_(target.width, target.height) {
  require(source.width > 0 && source.height > 0, "the source images have a size");
  executor.for_each_chunk(
      static_cast<std::size_t>(target.height), kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
        for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
          for (int u = 0; u < target.width; ++u) {
            const auto pixel = source_of({static_cast<double>(u), static_cast<double>(v)});
            if (pixel) origins_(u, v) = origin_of(*pixel);
          }
        }
      });
}

ImageRemap::Origin ImageRemap::origin_of(const Eigen::Vector2d& pixel) const {
  const double u_end = source_width_ - 1, v_end = source_height_ - 1;
  const bool is_inside =
      pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= u_end + 0.5 && pixel.y() <= v_end + 0.5;
  if (!is_inside) return {};
  const Interpolation u = interpolation_at(std::clamp(pixel.x(), 0.0, u_end), source_width_);
  const Interpolation v = interpolation_at(std::clamp(pixel.y(), 0.0, v_end), source_height_);
  return {v.first * source_width_ + u.first, static_cast<std::uint16_t>(u.share),
          static_cast<std::uint16_t>(v.share)};
}

template <class Pixel>
Image<Pixel> ImageRemap::remap(const Image<Pixel>& image, const Executor& executor) const {
  require(image.width() == source_width_ && image.height() == source_height_,
          "an image has the size of the source camera's");
  Image<Pixel> result(origins_.width(), origins_.height());
  const std::ptrdiff_t right = source_width_ > 1 ? 1 : 0;
  const std::ptrdiff_t below = source_height_ > 1 ? source_width_ : 0;
  const auto width = static_cast<std::size_t>(origins_.width());
  executor.for_each_chunk(
      static_cast<std::size_t>(origins_.height()), kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * width; i < end * width; ++i) {
          const Origin& origin = origins_.data()[i];
          if (origin.offset < 0) continue;
          const Pixel* pixel = image.data() + origin.offset;
          result.data()[i] =
              blend({origin.right, origin.below}, pixel[0], pixel[right], pixel[below], pixel[right + below]);
        }
      });
  return result;
}

GrayImage ImageRemap::operator()(const GrayImage& image, const Executor& executor) const {
  return remap(image, executor);
}

RgbImage ImageRemap::operator()(const RgbImage& image, const Executor& executor) const {
  return remap(image, executor);
}

}  // namespace cairn
