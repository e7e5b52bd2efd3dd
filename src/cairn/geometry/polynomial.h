// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace cairn {

/// Highest degree that real_roots takes.
inline constexpr std::size_t kMaxDegree = 10;

/// The real roots of c[0] + c[1] x + ... + c[n] x^n at which it changes its sign, to full precision; returns
/// their number. A root of even order is found only where rounding makes two of it.
///
/// Between neighbouring real roots of the derivative a polynomial is monotone, so each such interval holds at
/// most one root, found by Newton steps kept in their bracket; the derivative's roots come from its own
/// derivative in the same way. |x| <= 1 is searched as it is, the rest as 1/x on the polynomial with its
/// coefficients reversed, so all intervals are bounded. `coefficients` has 2 to kMaxDegree + 1 elements,
/// `roots` room for one less.
[[nodiscard]] std::size_t real_roots(std::span<const double> coefficients, std::span<double> roots);

}  // namespace cairn
