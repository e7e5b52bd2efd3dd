// SPDX-License-Identifier: Apache-2.0
#include "cairn/matching/kernels/disparity_kernels.h"

#if defined(__SSE4_2__)
#include <immintrin.h>
#endif

#pragma GCC diagnostic ignored "-Wpsabi"  // all that passes vectors is inlined: no caller's registers matter

namespace cairn::CAIRN_ISA {
namespace {

constexpr int kWidth = DisparityWindow::kWidth, kLeft = DisparityWindow::kLeft;
constexpr int kHalfHeight = DisparityWindow::kHalfHeight;

/// One row of a window; sixteen lanes on every instruction set, so that all add in one order.
using Row = float __attribute__((vector_size(4 * kWidth)));
using RowOfInts = std::int32_t __attribute__((vector_size(4 * kWidth)));

/// exp(-x^2 / (2 s^2)) with s = 4 pixels, so that the disparity measured is the centre's; nothing at column
/// -8, which has no other at its side.
constexpr float kBell[kWidth] = {0.F,         0.21626517F, 0.32465247F, 0.45783336F, 0.60653066F, 0.75483960F,
                                 0.88249690F, 0.96923323F, 1.F,         0.96923323F, 0.88249690F, 0.75483960F,
                                 0.60653066F, 0.45783336F, 0.32465247F, 0.21626517F};

constexpr float kMiddle = 128;  // subtracted from all pixels, so that sums stay small and exact

[[gnu::always_inline]] inline Row weights(int y) {
  Row row;
  __builtin_memcpy(&row, kBell, sizeof row);
  return row * kBell[kLeft + y];
}

[[gnu::always_inline]] inline Row columns() {
  return Row{-8, -7, -6, -5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7};
}

/// By hand: GCC 12 takes bytes apart one by one.
[[gnu::always_inline]] inline Row load(const std::uint8_t* from) {
  RowOfInts ints;
#if defined(__AVX512F__)
  // With a mask of all lanes, as without one GCC 12 warns of its own header (its PR 105593).
  const __m512i wide =
      _mm512_maskz_cvtepu8_epi32(0xFFFF, _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  __builtin_memcpy(&ints, &wide, sizeof ints);
#elif defined(__AVX2__)
  __m256i wide[2];
  for (int i = 0; i < 2; ++i)
    wide[i] = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(from + 8 * i)));
  __builtin_memcpy(&ints, wide, sizeof ints);
#elif defined(__SSE4_2__)
  __m128i wide[4];
  for (int i = 0; i < 4; ++i) {
    std::int32_t four = 0;
    __builtin_memcpy(&four, from + 4 * i, sizeof four);
    wide[i] = _mm_cvtepu8_epi32(_mm_cvtsi32_si128(four));
  }
  __builtin_memcpy(&ints, wide, sizeof ints);
#else
  for (int i = 0; i < kWidth; ++i) ints[i] = from[i];
#endif
  return __builtin_convertvector(ints, Row);
}
[[gnu::always_inline]] inline Row load(const float* from) {
  Row row;
  __builtin_memcpy(&row, from, sizeof row);
  return row;
}
[[gnu::always_inline]] inline void store(float* to, const Row& row) {
  __builtin_memcpy(to, &row, sizeof row);
}

/// Halves added to halves: the same order everywhere.
[[gnu::always_inline]] inline double sum(const Row& row) {
  using Half = float __attribute__((vector_size(32)));
  using Quarter = float __attribute__((vector_size(16)));
  Half halves[2];
  __builtin_memcpy(halves, &row, sizeof row);
  const Half half = halves[0] + halves[1];
  Quarter quarters[2];
  __builtin_memcpy(quarters, &half, sizeof half);
  const Quarter quarter = quarters[0] + quarters[1];
  return static_cast<double>((quarter[0] + quarter[2]) + (quarter[1] + quarter[3]));
}

/// The derivative of the polynomial through five pixels.
[[gnu::always_inline]] inline Row gradient(const std::uint8_t* pixels) {
  return (load(pixels + 1) - load(pixels - 1)) * (2.F / 3) -
         (load(pixels + 2) - load(pixels - 2)) * (1.F / 12);
}

/// Sums over the rows of what the normal matrix is made of; those with x follow from them at the end.
struct NormalRows {
  Row gg{}, ggy{}, ggyy{}, gl{}, gly{}, g{}, gy{}, ll{}, l{}, w{};

  [[gnu::always_inline]] void add(const Row& pixels, const Row& gradients, const Row& weight, float y) {
    const Row wg = weight * gradients, wl = weight * pixels;
    const Row wgg = wg * gradients, wgl = wg * pixels;
    gg += wgg, ggy += wgg * y, ggyy += wgg * (y * y);
    gl += wgl, gly += wgl * y;
    g += wg, gy += wg * y;
    ll += wl * pixels, l += wl, w += weight;
  }
};

void prepare(const std::uint8_t* centre, std::ptrdiff_t stride, DisparityWindow& window,
             DisparityNormal& normal) {
  NormalRows rows;
  for (int y = -kHalfHeight; y <= kHalfHeight; ++y) {
    const std::uint8_t* from = centre + y * stride - kLeft;
    const int at = (y + kHalfHeight) * kWidth;
    const Row pixels = load(from) - kMiddle, gradients = gradient(from);
    store(window.pixels + at, pixels);
    store(window.gradients + at, gradients);
    rows.add(pixels, gradients, weights(y), static_cast<float>(y));
  }
  const Row x = columns();
  const double matrix[] = {sum(rows.gg),    sum(rows.gg * x),     sum(rows.ggy),     sum(rows.gl),
                           sum(rows.g),     sum(rows.gg * x * x), sum(rows.ggy * x), sum(rows.gl * x),
                           sum(rows.g * x), sum(rows.ggyy),       sum(rows.gly),     sum(rows.gy),
                           sum(rows.ll),    sum(rows.l),          sum(rows.w)};
  __builtin_memcpy(normal.matrix, matrix, sizeof matrix);
}

void difference(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
                int disparity, DisparityDifference& result) {
  Row sums{}, squares{};
  for (int row = 0; row < DisparityWindow::kHeight; ++row) {
    const int y = row - kHalfHeight;
    const Row right = load(centre + y * stride - kLeft - disparity) - kMiddle;
    const Row residual = load(window.pixels + row * kWidth) - right, weighted = weights(y) * residual;
    sums += weighted, squares += weighted * residual;
  }
  result.sum = sum(sums);
  result.squares = sum(squares);
}

/// Where each row of the window lies in the right image, one row a lane: whole pixels to the right, and the
/// weights of the six pixels around the fraction.
struct Placement {
  alignas(64) std::int32_t whole[kWidth];
  alignas(64) float weights[6][kWidth];
};

/// Lagrange's polynomial through pixels -2 to 3 at t in [0, 1).
[[gnu::always_inline]] inline void place(float disparity, float row_slope, Placement& placement) {
  const Row moved = -(disparity + row_slope * (columns() + static_cast<float>(kLeft - kHalfHeight)));
  const RowOfInts truncated = __builtin_convertvector(moved, RowOfInts);
  const RowOfInts whole = truncated + (__builtin_convertvector(truncated, Row) > moved);  // true is -1
  const Row t = moved - __builtin_convertvector(whole, Row);
  const Row a = t + 2.F, b = t + 1.F, c = t - 1.F, d = t - 2.F, e = t - 3.F;
  const Row ab = a * b, de = d * e, tc = t * c;
  __builtin_memcpy(placement.whole, &whole, sizeof whole);
  store(placement.weights[0], b * tc * de * (-1.F / 120));
  store(placement.weights[1], a * tc * de * (1.F / 24));
  store(placement.weights[2], ab * c * de * (-1.F / 12));
  store(placement.weights[3], ab * t * de * (1.F / 12));
  store(placement.weights[4], ab * tc * e * (-1.F / 24));
  store(placement.weights[5], ab * tc * d * (1.F / 120));
}

void compare(const DisparityWindow& window, const std::uint8_t* centre, std::ptrdiff_t stride,
             float disparity, float row_slope, DisparityResiduals& residuals) {
  Placement placement;
  place(disparity, row_slope, placement);
  Row g{}, gy{}, l{}, one{}, squares{};
  for (int row = 0; row < DisparityWindow::kHeight; ++row) {
    const int y = row - kHalfHeight;
    const std::uint8_t* pixels = centre + y * stride - kLeft + placement.whole[row] - 2;
    Row right = load(pixels) * placement.weights[0][row] - kMiddle;
    for (int i = 1; i < 6; ++i) right += load(pixels + i) * placement.weights[i][row];
    const Row left = load(window.pixels + row * kWidth), residual = left - right;
    const Row weighted = weights(y) * residual;
    const Row along = weighted * load(window.gradients + row * kWidth);
    g += along, gy += along * static_cast<float>(y);
    l += weighted * left, one += weighted, squares += weighted * residual;
  }
  const double projected[] = {sum(g), sum(g * columns()), sum(gy), sum(l), sum(one)};
  __builtin_memcpy(residuals.projected, projected, sizeof projected);
  residuals.squares = sum(squares);
}

}  // namespace

extern const DisparityKernels kDisparityKernels;
const DisparityKernels kDisparityKernels{prepare, difference, compare};

}  // namespace cairn::CAIRN_ISA
