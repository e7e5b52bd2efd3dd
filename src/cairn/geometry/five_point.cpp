// SPDX-License-Identifier: Apache-2.0
#include "cairn/geometry/five_point.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "cairn/geometry/polynomial.h"

namespace cairn {
namespace {

// Polynomials in x, y, z: of degree 1 over (x, y, z, 1), of degree 2 over (x2 y2 z2 xy xz yz x y z 1), of
// degree 3 in Nister's order (2004, sec. 3.2.1): x3 y3 x2y xy2 x2z x2 y2z y2 xyz xy xz2 xz x yz2 yz y z3 z2 z
// 1
using Linear = Eigen::Matrix<double, 4, 1>;
using Quadratic = Eigen::Matrix<double, 10, 1>;
using Cubic = Eigen::Matrix<double, 20, 1>;
using LinearMatrix = std::array<std::array<Linear, 3>, 3>;

constexpr int kLinearTimesLinear[4][4] = {{0, 3, 4, 6}, {3, 1, 5, 7}, {4, 5, 2, 8}, {6, 7, 8, 9}};
constexpr int kQuadraticTimesLinear[10][4] = {
    {0, 2, 4, 5},   {3, 1, 6, 7},   {10, 13, 16, 17}, {2, 3, 8, 9},     {4, 8, 10, 11},
    {8, 6, 13, 14}, {5, 9, 11, 12}, {9, 7, 14, 15},   {11, 14, 17, 18}, {12, 15, 18, 19}};

void add_product(const Linear& a, const Linear& b, double factor, Quadratic& sum) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) sum[kLinearTimesLinear[i][j]] += factor * a[i] * b[j];
}

void add_product(const Quadratic& a, const Linear& b, Cubic& sum) {
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 4; ++j) sum[kQuadraticTimesLinear[i][j]] += a[i] * b[j];
}

/// X, Y, Z, W as rows of nine, row by row: the null space of rows b_i (x) a_i.
Eigen::Matrix<double, 9, 4> null_space(const std::array<Eigen::Vector2d, 5>& a,
                                       const std::array<Eigen::Vector2d, 5>& b) {
  Eigen::Matrix<double, 9, 5> constraints;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector2d& p = a[static_cast<std::size_t>(i)];
    const Eigen::Vector2d& q = b[static_cast<std::size_t>(i)];
    constraints.col(i) << q.x() * p.x(), q.x() * p.y(), q.x(), q.y() * p.x(), q.y() * p.y(), q.y(), p.x(),
        p.y(), 1;
  }
  const Eigen::HouseholderQR<Eigen::Matrix<double, 9, 5>> qr(constraints);
  Eigen::Matrix<double, 9, 4> last = Eigen::Matrix<double, 9, 4>::Zero();
  last.bottomRows<4>().setIdentity();
  return qr.householderQ() * last;
}

Cubic determinant(const LinearMatrix& e) {
  Cubic sum = Cubic::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    Quadratic minor = Quadratic::Zero();
    add_product(e[1][j], e[2][k], 1, minor);
    add_product(e[1][k], e[2][j], -1, minor);
    add_product(minor, e[0][i], sum);
  }
  return sum;
}

/// The ten cubics: det E, and the elements of E E^T E - tr(E E^T) E / 2.
Eigen::Matrix<double, 10, 20> cubic_constraints(const LinearMatrix& e) {
  std::array<std::array<Quadratic, 3>, 3> eet;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      Quadratic& sum = eet[i][j];
      sum.setZero();
      for (std::size_t k = 0; k < 3; ++k) add_product(e[i][k], e[j][k], 1, sum);
      eet[j][i] = sum;
    }
  }
  const Quadratic half_trace = 0.5 * (eet[0][0] + eet[1][1] + eet[2][2]);
  for (std::size_t i = 0; i < 3; ++i) eet[i][i] -= half_trace;
  Eigen::Matrix<double, 10, 20> constraints;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Cubic sum = Cubic::Zero();
      for (std::size_t k = 0; k < 3; ++k) add_product(eet[i][k], e[k][j], sum);
      constraints.row(static_cast<Eigen::Index>(3 * i + j)) = sum.transpose();
    }
  }
  constraints.row(9) = determinant(e).transpose();
  return constraints;
}

// Polynomials in z are arrays of their coefficients, rising powers.

template <std::size_t A, std::size_t B>
std::array<double, A + B - 1> product(const std::array<double, A>& a, const std::array<double, B>& b) {
  std::array<double, A + B - 1> result{};
  for (std::size_t i = 0; i < A; ++i)
    for (std::size_t j = 0; j < B; ++j) result[i + j] += a[i] * b[j];
  return result;
}

template <std::size_t A>
std::array<double, A> difference(const std::array<double, A>& a, const std::array<double, A>& b) {
  std::array<double, A> result{};
  for (std::size_t i = 0; i < A; ++i) result[i] = a[i] - b[i];
  return result;
}

template <std::size_t A>
double value_at(const std::array<double, A>& a, double z) {
  double value = 0;
  for (std::size_t i = A; i-- > 0;) value = value * z + a[i];
  return value;
}

/// One row of Nister's B(z): its product with (x, y, 1) vanishes.
struct BRow {
  std::array<double, 4> x, y;
  std::array<double, 5> one;
};

/// Row p minus z times row q of the eliminated system, whose leading terms then cancel.
BRow subtract_rows(const Eigen::Matrix<double, 10, 10>& m, int p, int q) {
  return {{m(p, 2), m(p, 1) - m(q, 2), m(p, 0) - m(q, 1), -m(q, 0)},
          {m(p, 5), m(p, 4) - m(q, 5), m(p, 3) - m(q, 4), -m(q, 3)},
          {m(p, 9), m(p, 8) - m(q, 9), m(p, 7) - m(q, 8), m(p, 6) - m(q, 7), -m(q, 6)}};
}

std::array<double, 11> determinant(const std::array<BRow, 3>& b) {
  std::array<double, 11> sum{};
  for (std::size_t i = 0; i < 3; ++i) {
    const BRow &first = b[(i + 1) % 3], &second = b[(i + 2) % 3];
    const auto minor = difference(product(first.x, second.y), product(first.y, second.x));
    const auto term = product(minor, b[i].one);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += term[k];
  }
  return sum;
}

/// (x, y, 1) up to scale at a root z: the longest cross product of two rows of B(z).
Eigen::Vector3d null_vector(const std::array<BRow, 3>& b, double z) {
  std::array<Eigen::Vector3d, 3> rows;
  for (std::size_t i = 0; i < 3; ++i)
    rows[i] = Eigen::Vector3d(value_at(b[i].x, z), value_at(b[i].y, z), value_at(b[i].one, z)).normalized();
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d cross = rows[i].cross(rows[(i + 1) % 3]);
    if (cross.squaredNorm() > longest.squaredNorm()) longest = cross;
  }
  return longest;
}

LinearMatrix linear_matrix(const Eigen::Matrix<double, 9, 4>& basis) {
  LinearMatrix e;
  for (std::size_t i = 0; i < 9; ++i) e[i / 3][i % 3] = basis.row(static_cast<Eigen::Index>(i)).transpose();
  return e;
}

}  // namespace

FivePointSolutions solve_five_point(const std::array<Eigen::Vector2d, 5>& a,
                                    const std::array<Eigen::Vector2d, 5>& b) {
  FivePointSolutions solutions;
  const Eigen::Matrix<double, 9, 4> basis = null_space(a, b);
  const Eigen::Matrix<double, 10, 20> constraints = cubic_constraints(linear_matrix(basis));
  const Eigen::PartialPivLU<Eigen::Matrix<double, 10, 10>> lu(constraints.leftCols<10>());
  constexpr double kSmallestPivot = 1e-14;
  if (!(lu.matrixLU().diagonal().cwiseAbs().minCoeff() > kSmallestPivot)) return solutions;
  const Eigen::Matrix<double, 10, 10> reduced = lu.solve(constraints.rightCols<10>());
  const std::array<BRow, 3> rows{subtract_rows(reduced, 4, 5), subtract_rows(reduced, 6, 7),
                                 subtract_rows(reduced, 8, 9)};
  std::array<double, 10> roots{};
  const std::size_t root_count = real_roots(determinant(rows), roots);
  for (std::size_t i = 0; i < root_count; ++i) {
    const double z = roots[i];
    const Eigen::Vector3d xy1 = null_vector(rows, z);
    const Eigen::Matrix<double, 9, 1> e =
        basis * Eigen::Vector4d(xy1.x(), xy1.y(), z * xy1.z(), xy1.z()).eval();
    const double norm = e.norm();
    if (!(norm > 0) || !std::isfinite(norm)) continue;
    Eigen::Matrix3d& essential = solutions.essential[solutions.count++];
    essential =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(e.data()) * (std::sqrt(2.0) / norm);
  }
  return solutions;
}

}  // namespace cairn
