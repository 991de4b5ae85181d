"""Stratified walks at a dielectric, Specula's own, from the end whose walks vary less.

On the side where a walk begins it needs no height (`depth_state`). Light that met one facet is in
closed form. Once a walk refracts, or has more downward flights than the state has room for, its
depth is sampled from the state, and it goes on with heights (`heitz2016`).

Source: `crates/specula-bsdf/src/multibounce/stratified_bidirectional.rs`. Departure: there the state
has room for all flights.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from . import interface
from .depth_state import DepthState
from .facets import MAX_BOUNCES, Facets, advance, uniform2
from .heitz2016 import collisions
from .stratified_bidirectional import SPLIT, stratum, survival

__all__ = ["eval"]

#: Downward flights before heights are sampled.
_ROOM = 6


@syntax
def eval(facets: Facets, eta: Any, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f |cos|``, as importance; `wi` above the horizon, `eta` beyond it."""
    reflects = wo.z > 0
    # f / eta^2 is symmetric.
    swaps = _is_better_end(facets, eta, wi, wo) ^ True
    there, back = interface.turned(wo), interface.turned(wi)
    start = dr.select(swaps, dr.select(reflects, wo, there), wi)
    end = dr.select(swaps, dr.select(reflects, wi, back), wo)
    cosines = dr.abs(wo.z) / wi.z * dr.select(reflects, 1, dr.square(eta))
    factor = dr.select(swaps, cosines, 1)
    eta = dr.select(swaps & (reflects ^ True), dr.rcp(eta), eta)

    rate, leaving = facets.rate(-start), interface.exit_rate(facets, end)
    once = dr.select(
        reflects, rate / (rate + leaving), interface.leaves_beyond(rate, leaving)
    )
    total = interface.phase(facets, -start, eta, end, reflects) * once
    shift, k = uniform2(rng), mi.UInt32(0)
    while active & (k < SPLIT):
        total += _walk(facets, eta, start, end, stratum(shift, k), rng) / SPLIT
        k += 1
    return total * factor


def _is_better_end(facets: Facets, eta: Any, wi: Any, wo: Any) -> Any:
    """Whether walks from `wi` are the better ones: at the more grazing end; of two that are alike,
    inside on smooth surfaces and outside on rough ones."""
    cos_i, cos_o = wi.z, dr.abs(wo.z)
    a4 = dr.square(facets.ggx.alpha_u * facets.ggx.alpha_v)
    outside = 1.02 - 0.22 * dr.minimum(a4, 1)
    through = dr.select(eta > 1, cos_o >= outside * cos_i, cos_i < outside * cos_o)
    return dr.select(wo.z > 0, cos_i <= cos_o, through)


@syntax
def _walk(facets: Facets, eta: Any, start: Any, end: Any, u2: Any, rng: Any) -> Any:
    """One walk's estimate of two facets and more."""
    d, total, weight = -start, mi.Float(0), mi.Float(1)
    state, leaving = DepthState(facets.rate(d), _ROOM), interface.exit_rate(facets, end)
    reflects, bounces = end.z > 0, mi.UInt32(1)
    goes_on, crosses, is_full = mi.Mask(True), mi.Mask(False), mi.Mask(False)
    while goes_on & (bounces < MAX_BOUNCES):
        d, crosses = interface.bounce(facets, d, eta, rng.next_float32(), u2)
        is_up = d.z > 0
        is_full = (crosses | is_up | state.has_room()) ^ True
        goes_on = (crosses | is_full) ^ True
        if goes_on:
            state.fly(facets.rate(d), is_up)
            leaves = state.exit(leaving)
            if reflects ^ True:
                depth = interface.depth_beyond(state.sample(rng))
                leaves = state.mass * dr.exp(-depth * leaving)
            total += weight * interface.phase(facets, d, eta, end, reflects) * leaves
            likely = survival(weight * state.mass)
            goes_on = rng.next_float32() < likely
            weight /= dr.maximum(likely, 1e-30)
        u2 = uniform2(rng)
        bounces += 1
    # The next flight is `d`, and the state that of the facet before it.
    depth = state.sample(rng)
    depth = advance(facets, d, dr.select(crosses, interface.depth_beyond(depth), depth), rng)
    eta = dr.select(crosses, dr.rcp(eta), eta)
    end = dr.select(crosses, interface.turned(end), end)
    rest = collisions(facets, d, depth, eta, end, rng, crosses | is_full)
    return total + weight * state.mass * rest
