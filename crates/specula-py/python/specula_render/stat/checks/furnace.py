"""The white furnace: the mean weight of samples against the quadrature of `f cos`.

Single scattering loses light, so the expectation is the directional albedo `E(wo)`, not 1.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from ..plan import Plan
from ..report import Check
from ..significance import sidak, two_sided_p
from ..subject import Subject
from ..trial import Trial
from .normalisation import MOST_ERROR


def furnace(
    subject: Subject, wo: npt.ArrayLike, plan: Plan | None = None, *, name: str = ""
) -> Check:
    """Checks that the mean weight of the samples is the albedo by quadrature.

    ``E(wo) = integral of f(wo, wi) |cos theta_i| dwi``, without Dirac deltas; rejected samples
    count as zero. A difference counts only where neither the samples' variance nor rare events
    that no sample met explain it: n samples miss an event of probability q with probability
    ``exp(-n q)``.

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
    n = trial.plan.samples
    weight = np.where(trial.is_accepted[:, None], trial.samples.weight, 0.0)
    with np.errstate(invalid="ignore", over="ignore"):
        mean = weight.mean(axis=0)
        deviation = np.sqrt(weight.var(axis=0, ddof=1) / n)
    # Single precision rounds sums of weights, and eval itself, besides.
    slack = error + 1e-7 + 1e-2 * trial.tolerance
    p_values = [
        _p_value(float(m), float(s), float(v), slack, n)
        for m, s, v in zip(mean, deviation, value[1:], strict=True)
    ]
    worst = int(np.argmin(p_values))
    bound = sidak(significance, 3)
    colour = ("red", "green", "blue")[worst]
    return Check(
        name="furnace",
        value=p_values[worst],
        bound=bound,
        passed=p_values[worst] >= bound and error < MOST_ERROR,
        detail=(
            f"{colour}: sampled {mean[worst]:.6f} +- {2.576 * deviation[worst]:.1e}, "
            f"quadrature {value[1 + worst]:.6f} +- {error:.1e}"
        ),
        view=trial.view,
        is_p_value=True,
    )


def _p_value(mean: float, deviation: float, value: float, slack: float, n: int) -> float:
    if not (math.isfinite(mean) and math.isfinite(value)):
        return 0.0
    apart = max(abs(mean - value) - slack, 0.0)
    if apart == 0.0:
        return 1.0
    unseen = math.exp(-apart * n / max(value, 1.0))
    by_chance = two_sided_p(apart / deviation) if deviation > 0.0 else 0.0
    return max(by_chance, unseen)
