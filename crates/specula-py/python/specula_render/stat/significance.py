"""Chances: of a normal number, of a Poisson count, of chi-square, and for many tests at once."""

from __future__ import annotations

import math

from .gamma import gamma_lower, gamma_upper


def sidak(significance: float, tests: int) -> float:
    """Significance of each of `tests` tests that gives the whole family `significance`.

    ``1 - (1 - significance)^(1/tests)``

    Source: Sidak 1967. Where tests share samples it is Bonferroni's bound, exact for any
    dependence, but for a factor of at most ``1 + significance / 2``.
    """
    return -math.expm1(math.log1p(-significance) / max(tests, 1))


def two_sided_p(z: float) -> float:
    """Chance that a standard normal number lies at least `|z|` from 0.

    NaN gives 0: a mean that is not a number equals nothing.
    """
    return 0.0 if math.isnan(z) else math.erfc(abs(z) / math.sqrt(2.0))


def chi_square_survival(statistic: float, degrees_of_freedom: int) -> float:
    """Chance of a chi-square at least as large as `statistic`; 0 where that is not finite."""
    if not math.isfinite(statistic):
        return 0.0
    if degrees_of_freedom == 0:
        return 1.0
    return gamma_upper(0.5 * degrees_of_freedom, 0.5 * max(statistic, 0.0))


def poisson_tail(observed: float, expected: float, error: float) -> float:
    """Chance of a Poisson count this far out, where the mean is known within `error`."""
    high = expected + error
    low = max(expected - error, 0.0)
    if not math.isfinite(high):
        return 0.0
    if observed < 0.5:
        at_least = 1.0
    elif high <= 0.0:
        at_least = 0.0
    else:
        at_least = gamma_lower(observed, high)
    at_most = 1.0 if low <= 0.0 else gamma_upper(observed + 1.0, low)
    return min(at_least, at_most)
