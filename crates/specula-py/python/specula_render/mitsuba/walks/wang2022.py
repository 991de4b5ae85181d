"""Wang, Jin, Fan, Yang, Holzschuch and Yan 2022, *Position-Free Multiple-Bounce Computations for
Smith Microfacet BSDFs*: every bounce is independent of those before.

With ``l = |Lambda(d)|`` of the incoming flight and ``L = Lambda(d')`` of an outgoing upward one, the
probability of leaving is

    height-correlated    l / (l + L)       every collision as deep as Exp(l)
    height-uncorrelated  1 / (1 + L)       G1

and 0 for a downward one. The model's bias is its own: it loses no energy, but is not Heitz's model
beyond one bounce. The uncorrelated one is reciprocal, the correlated one is not.

Source: `crates/specula-bsdf/src/multibounce/wang2022.rs`, which measures the bias.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from .facets import MAX_BOUNCES, Facets, uniform2

__all__ = ["eval", "sample"]

#: Bounces without roulette, and the probability of each beyond.
_SURE, _GOES_ON = 2, 0.7


@syntax
def eval(
    facets: Facets, wi: Any, wo: Any, rng: Any, active: Any, correlated: bool = True
) -> Any:
    """An estimate of the model's ``f cos``."""
    total, weight = mi.Spectrum(0), mi.Spectrum(1)
    d, bounces, goes_on = -wi, mi.UInt32(0), mi.Mask(active)
    leaving = facets.rate(wo)
    while goes_on & (bounces < MAX_BOUNCES):
        against = facets.rate(d) if correlated else mi.Float(1)
        fresnel, quarter_d = facets.connection(d, wo)
        leaves = against / (against + leaving)
        total += weight * fresnel * (quarter_d / facets.facing(d) * leaves)

        is_sure = bounces < _SURE
        goes_on &= is_sure | (rng.next_float32() < _GOES_ON)
        weight *= dr.select(is_sure, 1, 1 / _GOES_ON)
        _, fresnel, d = facets.bounce(d, uniform2(rng))
        rate = facets.rate(d)
        weight *= fresnel * dr.select(d.z > 0, rate / (against + rate), 1)
        bounces += 1
    return total


@syntax
def sample(
    facets: Facets, wi: Any, u: Any, rng: Any, active: Any, correlated: bool = True
) -> tuple[Any, Any]:
    """Where a walk leaves, and the product of its facets' reflectances."""
    d, weight, bounces = -wi, mi.Spectrum(1), mi.UInt32(0)
    stays = mi.Mask(active)
    while stays & (bounces < MAX_BOUNCES):
        against = facets.rate(d) if correlated else mi.Float(1)
        _, fresnel, d = facets.bounce(d, u)
        weight *= fresnel
        leaves = against / (against + facets.rate(d))
        stays = (d.z <= 0) | (rng.next_float32() >= leaves)
        u = uniform2(rng)
        bounces += 1
    return d, dr.select(stays, 0, weight)
