"""Checks at each single sample and direction: `weight = f cos / pdf`, and values are finite and
non-negative."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import BoolArray, FloatArray, is_unit
from ..randomness import generator, probes
from ..plan import Plan
from ..report import Check, digits
from ..subject import Subject, repeated
from ..trial import Trial


def consistency(
    subject: Subject, wo: npt.ArrayLike, plan: Plan | None = None, *, name: str = ""
) -> list[Check]:
    """Checks samples of one view, and directions all over the sphere.

    At samples: `wi` is a unit vector; `pdf` is positive and what the sampler says; `weight` is
    `eval / pdf`; where specular, `weight` is finite and non-negative. At directions, some of
    them within rounding of the horizon and the poles: `eval` and `pdf` are finite and
    non-negative.

    Parameters
    ----------
    subject, wo, plan, name
        As for `chi_square`.

    Returns
    -------
    list of Check
        That of the samples, and that of the directions.

    Raises
    ------
    ValueError
        As for `chi_square`.
    """
    trial = Trial.of(subject, wo, plan or Plan(), name)
    return [of_samples(trial), of_directions(trial)]


def of_samples(trial: Trial) -> Check:
    """Checks a tenth of the samples of a view."""
    count = max(trial.plan.samples // 10, 1)
    is_specular = trial.samples.is_specular
    here = np.flatnonzero((trial.is_accepted | is_specular)[:count])
    wi, weight = trial.samples.wi[here], trial.samples.weight[here]
    reported, is_delta = trial.samples.pdf[here], is_specular[here]
    wo = repeated(trial.wo, len(here))
    value = trial.subject.eval(wo, wi) if len(here) else np.zeros((0, 3))
    pdf = trial.subject.pdf(wo, wi) if len(here) else np.zeros(0)
    with np.errstate(all="ignore"):
        quotient = value / pdf[:, None]
        # Absolute below 1e-3: a weight of 1e-12 need not have as many digits.
        scale = np.fmax(np.fmax(weight, quotient), 1e-3)
        off = (np.abs(weight - quotient) / scale).max(axis=1, initial=0.0)
        pdf_off = np.abs(reported - pdf) / pdf
        faults = [
            ("wi is not a unit vector", ~is_unit(wi)),
            ("weight is negative or not finite", ~_is_sane(weight)),
            ("eval is negative or not finite", ~_is_sane(value) & ~is_delta),
            ("pdf is not positive at a sample", ~(np.isfinite(pdf) & (pdf > 0.0)) & ~is_delta),
            ("pdf is not the sampler's", ~(pdf_off <= trial.tolerance) & ~is_delta),
            ("weight is not eval / pdf", ~(off <= trial.tolerance) & ~is_delta),
        ]
    is_wrong = np.any([wrong for _, wrong in faults], axis=0)
    both = np.where(is_delta, 0.0, np.fmax(off, pdf_off))
    worst = float(np.nan_to_num(both, nan=np.inf).max(initial=0.0))
    if is_wrong.any():
        k = int(np.argmax(is_wrong))
        fault = next(text for text, wrong in faults if wrong[k])
        detail = (
            f"{np.count_nonzero(is_wrong)} of {len(here)} samples; first: {fault}: "
            f"u {digits(trial.u[here[k]])}, wi {digits(wi[k])}, weight {digits(weight[k])}, "
            f"pdf {reported[k]:.9g} sampled and {pdf[k]:.9g}, eval {digits(value[k])}"
        )
    else:
        detail = f"{len(here)} samples, within {worst:.1e}"
    return Check(
        name="weight = f cos / pdf",
        value=worst,
        bound=trial.tolerance,
        passed=not is_wrong.any(),
        detail=detail,
        view=trial.view,
    )


def of_directions(trial: Trial) -> Check:
    """Checks as many directions as the other check takes samples."""
    count = max(trial.plan.samples // 10, 1)
    wi = probes(count, generator(trial.plan.seed, f"{trial.seed_name} directions"))
    if trial.plan.hemispheres == "upper":
        wi[:, 2] = np.abs(wi[:, 2])
    wo = repeated(trial.wo, count)
    value, pdf = trial.subject.eval(wo, wi), trial.subject.pdf(wo, wi)
    with np.errstate(invalid="ignore"):
        is_wrong = ~(_is_sane(value) & np.isfinite(pdf) & (pdf >= 0.0))
    wrong = int(np.count_nonzero(is_wrong))
    detail = f"{count} directions"
    if wrong:
        k = int(np.argmax(is_wrong))
        detail = (
            f"{wrong} of {count} directions; first: wi {digits(wi[k])}: eval {digits(value[k])}, "
            f"pdf {pdf[k]:.9g}"
        )
    return Check(
        name="finite and non-negative",
        value=float(wrong),
        bound=0.0,
        passed=wrong == 0,
        detail=detail,
        view=trial.view,
    )


def _is_sane(colour: FloatArray) -> BoolArray:
    return np.asarray((np.isfinite(colour) & (colour >= 0.0)).all(axis=1))
