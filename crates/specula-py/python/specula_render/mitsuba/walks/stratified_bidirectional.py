"""Stratified bidirectional walks, Specula's own: walks of directions from both ends.

After each bounce a walk connects to the other end, with the mass that leaves (`depth_state`):

    C_k = W  F D(h) / (4 sigma(-d))  exit(Lambda_o)            W: product of F and 1 / roulette

The same path is sampled from the other end with a density whose quotient by this one is

    R_k = D(h_(k-1)) / D(h_0)  prod_(i=0)^(k-2) sigma(-d_i) / prod_(i=2)^k sigma(d_i)

so that the balance heuristic is ``C_k / (1 + R_k)`` from each end. The first bounces of both ends
are stratified over two points. Walks go on with probability ``min(1, 2 W mass)``.

Samples leave with exactly the mass that leaves: `heitz2016.sample` has the same law. Dielectrics
are in `stratified_interface`.

Source: `crates/specula-bsdf/src/multibounce/stratified_bidirectional.rs`, with its measurements.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from .depth_state import DepthState
from .facets import MAX_BOUNCES, Facets, uniform2

__all__ = ["SPLIT", "eval", "stratum", "survival"]

#: First bounces from each end.
SPLIT = 2
#: Carried energy below which roulette begins; each walk starts with ``1 / SPLIT``.
_CARRIED = 0.5


@syntax
def eval(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f cos``."""
    total, shift, walks = facets.single(wi, wo), uniform2(rng), mi.UInt32(0)
    back = wo.z / wi.z
    while active & (walks < 2 * SPLIT):
        is_back = walks >= SPLIT
        start, end = dr.select(is_back, wo, wi), dr.select(is_back, wi, wo)
        stratum_of = dr.select(is_back, walks - SPLIT, walks)
        value = _walk(facets, start, end, stratum(shift, stratum_of), rng)
        total += value * dr.select(is_back, back, 1)
        walks += 1
    return total


def stratum(shift: Any, k: Any) -> Any:
    """The `k`-th point of a shifted lattice of `SPLIT` points."""
    x, y = (s + mi.Float(k) / SPLIT for s in (shift.x, shift.y))
    return mi.Point2f(dr.select(x >= 1, x - 1, x), dr.select(y >= 1, y - 1, y))


def survival(energy: Any) -> Any:
    """The probability of going on with what a walk can still contribute."""
    return dr.minimum(energy / _CARRIED, 1)


@syntax
def _walk(facets: Facets, start: Any, end: Any, u: Any, rng: Any) -> Any:
    """One walk's estimate of two bounces and more, weighted with the walks from the other end."""
    total, weight = mi.Spectrum(0), mi.Spectrum(1 / SPLIT)
    d, bounces, quotient = -start, mi.UInt32(1), mi.Float(0)
    state, leaving = DepthState(facets.rate(d)), facets.rate(end)
    goes_on = mi.Mask(True)
    while goes_on & (bounces < MAX_BOUNCES):
        facing = facets.facing(d)
        m, fresnel, d = facets.bounce(d, u)
        first = 4 / (facets.ggx.d(m) * facets.facing(-end))
        # 4 R_k without its last D.
        quotient = facing * dr.select(bounces == 1, first, quotient / facets.facing(-d))
        weight *= fresnel
        goes_on &= (d.z > 0) | state.has_room()
        state.fly(facets.rate(d), d.z > 0)
        fresnel, quarter_d = facets.connection(d, end)
        here = quarter_d * state.exit(leaving)
        here /= facets.facing(d) * (1 + quarter_d * quotient)
        total += weight * fresnel * dr.select(goes_on & (quarter_d > 0), here, 0)
        likely = survival(dr.max(weight) * state.mass)
        goes_on &= rng.next_float32() < likely
        weight /= dr.maximum(likely, 1e-30)
        u = uniform2(rng)
        bounces += 1
    return total
