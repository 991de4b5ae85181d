"""All checks of one BSDF over a list of views."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from .arrays import unit_directions
from .checks import chi_square, consistency, furnace, normalisation
from .checks.reciprocity import reciprocity
from .plan import TESTS_PER_VIEW, Plan
from .plan import views as default_views
from .report import Report
from .subject import Subject
from .trial import Trial


def prove(
    name: str,
    subject: Any,
    views: npt.ArrayLike | None = None,
    plan: Plan | None = None,
) -> Report:
    """Runs every check of a BSDF for each of the views.

    The checks of a view share its samples and its quadrature.

    Parameters
    ----------
    name
        What reports call it; the random numbers are those of this name and `plan.seed`.
    subject
        A `Subject`, or what `Subject.of` takes.
    views
        Unit directions `wo`, (n, 3), local frame; below the horizon too, where the BSDF has
        light there. `stat.views()` where left out.
    plan
        Options; `Plan()` where left out.

    Returns
    -------
    Report
        Five checks for each view, and one of reciprocity.

    Raises
    ------
    ValueError
        If a view is not a unit vector (its index is named), or a callable returns a wrong shape.
    TypeError
        If `subject` has not the methods of a BSDF.
    """
    plan = plan or Plan()
    tested = Subject.of(subject)
    directions = unit_directions(default_views() if views is None else views, "views")
    significance = plan.significance_of_each(TESTS_PER_VIEW * len(directions))
    report = Report(name)
    for wo in directions:
        trial = Trial.of(tested, wo, plan, name)
        fit = chi_square.of_trial(trial, significance)
        report.fits.append(fit)
        report.checks += [
            fit.check(),
            normalisation.of_trial(trial, significance),
            consistency.of_samples(trial),
            consistency.of_directions(trial),
            furnace.of_trial(trial, significance),
        ]
    if plan.reciprocity != "nowhere":
        report.checks.append(reciprocity(tested, plan, name=name))
    return report
