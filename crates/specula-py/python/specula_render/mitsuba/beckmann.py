"""Beckmann facets, by Mitsuba's own distribution: pictures agree with ``roughconductor``'s.

Spherical caps and the exact sampler rest on GGX's normals being a stretched sphere's; Beckmann has
Mitsuba's sampler of visible normals only.
"""

from __future__ import annotations

from typing import Any

from .runtime import dr, mi

__all__ = ["Beckmann"]


class Beckmann:
    """Beckmann facets with the interface of `ggx.Ggx`.

    Parameters
    ----------
    alpha_u, alpha_v : Float
        Widths along x and y.
    """

    def __init__(self, alpha_u: Any, alpha_v: Any) -> None:
        self.alpha_u, self.alpha_v = alpha_u, alpha_v
        self._distribution = mi.MicrofacetDistribution(
            mi.MicrofacetType.Beckmann, mi.Float(alpha_u), mi.Float(alpha_v), True
        )

    def d(self, m: Any) -> Any:
        """Density of normals in 1/sr; `m` unit."""
        return self._distribution.eval(m)

    def g1(self, w: Any) -> Any:
        """Smith's masking, Walter et al.'s rational fit; ``w.z > 0``."""
        return self._distribution.smith_g1(w, mi.Vector3f(0, 0, 1))

    def g2_over_cos(self, wi: Any, wo: Any, height_correlated: bool) -> Any:
        """``G2(wi, wo) / wi.z``; both above the horizon."""
        g_i, g_o = self.g1(wi), self.g1(wo)
        if height_correlated:
            return g_i * g_o / (wi.z * dr.maximum(g_i + g_o - g_i * g_o, 1e-12))
        return g_i * g_o / wi.z

    def norm(self, wi: Any) -> Any:
        """``N`` of the density ``D(m) / (4 N)``: the visible area ``wi.z / G1``."""
        return wi.z / dr.maximum(self.g1(wi), 1e-12)

    def half_vector(self, wi: Any, u: Any) -> Any:
        """A visible normal; ``wi.z > 0``, `u` uniform in [0, 1)^2."""
        return self._distribution.sample(wi, u)[0]
