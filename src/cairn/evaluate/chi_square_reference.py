# SPDX-License-Identifier: Apache-2.0
"""Reference values of chi_square_test.cpp: `python3 chi_square_reference.py`.

Quantiles of the chi-square distribution to 17 digits: the series of the incomplete gamma function with 60 digits, and
bisection. Needs nothing but Python.
"""
from decimal import Decimal, getcontext

getcontext().prec = 60
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")


def gamma_above(a):
    """gamma(a + 1) for whole and half a, from gamma(1/2) = sqrt(pi)."""
    value, step = (PI.sqrt(), Decimal("0.5")) if a % 1 else (Decimal(1), Decimal(1))
    while step <= a:
        value *= step
        step += 1
    return value


def probability(value, degrees):
    a, x = Decimal(degrees) / 2, value / 2
    term = total = (a * x.ln() - x).exp() / gamma_above(a)
    n = a
    while term > total * Decimal("1e-50") or x > n:
        n += 1
        term *= x / n
        total += term
    return total


def quantile(p, degrees):
    low, high = Decimal(0), Decimal(degrees) + 1
    while probability(high, degrees) < p:
        high *= 2
    for _ in range(140):
        middle = (low + high) / 2
        low, high = (middle, high) if probability(middle, degrees) < p else (low, middle)
    return high


for k in (1, 2, 3, 6, 59, 60, 61, 300, 1001):
    for p in ("1e-10", "0.025", "0.5", "0.68", "0.95", "0.975", "0.999"):
        print(f"    {{{k}, {p}, {quantile(Decimal(p), k):.17g}}},")
