// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace cairn {

/// Highest degree that real_roots accepts.
inline constexpr std::size_t kMaxDegree = 10;

/// Computes the real roots of c[0] + c[1] x + ... + c[n] x^n at which it changes its sign, to full precision,
/// and returns their number. A root of even order is found only if rounding splits it in two.
///
/// Between neighbouring real roots of the derivative a polynomial is monotone, so each such interval holds at
/// most one root, found by Newton steps kept in their bracket; the derivative's roots come from its own
/// derivative in the same way. |x| <= 1 is searched directly, the rest as 1/x on the polynomial with its
/// coefficients reversed, so all intervals are bounded. `coefficients` has 2 to kMaxDegree + 1 elements,
/// `roots` room for one less; throws PreconditionError otherwise.
[[nodiscard]] std::size_t real_roots(std::span<const double> coefficients, std::span<double> roots);

}  // namespace cairn
