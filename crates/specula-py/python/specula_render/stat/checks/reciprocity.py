"""Helmholtz reciprocity: exchanging `wo` and `wi` changes nothing, but for the factor eta^2 of
refraction."""

from __future__ import annotations

import numpy as np

from ..arrays import BoolArray, FloatArray
from ..randomness import generator, probes, triples
from ..plan import Plan
from ..report import Check, digits
from ..subject import Subject

_PAIRS = 10_000


def reciprocity(subject: Subject, plan: Plan | None = None, *, name: str = "") -> Check:
    """Checks over pairs of directions, half of them samples of the lobe itself, that

    ::

        f(wo, wi) / n(wo)^2 = f(wi, wo) / n(wi)^2        radiance
        f(wo, wi) / n(wi)^2 = f(wi, wo) / n(wo)^2        importance

    where `n(w)` is the index of the medium that `w` is in: `plan.eta` below the surface, 1 above.

    Pairs with a direction within 1e-6 of the horizon are left out: f is `eval` over the cosine,
    which has no accurate digits there. Differences below 1e-13 per steradian pass: near-zero
    values of f have few accurate digits. In single precision the two bounds are 1e-3 and 1e-6,
    and ten times the tolerance passes: half vectors of refraction cancel.

    Parameters
    ----------
    subject
        The BSDF.
    plan
        Options; `Plan()` where left out. Its `reciprocity` tells which pairs are tested;
        "nowhere" is taken as "above" here.
    name
        With `plan.seed` it names the random numbers.

    Raises
    ------
    ValueError
        If a callable returns a wrong shape.

    Notes
    -----
    Source: Veach 1997, eq. 5.14.
    """
    plan = plan or Plan()
    own = plan.relative_tolerance
    tolerance = subject.relative_tolerance if own is None else own
    tolerance *= 10.0 if subject.is_single else 1.0
    wo, wi = _pairs(subject, plan, name)
    near, far = (wo, wi) if plan.transport == "radiance" else (wi, wo)
    with np.errstate(all="ignore"):
        there = subject.eval(wo, wi) / (np.abs(wi[:, 2]) * _index_squared(near, plan))[:, None]
        back = subject.eval(wi, wo) / (np.abs(wo[:, 2]) * _index_squared(far, plan))[:, None]
        scale = np.maximum(np.abs(there), np.abs(back))
        least = 1e-6 if subject.is_single else 1e-13
        off = (np.abs(there - back) - least) / np.maximum(scale, 1e-12)
        off = np.nan_to_num(off.max(axis=1, initial=0.0), nan=np.inf, posinf=np.inf)
    worst = float(off.max(initial=0.0))
    k = int(np.argmax(off)) if len(off) else 0
    failed = int(np.count_nonzero(off > tolerance))
    if not np.any(scale > 0.0):
        passed, detail = False, "eval is zero everywhere: nothing was compared"
    elif failed:
        passed = False
        detail = (
            f"{failed} of {len(wo)} pairs; worst: wo {digits(wo[k])}, wi {digits(wi[k])}: "
            f"{digits(there[k])} there, {digits(back[k])} back"
        )
    else:
        passed, detail = True, f"{len(wo)} pairs, within {worst:.1e}"
    return Check("reciprocity", worst, tolerance, passed, detail)


def _pairs(subject: Subject, plan: Plan, name: str) -> tuple[FloatArray, FloatArray]:
    rng = generator(plan.seed, f"{name} reciprocity")
    wo, wi = probes(_PAIRS, rng), probes(_PAIRS, rng)
    is_above = plan.reciprocity != "everywhere" or plan.hemispheres == "upper"
    if is_above:
        wo[:, 2] = np.abs(wo[:, 2])
    half = _PAIRS // 2
    samples = subject.sample(wo[:half].copy(), triples(subject, half, rng))
    wi[:half] = samples.wi
    keep: BoolArray = np.ones(_PAIRS, dtype=np.bool_)
    keep[:half] = samples.is_accepted
    keep &= np.isfinite(wi).all(axis=1)
    nearest = 1e-3 if subject.is_single else 1e-6
    keep &= np.minimum(np.abs(wo[:, 2]), np.abs(np.nan_to_num(wi[:, 2]))) >= nearest
    if is_above:
        keep &= ~(wi[:, 2] < 0.0)
    return wo[keep], wi[keep]


def _index_squared(w: FloatArray, plan: Plan) -> FloatArray:
    return np.where(w[:, 2] < 0.0, plan.eta * plan.eta, 1.0)
