"""Facets of a dielectric, seen from the side that a walk is on.

Each side has its own frame, turned so that up leads out. With ``tau = -ln C1`` the depth on one
side, the other's is ``-ln(1 - exp(-tau))``. Facets reflect with probability ``F``, or refract:

    F D / (4 sigma(-d)),   (1 - F) D |d.m| eta^2 |w.m| / (sigma(-d) (|d.m| + eta w.m)^2)

`eta` is the index beyond over that of the side. Refraction turns z, exchanges the depths and
inverts `eta`.

Source: Heitz et al. 2016; `crates/specula-bsdf/src/multibounce/interface.rs`.
"""

from __future__ import annotations

from typing import Any

from .. import sampling
from ..runtime import dr, mi
from .facets import Facets

__all__ = [
    "bounce",
    "connection",
    "depth_beyond",
    "exit_rate",
    "leaves_beyond",
    "phase",
    "turned",
]


def turned(w: Any) -> Any:
    """The vector in the frame of the other side."""
    return mi.Vector3f(w.x, w.y, -w.z)


def depth_beyond(tau: Any) -> Any:
    """The depth as the other side sees it; a ray at the top is infinitely deep there."""
    share = dr.select(tau < 1e-3, tau * (1 - 0.5 * tau), 1 - dr.exp(-tau))
    return dr.maximum(-dr.log(dr.maximum(share, 1e-30)), 0)


def bounce(facets: Facets, d: Any, eta: Any, u: Any, u2: Any) -> tuple[Any, Any]:
    """The direction after a facet, in the frame of its side; whether it has changed sides."""
    ggx = facets.ggx
    m = dr.normalize(sampling.cap_half_vector(ggx.alpha_u, ggx.alpha_v, -d, u2))
    cosine = -dr.dot(d, m)
    fresnel, cos_t, _, eta_ti = mi.fresnel(cosine, eta)
    crosses = u >= fresnel
    bent = turned(m * (cosine * eta_ti + cos_t) + d * eta_ti)
    return dr.normalize(dr.select(crosses, bent, d + 2 * cosine * m)), crosses


def phase(facets: Facets, d: Any, eta: Any, w: Any, reflects: Any) -> Any:
    """Density of `bounce` towards `w`, by one branch; as importance, without ``1 / eta^2``."""
    half = w * dr.select(reflects, 1, eta) - d
    length2 = dr.squared_norm(half)
    m = half * dr.rsqrt(dr.maximum(length2, 1e-20))
    m = dr.mulsign(m, m.z)
    cos_d, cos_w = -dr.dot(d, m), dr.dot(w, m)
    lit = (length2 > 1e-12) & (cos_d > 0) & (dr.select(reflects, cos_w, -cos_w) > 0)
    fresnel = mi.fresnel(cos_d, eta)[0]
    jacobian = dr.square(eta) * dr.abs(cos_w) * cos_d
    jacobian /= dr.maximum(dr.square(cos_d + eta * cos_w), 1e-12)
    branch = dr.select(reflects, 0.25 * fresnel, (1 - fresnel) * jacobian)
    return dr.select(lit, branch * facets.ggx.d(m) / facets.facing(d), 0)


def exit_rate(facets: Facets, w: Any) -> Any:
    """``Lambda(w)`` of a direction that leaves on either side."""
    return facets.ggx.lambda_cos(w) / dr.maximum(dr.abs(w.z), 1e-12)


def connection(facets: Facets, d: Any, tau: Any, eta: Any, w: Any) -> Any:
    """`phase` times the probability of leaving along `w`, on either side, from the depth `tau`."""
    depth = dr.select(w.z > 0, tau, depth_beyond(tau))
    return phase(facets, d, eta, w, w.z > 0) * dr.exp(-depth * exit_rate(facets, w))


def leaves_beyond(rate: Any, leaving: Any) -> Any:
    """The mean over depths of ``Exp(rate)`` of the probability of leaving beyond:

        int l C^(l-1) (1 - C)^L dC = G(l + 1) G(L + 1) / G(l + L + 1)

    Above 64, where logarithms of G would lose digits, ``G(z + 1) / G(z + a + 1)`` is
    ``(z + (a + 1) / 2)^-a``.
    """
    small, large = dr.minimum(rate, leaving), dr.maximum(rate, leaving)
    exact = dr.lgamma(large + 1) - dr.lgamma(large + small + 1)
    power = -small * dr.log(large + 0.5 * (small + 1))
    quotient = dr.select(large > 64, power, exact)
    return dr.exp(dr.minimum(dr.lgamma(small + 1) + quotient, 0))
