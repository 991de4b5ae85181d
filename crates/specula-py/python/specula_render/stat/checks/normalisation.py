"""The integral of the pdf against the rate at which the sampler accepts samples."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..plan import Plan
from ..report import Check
from ..significance import poisson_tail, two_sided_p
from ..subject import Subject
from ..trial import Trial

MOST_ERROR = 1e-3
"""Integrals known less well prove nothing."""


def normalisation(
    subject: Subject, wo: npt.ArrayLike, plan: Plan | None = None, *, name: str = ""
) -> Check:
    """Checks that the share of samples that lead to a direction is the integral of the pdf.

    Parameters
    ----------
    subject, wo, plan, name
        As for `chi_square`.

    Raises
    ------
    ValueError
        As for `chi_square`.
    """
    plan = plan or Plan()
    return of_trial(Trial.of(subject, wo, plan, name), plan.significance_of_each(1))


def of_trial(trial: Trial, significance: float) -> Check:
    """The check of a view that is sampled and integrated."""
    value, error = trial.forest.totals()
    integral, n = float(value[0]), float(trial.plan.samples)
    accepted = float(np.count_nonzero(trial.is_accepted))
    p = acceptance_p(accepted, n, integral, error + trial.rounding)
    return Check(
        name="integral of pdf",
        value=p,
        bound=significance,
        passed=p >= significance and error < MOST_ERROR,
        detail=f"integral {integral:.6f} +- {error:.1e}, accepted {accepted / n:.6f}",
        view=trial.view,
        is_p_value=True,
    )


def acceptance_p(accepted: float, samples: float, integral: float, slack: float) -> float:
    """Chance of an acceptance this far from the integral, known within `slack`."""
    possible = -slack <= integral <= 1.0 + slack
    if not possible or not math.isfinite(slack):
        return 0.0
    expected = min(max(integral, 0.0), 1.0) * samples
    variance = expected * (1.0 - expected / samples)
    if variance > 25.0:
        apart = max(abs(accepted - expected) - 0.5 - slack * samples, 0.0)
        return two_sided_p(apart / math.sqrt(variance))
    if expected > 0.5 * samples:
        tail = poisson_tail(samples - accepted, samples - expected, slack * samples)
    else:
        tail = poisson_tail(accepted, expected, slack * samples)
    return min(2.0 * tail, 1.0)
