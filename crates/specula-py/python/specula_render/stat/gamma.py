"""The regularised incomplete gamma functions, for tails of chi-square and Poisson laws.

The series converges fast below `x = a + 1`, the continued fraction above.

Source: Abramowitz and Stegun 1964, eqs. 6.5.29 and 6.5.31; the fraction by the modified Lentz
method (Thompson and Barnett 1986).
"""

from __future__ import annotations

import math

_EPSILON = 1e-16
_TINY = 1e-300


def gamma_lower(a: float, x: float) -> float:
    """`P(a, x)`: the integral of `t^(a-1) e^-t` from 0 to x, over `Gamma(a)`.

    Parameters
    ----------
    a
        Positive.
    x
        Not negative; may be infinite.

    Returns
    -------
    float
        In [0, 1].

    Raises
    ------
    ValueError
        If `a` or `x` is out of its range or not a number.
    """
    _check(a, x)
    if x == 0.0:
        return 0.0
    if math.isinf(x):
        return 1.0
    return _series(a, x) if x < a + 1.0 else 1.0 - _fraction(a, x)


def gamma_upper(a: float, x: float) -> float:
    """`Q(a, x) = 1 - P(a, x)`, accurate where it is small.

    The survival function of chi-square with k degrees of freedom is `Q(k / 2, chi^2 / 2)`.

    Parameters
    ----------
    a, x
        As for `gamma_lower`.

    Returns
    -------
    float
        In [0, 1].

    Raises
    ------
    ValueError
        As for `gamma_lower`.
    """
    _check(a, x)
    if x == 0.0:
        return 1.0
    if math.isinf(x):
        return 0.0
    return 1.0 - _series(a, x) if x < a + 1.0 else _fraction(a, x)


def _check(a: float, x: float) -> None:
    if not (a > 0.0 and math.isfinite(a) and x >= 0.0):
        raise ValueError(f"incomplete gamma: a > 0 and x >= 0 expected, a = {a}, x = {x} came")


def _prefactor(a: float, x: float) -> float:
    """`x^a e^-x / Gamma(a)`."""
    return math.exp(a * math.log(x) - x - math.lgamma(a))


def _most_terms(a: float) -> int:
    # Near x = a both need a few times sqrt(a) terms.
    return 500 + int(20.0 * math.sqrt(a))


def _series(a: float, x: float) -> float:
    term = total = 1.0 / a
    for n in range(1, _most_terms(a)):
        term *= x / (a + n)
        total += term
        if term < total * _EPSILON:
            break
    return min(total * _prefactor(a, x), 1.0)


def _fraction(a: float, x: float) -> float:
    b = x + 1.0 - a
    c = 1.0 / _TINY
    d = 1.0 / (b if b != 0.0 else _TINY)
    value = d
    for n in range(1, _most_terms(a)):
        numerator = -n * (n - a)
        b += 2.0
        d = numerator * d + b
        c = b + numerator / c
        d = 1.0 / (d if d != 0.0 else _TINY)
        c = c if c != 0.0 else _TINY
        value *= c * d
        if abs(c * d - 1.0) < 2.0 * _EPSILON:
            break
    return min(max(value * _prefactor(a, x), 0.0), 1.0)
