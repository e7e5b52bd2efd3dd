// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/image_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/features/kernels/image_kernels.h"

namespace cairn {
namespace {

constexpr int kBlock = 8;           // output pixels of a ResizeBlock
constexpr int kSourcePixels = 16;   // that a block reads
constexpr int kRowsPerTask = 64;    // large enough that a task is worth its start
constexpr double kMaxShrink = 1.8;  // 8 output pixels fit into 16 source pixels

/// Between which two source pixels an output pixel lies.
struct Interpolation {
  int left = 0;
  double share_of_right = 0;  // [0, 1]
};

Interpolation interpolation_at(int output, int output_size, int source_size) {
  const double ratio = static_cast<double>(source_size) / output_size;
  const double at = std::clamp((output + 0.5) * ratio - 0.5, 0.0, source_size - 1.0);
  const int left = std::min(static_cast<int>(at), source_size - 2);
  return {left, at - left};
}

std::vector<ResizeBlock> blocks_of_row(int output_width, int source_width) {
  constexpr int kUnits = 64;  // weights add up to it
  std::vector<ResizeBlock> blocks(static_cast<std::size_t>((output_width + kBlock - 1) / kBlock));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    ResizeBlock& block = blocks[b];
    const int begin = static_cast<int>(b) * kBlock;
    block.first =
        std::min(interpolation_at(begin, output_width, source_width).left, source_width - kSourcePixels);
    for (int i = 0; i < kBlock; ++i) {
      const Interpolation place =
          interpolation_at(std::min(begin + i, output_width - 1), output_width, source_width);
      const int right_weight = static_cast<int>(std::lround(place.share_of_right * kUnits));
      block.source[2 * i] = static_cast<std::uint8_t>(place.left - block.first);
      block.source[2 * i + 1] = static_cast<std::uint8_t>(place.left + 1 - block.first);
      block.weight[2 * i] = static_cast<std::int8_t>(kUnits - right_weight);
      block.weight[2 * i + 1] = static_cast<std::int8_t>(right_weight);
    }
  }
  return blocks;
}

/// Rows of one strip: source rows are resized once each, as they are needed.
class StripResizer {
 public:
  StripResizer(const GrayImage& source, const std::vector<ResizeBlock>& blocks)
      : source_(source), blocks_(blocks) {
    for (auto& row : rows_) row.resize(blocks.size() * kBlock);
  }

  void write_row(GrayImage& out, int v) {
    constexpr double kUnits = 32768;
    const Interpolation place = interpolation_at(v, out.height(), source_.height());
    const int weight = static_cast<int>(std::min(std::lround(place.share_of_right * kUnits), 32767L));
    const std::int16_t* upper = resized(place.left);
    const std::int16_t* lower = resized(place.left + 1);
    image_kernels().blend_rows(upper, lower, weight, out.width(), out.row(v));
  }

 private:
  const std::int16_t* resized(int v) {
    const auto slot = static_cast<std::size_t>(v % 2);
    if (held_[slot] != v) {
      image_kernels().resize_row(source_.row(v), blocks_.data(), static_cast<int>(blocks_.size()),
                                 rows_[slot].data());
      held_[slot] = v;
    }
    return rows_[slot].data();
  }

  const GrayImage& source_;
  const std::vector<ResizeBlock>& blocks_;
  std::array<std::vector<std::int16_t>, 2> rows_;
  std::array<int, 2> held_{-1, -1};
};

/// Where row or column i of an image of this size is found when the border is a mirror on the outermost
/// pixels.
int mirrored(int i, int size) {
  if (i < 0) return -i;
  return i < size ? i : 2 * (size - 1) - i;
}

constexpr int kBlurHalf = 3;
constexpr int kBlurTaps = 2 * kBlurHalf + 1;

void smooth_row(const GrayImage& image, int v, std::vector<std::uint8_t>& padded, std::uint8_t* out) {
  std::array<const std::uint8_t*, kBlurTaps> rows{};
  for (int k = 0; k < kBlurTaps; ++k)
    rows[static_cast<std::size_t>(k)] = image.row(mirrored(v + k - kBlurHalf, image.height()));
  std::uint8_t* middle = padded.data() + kBlurHalf;
  image_kernels().blur_seven(rows.data(), image.width(), middle);
  for (int i = 1; i <= kBlurHalf; ++i) {
    middle[-i] = middle[i];
    middle[image.width() - 1 + i] = middle[image.width() - 1 - i];
  }
  for (int k = 0; k < kBlurTaps; ++k) rows[static_cast<std::size_t>(k)] = padded.data() + k;
  image_kernels().blur_seven(rows.data(), image.width(), out);
}

}  // namespace

GrayImage resize_bilinear(const GrayImage& image, int width, int height, const Executor& executor) {
  require(image.width() >= kSourcePixels && image.height() >= kSourcePixels, "a row has 16 pixels to read");
  require(width > 0 && width <= image.width() && width * kMaxShrink >= image.width() && height > 0 &&
              height <= image.height() && height * kMaxShrink >= image.height(),
          "the image shrinks 1 to 1.8 times");
  const auto blocks = blocks_of_row(width, image.width());
  GrayImage out(width, height);
  executor.for_each_chunk(static_cast<std::size_t>(height), kRowsPerTask,
                          [&](std::size_t begin, std::size_t end) {
                            StripResizer strip(image, blocks);
                            for (std::size_t v = begin; v < end; ++v)
                              strip.write_row(out, static_cast<int>(v));
                          });
  return out;
}

ImagePyramid build_pyramid(const GrayImage& image, const PyramidOptions& options, const Executor& executor) {
  require(options.levels >= 1 && options.scale > 1 && options.scale <= kMaxShrink,
          "a pyramid has levels, and each is 1 to 1.8 times smaller");
  ImagePyramid pyramid;
  if (std::min(image.width(), image.height()) < std::max(options.smallest_side, 1)) return pyramid;
  pyramid.levels.push_back({image, 1, 1});
  double scale = 1;
  while (static_cast<int>(pyramid.levels.size()) < options.levels) {
    scale *= options.scale;
    const GrayImage& finer = pyramid.levels.back().image;
    const int width = static_cast<int>(std::lround(image.width() / scale));
    const int height = static_cast<int>(std::lround(image.height() / scale));
    const bool readable = std::min(finer.width(), finer.height()) >= kSourcePixels;
    if (!readable || std::min(width, height) < options.smallest_side) break;
    pyramid.levels.push_back({resize_bilinear(finer, width, height, executor),
                              static_cast<double>(image.width()) / width,
                              static_cast<double>(image.height()) / height});
  }
  return pyramid;
}

GrayImage smooth_for_brief(const GrayImage& image, const Executor& executor) {
  if (std::min(image.width(), image.height()) <= kBlurHalf) return image;
  GrayImage out(image.width(), image.height());
  executor.for_each_chunk(
      static_cast<std::size_t>(image.height()), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint8_t> padded(static_cast<std::size_t>(image.width()) + 2 * kBlurHalf);
        for (std::size_t v = begin; v < end; ++v)
          smooth_row(image, static_cast<int>(v), padded, out.row(static_cast<int>(v)));
      });
  return out;
}

}  // namespace cairn
