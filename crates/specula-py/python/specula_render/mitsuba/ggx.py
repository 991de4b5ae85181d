"""GGX: distribution of normals, Smith's masking, and reflections off visible normals.

Mitsuba's names: ``wi`` is the view, ``wo`` the direction that is sampled. Directions point away
from the surface; the local frame has z up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import exact, sampling
from .runtime import dr

__all__ = ["LEAST_ALPHA", "SAMPLERS", "Ggx"]

#: Samplers of reflections, the default first.
SAMPLERS = ("exact", "bounded", "cap", "heitz")
#: Mitsuba's lower bound of alphas.
LEAST_ALPHA = 1e-4


@dataclass(frozen=True)
class Ggx:
    """GGX facets.

    Attributes
    ----------
    alpha_u, alpha_v : Float
        Widths along x and y.
    isotropic : bool
        Whether both widths are the same parameter.
    sampler : str
        One of `SAMPLERS`; they differ in the constant ``N`` of ``pdf = D(m) / (4 N)``.
    """

    alpha_u: Any
    alpha_v: Any
    isotropic: bool
    sampler: str = "exact"

    def d(self, m: Any) -> Any:
        """Density of normals in 1/sr; `m` unit. Walter et al. 2007, eq. 33, for two alphas."""
        t = dr.square(m.x / self.alpha_u) + dr.square(m.y / self.alpha_v) + dr.square(m.z)
        return dr.rcp(dr.pi * self.alpha_u * self.alpha_v * dr.square(t))

    def tangential2(self, w: Any) -> Any:
        """``(alpha_u x)^2 + (alpha_v y)^2``."""
        return dr.square(self.alpha_u * w.x) + dr.square(self.alpha_v * w.y)

    def length(self, w: Any) -> Any:
        """Length of the direction stretched by the alphas."""
        return dr.sqrt(self.tangential2(w) + dr.square(w.z))

    def lambda_cos(self, w: Any) -> Any:
        """``Lambda |z| = (length - |z|) / 2`` above the horizon, without cancellation."""
        radius2 = self.tangential2(w)
        return 0.5 * radius2 / (dr.sqrt(radius2 + dr.square(w.z)) + dr.abs(w.z))

    def g1(self, w: Any) -> Any:
        """Smith's masking; ``w.z > 0``."""
        return 2 * w.z / (w.z + self.length(w))

    def g2_over_cos(self, wi: Any, wo: Any, height_correlated: bool) -> Any:
        """``G2(wi, wo) / wi.z``; both above the horizon.

        Source: Heitz 2014, eqs. 98 (separable) and 99 (height-correlated).
        """
        length_i, length_o = self.length(wi), self.length(wo)
        if height_correlated:
            return 2 * wo.z / (wi.z * length_o + wo.z * length_i)
        return 4 * wo.z / ((wi.z + length_i) * (wo.z + length_o))

    def norm(self, wi: Any) -> Any:
        """``N`` of the density ``D(m) / (4 N)`` of reflections; ``wi.z > 0``."""
        if self.sampler == "exact":
            return exact.norm(self.alpha_u, self.alpha_v, self.isotropic, wi)
        if self.sampler == "bounded":
            return sampling.bounded_norm(self.alpha_u, self.alpha_v, wi)
        return 0.5 * (wi.z + self.length(wi))

    def half_vector(self, wi: Any, u: Any) -> Any:
        """Unit half vector of `wi` and its reflection; ``wi.z > 0``, `u` uniform in [0, 1)^2."""
        if self.sampler == "exact":
            m = exact.half_vector(self.alpha_u, self.alpha_v, self.isotropic, wi, u)
        elif self.sampler == "bounded":
            m = sampling.bounded_half_vector(self.alpha_u, self.alpha_v, wi, u)
        elif self.sampler == "heitz":
            m = sampling.heitz_half_vector(self.alpha_u, self.alpha_v, wi, u)
        else:
            m = sampling.cap_half_vector(self.alpha_u, self.alpha_v, wi, u)
        return dr.normalize(m)
