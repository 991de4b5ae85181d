"""What to test and how strictly."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .arrays import FloatArray
from .significance import sidak
from .sphere import direction

TESTS_PER_VIEW = 3
"""Statistical tests for each view: chi-square, integral of the pdf, furnace."""


@dataclass(frozen=True)
class Plan:
    """Options of `prove` and of the single checks.

    Raises
    ------
    ValueError
        If a value is out of its range.
    """

    samples: int = 100_000
    """Samples of each view; a tenth of them for checks of each single sample or direction."""
    cells: int = 400
    """About how many cells of the chi-square test hold the samples."""
    significance: float = 0.01
    """Chance of a false alarm over the whole report, or over all of `tests`."""
    tests: int | None = None
    """How many statistical tests share `significance`; None: those of the report, or one."""
    relative_tolerance: float | None = None
    """Largest relative difference of values that should be equal; None: the subject's."""
    eta: float = 1.0
    """Index of refraction below the surface (z < 0) over that above it; 1 if nothing refracts."""
    transport: Literal["radiance", "importance"] = "radiance"
    """What `eval` carries."""
    reciprocity: Literal["nowhere", "above", "everywhere"] = "above"
    """For which pairs reciprocity is required: none, both directions above the surface, any."""
    hemispheres: Literal["both", "upper"] = "both"
    """`upper`: `eval` and `pdf` are asked for no `wi` below the horizon, and samples there count
    as rejected."""
    sharpness: float = 0.1
    """Angular width, radians, that quadrature starts with about the mirror direction and those
    of transmission. Narrower lobes are found by samples besides."""
    cos_theta_edges: Sequence[float] = ()
    """Where the pdf has steps, besides half vectors at the horizon: cosines of polar angles."""
    max_patches: int = 20_000
    """Most patches of the quadrature of a view, 225 directions for each."""
    seed: int = 0
    """Of all random numbers."""

    def __post_init__(self) -> None:
        choices = {
            "transport": ("radiance", "importance"),
            "reciprocity": ("nowhere", "above", "everywhere"),
            "hemispheres": ("both", "upper"),
        }
        for name, allowed in choices.items():
            if getattr(self, name) not in allowed:
                came = repr(getattr(self, name))
                raise ValueError(f"{name}: one of {', '.join(allowed)} expected, {came} came")
        least = {"samples": 100, "cells": 1, "max_patches": 1, "seed": 0}
        for name, bound in least.items():
            if getattr(self, name) < bound:
                raise ValueError(f"{name}: at least {bound} expected, {getattr(self, name)} came")
        if self.tests is not None and self.tests < 1:
            raise ValueError(f"tests: at least 1 expected, {self.tests} came")
        if not 0.0 < self.significance < 1.0:
            raise ValueError(f"significance: in (0, 1) expected, {self.significance} came")
        for name in ("eta", "sharpness"):
            value = getattr(self, name)
            if not (value > 0.0 and math.isfinite(value)):
                raise ValueError(f"{name}: a positive number expected, {value} came")

    def significance_of_each(self, tests: int) -> float:
        """Significance of each statistical test, where `tests` are made."""
        return sidak(self.significance, tests if self.tests is None else self.tests)


def views(
    cos_theta: Sequence[float] = (1.0, 0.7, 0.3, 0.05),
    azimuth_deg: Sequence[float] = (20.0, 110.0),
    *,
    below: bool = False,
) -> FloatArray:
    """View directions `wo` for `prove`.

    Parameters
    ----------
    cos_theta
        Cosines of the polar angle, in [-1, 1].
    azimuth_deg
        Azimuths, degrees; all but the first are left out at the poles.
    below
        Whether to add the views mirrored below the surface.

    Returns
    -------
    ndarray, (n, 3)
        Unit vectors.

    Raises
    ------
    ValueError
        If a cosine is out of [-1, 1].
    """
    pairs: list[tuple[float, float]] = []
    for k, c in enumerate(cos_theta):
        if not -1.0 <= c <= 1.0:
            raise ValueError(f"cos_theta[{k}]: in [-1, 1] expected, {c} came")
        azimuths = azimuth_deg[:1] if abs(c) == 1.0 else azimuth_deg
        pairs += [(c, math.radians(a)) for a in azimuths]
    angles = np.array(pairs, dtype=np.float64).reshape(-1, 2)
    w = direction(angles[:, 0], angles[:, 1])
    return np.concatenate([w, w * [1.0, 1.0, -1.0]]) if below else w
