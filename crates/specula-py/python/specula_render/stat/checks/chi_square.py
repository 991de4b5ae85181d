"""Goodness of fit: do samples on the sphere follow the pdf, missing mass included?

The sphere is cut at the horizon, at steps of the pdf, and into a grid in theta and phi; then
cells are halved until none expects more than its share of the samples, so that a narrow lobe is
resolved as well as a wide one. Expected counts are adaptive quadratures.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, is_unit
from ..plan import Plan
from ..report import Check
from ..significance import chi_square_survival, poisson_tail
from ..subject import Subject
from ..tree import cell_error_bound
from ..trial import Trial

_COARSE = 30.0
"""About how many cells the coarse grid has."""
_LEAST = 5.0
"""Cells that expect fewer samples are pooled."""


@dataclass(frozen=True)
class ChiSquare:
    """The outcome of a chi-square test."""

    view: tuple[float, float, float]
    """`wo`."""
    statistic: float
    """Sum over cells of `(observed - expected)^2 / expected`."""
    degrees_of_freedom: int
    p_value: float
    """Chance of a result at least this bad were the samples right."""
    significance: float
    """What `p_value` is compared with."""
    samples: int
    """How many were taken."""
    integral: float
    """Of the pdf."""
    rejected: int
    """Samples that were rejected."""
    invalid: int
    """Samples that were not unit vectors, or whose pdf was not a positive number."""
    patches: FloatArray
    """All cells before pooling, (c, 4): bounds of theta and of phi, radians."""
    expected: FloatArray
    """Counts expected from the pdf, (c,)."""
    error: FloatArray
    """Estimated errors of `expected`, (c,)."""
    observed: FloatArray
    """Counts observed, (c,)."""
    is_converged: bool
    """Whether the expected counts are known well enough for this many samples."""

    @property
    def passed(self) -> bool:
        """Whether the samples agree with the pdf."""
        return self.is_converged and self.p_value >= self.significance

    @property
    def residual(self) -> FloatArray:
        """`(observed - expected) / sqrt(expected)`, (c,); at least one count is divided by."""
        with np.errstate(invalid="ignore"):
            scale = np.sqrt(np.fmax(self.expected, 1.0))
        return np.asarray((self.observed - self.expected) / scale)

    @property
    def worst_residual(self) -> float:
        """The largest residual, of either sign."""
        return float(np.abs(np.nan_to_num(self.residual, nan=np.inf)).max())

    def check(self) -> Check:
        """The test as one line of a report."""
        return Check(
            name="chi-square",
            value=self.p_value,
            bound=self.significance,
            passed=self.passed,
            detail=str(self),
            view=self.view,
            is_p_value=True,
        )

    def figure(self, title: str = "") -> Any:
        """Observed and expected counts and their difference, as a figure of Matplotlib.

        Raises
        ------
        ImportError
            If Matplotlib is missing.
        """
        from ..figure import chi_square_figure

        return chi_square_figure(self, title)

    def __str__(self) -> str:
        text = (
            f"chi^2 {self.statistic:.0f} of {self.degrees_of_freedom} degrees, pdf integrates "
            f"to {self.integral:.5f}, {self.rejected} of {self.samples} rejected"
        )
        if self.invalid:
            text += f", {self.invalid} invalid"
        if not self.is_converged:
            text += ", quadrature of the pdf did not converge"
        if not self.passed:
            residual = np.abs(np.nan_to_num(self.residual, nan=np.inf))
            for k in np.argsort(-residual, kind="stable")[:3]:
                theta, phi = np.degrees(self.patches[k].reshape(2, 2).mean(axis=1))
                text += (
                    f"; theta {theta:.1f} phi {phi:.1f}: {self.observed[k]:.0f} for "
                    f"{self.expected[k]:.1f} +- {self.error[k]:.1g}"
                )
        return text


def chi_square(
    subject: Subject, wo: npt.ArrayLike, plan: Plan | None = None, *, name: str = ""
) -> ChiSquare:
    """Compares samples of one view with the pdf.

    The fit is tested twice, on the grid and on about thirty groups of neighbouring cells: a fine
    grid alone is blind to a small bias of a whole region, a coarse one to structure. Rejected
    samples are a cell of their own: it expects what the pdf's integral lacks to 1.

    Parameters
    ----------
    subject
        The BSDF.
    wo
        The view, unit, (3,).
    plan
        Options; `Plan()` where left out.
    name
        With `plan.seed` and the view it names the random numbers.

    Raises
    ------
    ValueError
        If `wo` is not a unit vector, or a callable returns a wrong shape.

    Notes
    -----
    Source: Pearson 1900. Cells that expect fewer than five samples are pooled, and where even
    the pool does, it is tested as a Poisson count; a sample where the pdf is zero is such a case.
    """
    plan = plan or Plan()
    trial = Trial.of(subject, wo, plan, name)
    return of_trial(trial, plan.significance_of_each(1))


def of_trial(trial: Trial, significance: float) -> ChiSquare:
    """The test of a view that is sampled and integrated."""
    n = trial.plan.samples
    forest = trial.forest
    cells, cell_of = forest.cells(1.0 / trial.plan.cells)
    expected, error = forest.value[cells, 0] * n, forest.error[cells] * n
    wi, pdf = trial.samples.wi, trial.samples.pdf
    with np.errstate(invalid="ignore", over="ignore"):
        is_valid = is_unit(wi) & (pdf > 0.0) & np.isfinite(pdf)
    counted = trial.is_accepted & is_valid
    invalid = int(np.count_nonzero(trial.is_accepted & ~is_valid))
    located = cell_of[forest.locate(wi[counted])]
    observed = np.bincount(located[located >= 0], minlength=len(cells)).astype(np.float64)
    rejected = n - int(np.count_nonzero(counted)) - invalid
    mass = float(expected.sum())
    missing = (max(n - mass, 0.0), float(error.sum()), float(rejected))
    statistic, degrees, fit, tail = _pearson(expected, error, observed, missing)
    groups = _grouped(expected, error, observed, n / _COARSE)
    coarse_fit = _pearson(*groups, missing)[2]
    # Three tests, so each has a third of the chance (Bonferroni).
    p_value = min(3.0 * min(fit, coarse_fit, tail), 1.0)
    is_too_much = mass - n > missing[1] + max(1e-6, trial.rounding) * n
    is_wrong = invalid > 0 or is_too_much or not np.isfinite([statistic, mass]).all()
    return ChiSquare(
        view=trial.view,
        statistic=statistic,
        degrees_of_freedom=degrees,
        p_value=0.0 if is_wrong else p_value,
        significance=significance,
        samples=n,
        integral=mass / n,
        rejected=rejected,
        invalid=invalid,
        patches=forest.patches[cells],
        expected=expected,
        error=error,
        observed=observed,
        is_converged=bool((error <= cell_error_bound(expected)).all()),
    )


def _grouped(
    expected: FloatArray, error: FloatArray, observed: FloatArray, least: float
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Neighbouring cells pooled until each group expects `least`."""
    starts, total = [0], 0.0
    for k, count in enumerate(expected):
        if total >= least:
            starts.append(k)
            total = 0.0
        total += float(count)

    def pooled(values: FloatArray) -> FloatArray:
        return np.add.reduceat(values, starts)

    return pooled(expected), pooled(error), pooled(observed)


def _pearson(
    expected: FloatArray,
    error: FloatArray,
    observed: FloatArray,
    missing: tuple[float, float, float],
) -> tuple[float, int, float, float]:
    """Statistic, degrees of freedom, chance of the fit, and that of cells that expect no sample."""
    expected = np.append(expected, missing[0])
    error = np.append(error, missing[1])
    observed = np.append(observed, missing[2])
    with np.errstate(invalid="ignore"):
        is_small = expected < _LEAST
    pool = [float(values[is_small].sum()) for values in (expected, observed, error)]
    expected, observed = expected[~is_small], observed[~is_small]
    tail = 1.0
    if pool[0] >= _LEAST:
        expected, observed = np.append(expected, pool[0]), np.append(observed, pool[1])
    else:
        tail = poisson_tail(pool[1], pool[0], pool[2])
    with np.errstate(invalid="ignore", over="ignore"):
        statistic = float(np.sum((observed - expected) ** 2 / expected))
    degrees = max(len(expected) - 1, 0)
    return statistic, degrees, chi_square_survival(statistic, degrees), tail
