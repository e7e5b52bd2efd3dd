// SPDX-License-Identifier: Apache-2.0
#include "cairn/features/kernels/image_kernels.h"

#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

namespace cairn::CAIRN_ISA {
namespace {

#if defined(__SSE4_2__)
void resize_row(const std::uint8_t* row, const ResizeBlock* blocks, int count, std::int16_t* out) {
  for (int i = 0; i < count; ++i) {
    const ResizeBlock& block = blocks[i];
    const __m128i pixels = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + block.first));
    const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block.source));
    const __m128i weight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block.weight));
    const __m128i sums = _mm_maddubs_epi16(_mm_shuffle_epi8(pixels, order), weight);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + 8 * i), sums);
  }
}
#else
void resize_row(const std::uint8_t* row, const ResizeBlock* blocks, int count, std::int16_t* out) {
  for (int i = 0; i < count; ++i) {
    const ResizeBlock& block = blocks[i];
    const std::uint8_t* pixels = row + block.first;
    for (int j = 0; j < 8; ++j) {
      out[8 * i + j] = static_cast<std::int16_t>(pixels[block.source[2 * j]] * block.weight[2 * j] +
                                                 pixels[block.source[2 * j + 1]] * block.weight[2 * j + 1]);
    }
  }
}
#endif

void blend_rows(const std::int16_t* upper, const std::int16_t* lower, int weight, int width,
                std::uint8_t* out) {
  const auto factor = static_cast<std::int16_t>(weight);
  for (int i = 0; i < width; ++i) {
    const auto step = static_cast<std::int16_t>(lower[i] - upper[i]);
    const auto part = static_cast<std::int16_t>((step * factor + (1 << 14)) >> 15);
    out[i] = static_cast<std::uint8_t>((upper[i] + part + 32) >> 6);
  }
}

void blur_seven(const std::uint8_t* const* rows, int width, std::uint8_t* out) {
  const std::uint8_t *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4], *f = rows[5],
                     *g = rows[6];
  for (int i = 0; i < width; ++i) {
    const auto outer = static_cast<std::uint16_t>(18 * static_cast<std::uint16_t>(a[i] + g[i]) +
                                                  34 * static_cast<std::uint16_t>(b[i] + f[i]));
    const auto inner =
        static_cast<std::uint16_t>(49 * static_cast<std::uint16_t>(c[i] + e[i]) + 54 * std::uint16_t{d[i]});
    out[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(outer + inner + 128) >> 8);
  }
}

}  // namespace

extern const ImageKernels kImageKernels;
const ImageKernels kImageKernels{resize_row, blend_rows, blur_seven};

}  // namespace cairn::CAIRN_ISA
