"""Cui, Pan, Yang, Zhang, Yan and Wang 2023, *Multiple-bounce Smith Microfacet BRDFs using the
Invariance Principle*: the unidirectional estimator.

A path ``d_0 .. d_k`` weighs ``prod v_i S_k`` with ``v = F D / (4 |d.z|)`` and the segment term of
the whole path (eq. 14). Walks go on whether or not they would have left, and make up for it.

Departures: ``S_k`` times the product of the rates is `DepthState.exit`, in place of the tables of
algorithm 1. Corrections of the publication, as in the library: samples leave with ``G1 = 1 / (1 +
Lambda)``, not ``1 / |Lambda|`` (algorithm 2); roulette is a fixed 0.7 after the second bounce, not
``S_k`` clamped (algorithm 3).

Source: `crates/specula-bsdf/src/multibounce/cui2023.rs`.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from .depth_state import DepthState
from .facets import MAX_BOUNCES, Facets, uniform2

__all__ = ["GOES_ON", "SURE", "eval", "sample"]

#: Bounces without roulette, and the probability of each beyond.
SURE, GOES_ON = 2, 0.7


@syntax
def eval(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f cos``."""
    total, weight = mi.Spectrum(0), mi.Spectrum(1)
    d, bounces, goes_on = -wi, mi.UInt32(0), mi.Mask(active)
    state, leaving = DepthState(facets.rate(d)), facets.rate(wo)
    while goes_on & (bounces < MAX_BOUNCES):
        # v / p = F |Lambda(d)|, and of the last v: 1 / |d.z| = |Lambda(d)| / sigma(-d).
        fresnel, quarter_d = facets.connection(d, wo)
        total += weight * fresnel * (quarter_d / facets.facing(d) * state.exit(leaving))

        is_sure = bounces < SURE
        goes_on &= is_sure | (rng.next_float32() < GOES_ON)
        weight *= dr.select(is_sure, 1, 1 / GOES_ON)
        _, fresnel, d = facets.bounce(d, uniform2(rng))
        weight *= fresnel
        goes_on &= (d.z > 0) | state.has_room()
        state.fly(facets.rate(d), d.z > 0)
        bounces += 1
    return total


@syntax
def sample(facets: Facets, wi: Any, u: Any, rng: Any, active: Any) -> tuple[Any, Any]:
    """A direction and its weight: walks leave with probability G1 whatever came before."""
    d, weight, bounces = -wi, mi.Spectrum(1), mi.UInt32(0)
    state, stays = DepthState(facets.rate(d)), mi.Mask(active)
    while stays & (bounces < MAX_BOUNCES):
        _, fresnel, d = facets.bounce(d, u)
        is_up, rate = d.z > 0, facets.rate(d)
        has_room = is_up | state.has_room()
        left = state.fly(rate, is_up)
        leaves = is_up & (rng.next_float32() * (1 + rate) < 1)
        # The mass that leaves over the probability of doing so, or of staying.
        factor = dr.select(leaves, left * (1 + rate), dr.select(is_up, (1 + rate) / rate, 1))
        weight *= fresnel * dr.select(has_room, factor, 0)
        stays = (leaves ^ True) & has_room
        u = uniform2(rng)
        bounces += 1
    return d, dr.select(stays, 0, weight)
