"""What every walk over the facets of a metal needs: rates of flights, a bounce, a connection.

The surface is a medium whose depth ``tau = -ln C1(h) >= 0`` is measured by the distribution of its
heights. A ray along ``d`` meets facets at the rate ``sigma(-d) / |d.z|`` per unit of tau, and a ray
that would leave along ``w`` from the depth ``tau`` does so with probability ``exp(-tau rate(w))``.

Source: Heitz et al. 2016, *Multiple-Scattering Microfacet BSDFs with the Smith Model*; in the depth
as `crates/specula-bsdf/src/multibounce/walk.rs` has it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import sampling
from ..runtime import dr, is_jit, mi

__all__ = ["MAX_BOUNCES", "Facets", "advance", "stream", "uniform2"]

#: Bounces after which a walk ends; fewer than 1e-6 of the energy go on, but at grazing views.
MAX_BOUNCES = 64


def stream(*values: Any) -> Any:
    """A random number generator seeded by the bits of numbers: evaluation is given no sampler."""
    state = mi.UInt32(0x9E3779B9)
    for value in values:
        state = _bits(value) ^ (state * mi.UInt32(0x85EBCA6B))
        if not is_jit():
            state &= 0xFFFFFFFF
        state ^= state >> 15
        state *= mi.UInt32(0xC2B2AE35)
        if not is_jit():
            state &= 0xFFFFFFFF
        state ^= state >> 13
    return mi.PCG32(initstate=mi.UInt64(state), initseq=mi.UInt64(1))


def _bits(value: Any) -> Any:
    if is_jit():
        return dr.reinterpret_array(mi.UInt32, mi.Float(value))
    return int(np.float32(value).view(np.uint32))


def uniform2(rng: Any) -> Any:
    """Two numbers, uniform in [0, 1)."""
    x = rng.next_float32()
    return mi.Point2f(x, rng.next_float32())


class Facets:
    """GGX facets of a metal.

    Parameters
    ----------
    ggx : ggx.Ggx
        Their distribution.
    reflectance : callable
        Spectrum of the cosine of incidence.
    """

    def __init__(self, ggx: Any, reflectance: Any) -> None:
        self.ggx = ggx
        self.reflectance = reflectance

    def facing(self, d: Any) -> Any:
        """``sigma(-d)``: the area of the facets that a ray along `d` can meet."""
        return dr.maximum(self.ggx.lambda_cos(d), 1e-24) + dr.maximum(-d.z, 0)

    def rate(self, d: Any) -> Any:
        """``|Lambda(d)|``: facets met per unit of depth along `d`."""
        return self.facing(d) / dr.maximum(dr.abs(d.z), 1e-12)

    def bounce(self, d: Any, u: Any) -> tuple[Any, Any, Any]:
        """A facet that `d` meets, its reflectance, and the direction after it."""
        m = dr.normalize(sampling.cap_half_vector(self.ggx.alpha_u, self.ggx.alpha_v, -d, u))
        along = dr.dot(d, m)
        return m, self.reflectance(dr.clip(-along, 0, 1)), d - 2 * along * m

    def connection(self, d: Any, wo: Any) -> tuple[Any, Any]:
        """``F`` and ``D(m) / 4`` of the facet ``m`` that turns `d` to `wo`; ``D`` 0 if none does.

        ``F D / (4 sigma(-d))`` is the density of `bounce` towards `wo` times the reflectance.
        """
        half = wo - d
        length2 = dr.squared_norm(half)
        m = half * dr.rsqrt(dr.maximum(length2, 1e-12))
        quarter_d = dr.select((m.z > 0) & (length2 > 1e-12), 0.25 * self.ggx.d(m), 0)
        return self.reflectance(dr.clip(dr.dot(wo, m), 0, 1)), quarter_d

    def single(self, wi: Any, wo: Any) -> Any:
        """``f cos`` of light that met one facet, ``F D G2 / (4 wi.z)``; G2 height-correlated."""
        fresnel, quarter_d = self.connection(-wi, wo)
        return fresnel * (quarter_d * self.ggx.g2_over_cos(wi, wo, True))


def advance(facets: Facets, d: Any, tau: Any, rng: Any) -> Any:
    """The depth of the next facet along `d`; below 0 where the ray has left."""
    step = -dr.log(dr.maximum(1 - rng.next_float32(), 1e-12)) / facets.rate(d)
    return dr.select(d.z > 0, tau - step, tau + step)
