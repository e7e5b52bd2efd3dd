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

/// Weights of seven pixels, symmetric, adding up to 256.
constexpr int kBlur[4] = {18, 34, 49, 54};

std::uint8_t blur_one(const std::uint8_t* const* rows, int i) {
  const int outer = kBlur[0] * (rows[0][i] + rows[6][i]) + kBlur[1] * (rows[1][i] + rows[5][i]);
  const int inner = kBlur[2] * (rows[2][i] + rows[4][i]) + kBlur[3] * rows[3][i];
  return static_cast<std::uint8_t>((outer + inner + 128) >> 8);
}

#if defined(__AVX2__)
#if defined(__AVX512BW__)
using Register = __m512i;
Register load(const std::uint8_t* p) {
  return _mm512_loadu_si512(p);
}
void store(std::uint8_t* p, Register v) {
  _mm512_storeu_si512(p, v);
}
Register fill(int value) {
  return _mm512_set1_epi16(static_cast<short>(value));
}
Register low(Register a, Register b) {
  return _mm512_unpacklo_epi8(a, b);
}
Register high(Register a, Register b) {
  return _mm512_unpackhi_epi8(a, b);
}
Register weigh(Register pixels, Register weights) {
  return _mm512_maddubs_epi16(pixels, weights);
}
Register add(Register a, Register b) {
  return _mm512_add_epi16(a, b);
}
Register high_bytes(Register a, Register b) {
  return _mm512_packus_epi16(_mm512_srli_epi16(a, 8), _mm512_srli_epi16(b, 8));
}
#else
using Register = __m256i;
Register load(const std::uint8_t* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}
void store(std::uint8_t* p, Register v) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), v);
}
Register fill(int value) {
  return _mm256_set1_epi16(static_cast<short>(value));
}
Register low(Register a, Register b) {
  return _mm256_unpacklo_epi8(a, b);
}
Register high(Register a, Register b) {
  return _mm256_unpackhi_epi8(a, b);
}
Register weigh(Register pixels, Register weights) {
  return _mm256_maddubs_epi16(pixels, weights);
}
Register add(Register a, Register b) {
  return _mm256_add_epi16(a, b);
}
Register high_bytes(Register a, Register b) {
  return _mm256_packus_epi16(_mm256_srli_epi16(a, 8), _mm256_srli_epi16(b, 8));
}
#endif

/// Seven rows at one place, interleaved: two pixels of rows that have one weight are weighed at once. The sum
/// stays below 2^16.
Register blur_sum(Register outer, Register next, Register inner, Register middle) {
  const Register outer_sum = weigh(outer, fill(kBlur[0] << 8 | kBlur[0]));
  const Register next_sum = weigh(next, fill(kBlur[1] << 8 | kBlur[1]));
  const Register inner_sum = weigh(inner, fill(kBlur[2] << 8 | kBlur[2]));
  const Register middle_sum = weigh(middle, fill(kBlur[3]));
  return add(add(outer_sum, next_sum), add(add(inner_sum, middle_sum), fill(128)));
}

void blur_block(const std::uint8_t* const* rows, int i, std::uint8_t* out) {
  Register p[7];
  for (int k = 0; k < 7; ++k) p[k] = load(rows[k] + i);
  const Register left = blur_sum(low(p[0], p[6]), low(p[1], p[5]), low(p[2], p[4]), low(p[3], p[3]));
  const Register right = blur_sum(high(p[0], p[6]), high(p[1], p[5]), high(p[2], p[4]), high(p[3], p[3]));
  store(out + i, high_bytes(left, right));
}

void blur_seven(const std::uint8_t* const* rows, int width, std::uint8_t* out) {
  constexpr int kCount = sizeof(Register);
  int i = 0;
  for (; i + kCount <= width; i += kCount) blur_block(rows, i, out);
  if (width >= kCount) {
    if (i < width) blur_block(rows, width - kCount, out);  // some pixels once more
  } else {
    for (; i < width; ++i) out[i] = blur_one(rows, i);
  }
}
#else
void blur_seven(const std::uint8_t* const* rows, int width, std::uint8_t* out) {
  for (int i = 0; i < width; ++i) out[i] = blur_one(rows, i);
}
#endif

}  // namespace

extern const ImageKernels kImageKernels;
const ImageKernels kImageKernels{resize_row, blend_rows, blur_seven};

}  // namespace cairn::CAIRN_ISA
