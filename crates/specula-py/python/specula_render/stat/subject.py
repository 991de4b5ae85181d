"""A BSDF under test: three callables over arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import BoolArray, FloatArray, Function, returned
from .mitsuba_bsdf import callables, is_mitsuba

SINGLE_TOLERANCE = 1e-3
"""Largest relative difference of equal values in single precision."""
DOUBLE_TOLERANCE = 1e-9
"""Largest relative difference of equal values in double precision."""
_SPECULAR = 3
"""The least of the outcomes that are specular: 3 reflection, 4 transmission."""


@dataclass(frozen=True)
class Samples:
    """Sampled directions."""

    wi: FloatArray
    """Towards the light, unit, (n, 3)."""
    weight: FloatArray
    """`f |cos theta_i| / pdf`, (n, 3)."""
    pdf: FloatArray
    """1/sr, (n,); 0 where the sample is rejected."""
    is_specular: BoolArray
    """Whether a sample is of a Dirac delta, which `eval` and `pdf` leave out, (n,)."""

    @property
    def is_accepted(self) -> BoolArray:
        """Samples of the density: neither rejected nor specular, (n,)."""
        return np.asarray((self.pdf != 0.0) & ~self.is_specular)


class Subject:
    """A BSDF under test.

    Directions are unit vectors in the local frame, z up, away from the surface. `wo` is given,
    towards the viewer; `wi` is sampled, towards the light.

    Parameters
    ----------
    eval
        ``eval(wo, wi)``, both (n, 3): ``f |cos theta_i|`` in 1/sr, (n, 3), or (n,) for grey.
    pdf
        ``pdf(wo, wi)``: density of `sample` in 1/sr, (n,). It integrates to the share of the
        samples that are accepted.
    sample
        ``sample(wo, u)`` with `u` (n, 3) uniform in [0, 1): a tuple of wi (n, 3), weight (n, 3)
        or (n,), which is ``f |cos theta_i| / pdf``, and pdf (n,), 0 for a rejected sample. A
        fourth array, (n,) of bool, may tell which samples are of a Dirac delta: `eval` and `pdf`
        leave those out.
    relative_tolerance
        Largest relative difference of values that should be equal. None: 1e-3 where `eval`
        returns single precision, else 1e-9.

    Raises
    ------
    TypeError
        If one of the three cannot be called.

    Notes
    -----
    What the callables return is checked whenever they are called; ValueError tells the shape
    that was expected and the one that came.

    Examples
    --------
    >>> import numpy as np
    >>> def cosine(wo, wi):
    ...     return np.maximum(wi[:, 2], 0.0) * (wo[:, 2] > 0.0) / np.pi
    >>> def sample(wo, u):
    ...     r, phi = np.sqrt(u[:, 0]), 2.0 * np.pi * u[:, 1]
    ...     wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1.0 - u[:, 0])], axis=1)
    ...     return wi, np.ones(len(wi)), cosine(wo, wi)
    >>> lambert = Subject(eval=cosine, pdf=cosine, sample=sample)
    """

    def __init__(
        self,
        eval: Function,
        pdf: Function,
        sample: Function,
        *,
        relative_tolerance: float | None = None,
    ) -> None:
        for name, function in (("eval", eval), ("pdf", pdf), ("sample", sample)):
            if not callable(function):
                raise TypeError(f"{name}: a callable expected, {type(function).__name__} came")
        self._eval, self._pdf, self._sample = eval, pdf, sample
        self._tolerance = relative_tolerance

    @classmethod
    def of(cls, bsdf: Any, *, relative_tolerance: float | None = None) -> Subject:
        """A BSDF with methods over arrays, such as the lobes of `specula_render`.

        Parameters
        ----------
        bsdf
            ``bsdf.eval(wo, wi)`` and ``bsdf.pdf(wo, wi)`` as above; ``bsdf.sample(wo, u)`` an
            object with `wi`, `weight`, `pdf` and perhaps `is_specular` or `outcome`, which is 3
            or 4 for specular samples. A `Subject` is returned as it is, and a BSDF of Mitsuba
            taken by `of_mitsuba`.
        relative_tolerance
            As above.

        Raises
        ------
        TypeError
            If a method is missing.
        ValueError
            If ``bsdf.is_stochastic``: its `eval` is an estimate, so quadrature of it and
            comparison with it would both be noise.
        """
        if isinstance(bsdf, Subject):
            return bsdf
        if is_mitsuba(bsdf):
            return cls.of_mitsuba(bsdf, relative_tolerance=relative_tolerance or SINGLE_TOLERANCE)
        missing = [m for m in ("eval", "pdf", "sample") if not callable(getattr(bsdf, m, None))]
        if missing:
            raise TypeError(f"{type(bsdf).__name__} has no method {', '.join(missing)}")

        if getattr(bsdf, "is_stochastic", False) is True:
            raise ValueError(
                f"{type(bsdf).__name__} is stochastic: its eval is an estimate, not a value"
            )

        def sample(wo: FloatArray, u: FloatArray) -> tuple[Any, ...]:
            sampled = bsdf.sample(wo, u)
            parts = (sampled.wi, sampled.weight, sampled.pdf)
            if hasattr(sampled, "is_specular"):
                return (*parts, sampled.is_specular)
            if hasattr(sampled, "outcome"):
                return (*parts, np.asarray(sampled.outcome) >= _SPECULAR)
            return parts

        return cls(bsdf.eval, bsdf.pdf, sample, relative_tolerance=relative_tolerance)

    @classmethod
    def of_mitsuba(cls, bsdf: Any, *, relative_tolerance: float = SINGLE_TOLERANCE) -> Subject:
        """A BSDF of Mitsuba 3, of a vectorised RGB or monochrome variant such as `llvm_ad_rgb`.

        Mitsuba's `wi` is our `wo`, and its `wo` our `wi`. Delta components are left out of the
        density, as in its own `eval` and `pdf`.

        Raises
        ------
        ImportError
            If Mitsuba is missing.
        ValueError
            If the variant is scalar, spectral or polarised.
        """
        return cls(*callables(bsdf), relative_tolerance=relative_tolerance)

    @property
    def relative_tolerance(self) -> float:
        """Largest relative difference of values that should be equal."""
        if self._tolerance is None:
            up = np.array([[0.0, 0.0, 1.0]])
            dtype = getattr(self._eval(up, up.copy()), "dtype", None)
            is_single = dtype in (np.dtype(np.float32), np.dtype(np.float16))
            self._tolerance = SINGLE_TOLERANCE if is_single else DOUBLE_TOLERANCE
        return self._tolerance

    @property
    def is_single(self) -> bool:
        """Whether values are to be compared with the accuracy of single precision."""
        return self.relative_tolerance >= 1e-6

    def eval(self, wo: FloatArray, wi: FloatArray) -> FloatArray:
        """`f |cos theta_i|`, 1/sr, (n, 3)."""
        value = self._eval(wo, wi)
        return returned(value, "eval", len(wi), 3, spread=True)

    def pdf(self, wo: FloatArray, wi: FloatArray) -> FloatArray:
        """Density of `sample`, 1/sr, (n,)."""
        return returned(self._pdf(wo, wi), "pdf", len(wi), 0)

    def sample(self, wo: FloatArray, u: FloatArray) -> Samples:
        """Directions from uniform random numbers (n, 3)."""
        sampled = self._sample(wo, u)
        if not isinstance(sampled, (tuple, list)) or len(sampled) not in (3, 4):
            what = type(sampled).__name__
            if isinstance(sampled, (tuple, list)):
                what += f" of {len(sampled)}"
            raise ValueError(f"sample: a tuple (wi, weight, pdf) expected, {what} came")
        n = len(wo)
        is_specular = np.zeros(n, dtype=np.bool_)
        if len(sampled) == 4:
            is_specular = returned(sampled[3], "sample: is_specular", n, 0) != 0.0
        return Samples(
            wi=returned(sampled[0], "sample: wi", n, 3),
            weight=returned(sampled[1], "sample: weight", n, 3, spread=True),
            pdf=returned(sampled[2], "sample: pdf", n, 0),
            is_specular=is_specular,
        )


def repeated(w: npt.ArrayLike, n: int) -> FloatArray:
    """One direction (3,) as n rows, (n, 3), contiguous."""
    return np.tile(np.asarray(w, dtype=np.float64), (n, 1))
