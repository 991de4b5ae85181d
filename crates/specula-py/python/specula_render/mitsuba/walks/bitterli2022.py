"""Bitterli and d'Eon 2022, *A Position-Free Path Integral for Homogeneous Slabs and Multiple
Scattering on Smith Microfacets*: the unidirectional estimator, with heights integrated.

A walk of directions goes on after an upward flight with the probability that a facet meets it, and
connects at every facet with ``F D / (4 sigma(-d))`` times the probability of leaving along `wo`.
Both come from the distribution of depths.

Departures: that distribution has the form of `depth_state`, which cancels nothing, not the paper's
hyperexponential one; each walk's value is the same. The paper gives no sampling of directions: that
of `heitz2016` has the same law.

Source: `crates/specula-bsdf/src/multibounce/bitterli2022.rs`.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from .depth_state import DepthState
from .facets import MAX_BOUNCES, Facets, uniform2

__all__ = ["eval"]


@syntax
def eval(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f cos``."""
    total, weight = facets.single(wi, wo), mi.Spectrum(1)
    d, bounces = -wi, mi.UInt32(1)
    state, leaving = DepthState(facets.rate(d)), facets.rate(wo)
    stays = mi.Mask(active)
    while stays & (bounces < MAX_BOUNCES):
        _, fresnel, d = facets.bounce(d, uniform2(rng))
        weight *= fresnel
        is_up, before = d.z > 0, mi.Float(state.mass)
        stays &= is_up | state.has_room()
        state.fly(facets.rate(d), is_up)
        stays &= rng.next_float32() * before < state.mass
        fresnel, quarter_d = facets.connection(d, wo)
        leaves = state.exit(leaving) / dr.maximum(state.mass, 1e-30)
        here = dr.select(stays, quarter_d / facets.facing(d) * leaves, 0)
        total += weight * fresnel * here
        bounces += 1
    return total
