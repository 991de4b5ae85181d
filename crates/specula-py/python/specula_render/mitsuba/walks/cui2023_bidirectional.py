"""Cui et al. 2023, *Multiple-bounce Smith Microfacet BRDFs using the Invariance Principle*: the
bidirectional estimator.

Flights ``e_0 .. e_s`` of a walk from `wi` and ``r_t .. r_0`` of one from `wo` meet at one facet: a
path of ``s + t + 1`` bounces. All pairs contribute, with the balance heuristic over all ways of
splitting a path. Moving the connection from the facet ``h_i`` to ``h_(i+1)`` multiplies the density
by

    D(h_i) / sigma(-d_i)  sigma(d_(i+2)) / D(h_(i+1))

Departures: those of `cui2023`; one bounce is in closed form; no pair is dropped and no cosine
clamped, as the released code does. Subpaths hold 10 flights, the library's 12.

Source: `crates/specula-bsdf/src/multibounce/cui2023.rs`.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from .cui2023 import GOES_ON, SURE
from .depth_state import DepthState
from .facets import Facets, uniform2

__all__ = ["eval"]

#: Flights that a subpath can hold; each end covers for the other.
_MOST = 10


class _Subpath:
    """Flights of one end's walk, with the products of their weights and the facets' ``D / 4``.

    Lists of arrays, read by selecting: Dr.Jit (1.5) has no local memory in a BSDF's functions.
    """

    DRJIT_STRUCT = {"d": list, "weight": list, "quarter_d": list, "length": object}

    def __init__(self, start: Any = None) -> None:
        if start is None:  # Dr.Jit copies by making an empty object.
            return
        self.d = [start] * _MOST
        self.weight = [mi.Spectrum(1)] * _MOST
        self.quarter_d = [mi.Float(1)] * _MOST
        self.length = mi.UInt32(1)

    @syntax
    def walk(self, facets: Facets, rng: Any, active: Any) -> None:
        """Sample the flights after the first."""
        d, weight, goes_on = mi.Vector3f(self.d[0]), mi.Spectrum(1), mi.Mask(active)
        while goes_on & (self.length < _MOST):
            is_sure = self.length <= SURE
            goes_on &= is_sure | (rng.next_float32() < GOES_ON)
            m, fresnel, d = facets.bounce(d, uniform2(rng))
            weight = weight * fresnel * dr.select(is_sure, 1, 1 / GOES_ON)
            self._append(d, weight, 0.25 * facets.ggx.d(m), goes_on)

    def _append(self, d: Any, weight: Any, quarter_d: Any, active: Any) -> None:
        for row, value in ((self.d, d), (self.weight, weight), (self.quarter_d, quarter_d)):
            for k in range(1, _MOST):
                row[k] = dr.select(active & (self.length == k), value, row[k])
        self.length += dr.select(active, mi.UInt32(1), mi.UInt32(0))


def _at(row: list[Any], index: Any) -> Any:
    """The value at an index of its own in each element."""
    found = row[0]
    for k in range(1, _MOST):
        found = dr.select(index == k, row[k], found)
    return found


@syntax
def eval(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f cos``."""
    total = facets.single(wi, wo)
    eye, light = _Subpath(-wi), _Subpath(-wo)
    eye.walk(facets, rng, active)
    light.walk(facets, rng, active)
    s, t = mi.UInt32(0), mi.UInt32(1)
    while active & (s < eye.length):
        fresnel, quarter_d = facets.connection(_at(eye.d, s), -_at(light.d, t))
        connects = quarter_d > 0
        rivals = 1 + _moved(facets, eye, light, s, t, quarter_d, connects)
        rivals += _moved(facets, light, eye, t, s, quarter_d, connects)
        density = quarter_d * _path_over_density(facets, eye, light, s, t, connects) / rivals
        total += _at(eye.weight, s) * _at(light.weight, t) * fresnel * dr.select(connects, density, 0)
        t += 1
        is_last = t >= light.length
        s += dr.select(is_last, mi.UInt32(1), mi.UInt32(0))
        t = dr.select(is_last, mi.UInt32(0), t)
    return total


@syntax
def _path_over_density(
    facets: Facets, eye: _Subpath, light: _Subpath, s: Any, t: Any, active: Any
) -> Any:
    """``prod D / (4 |d.z|) S`` over the density of both subpaths, without the connection's D / 4."""
    state = DepthState(facets.rate(eye.d[0]))
    i, has_room = mi.UInt32(1), mi.Mask(active)
    # The state holds the rates of all flights but the last: sigma(-d) of the facets' own densities
    # cancels in each, and the walk from `wo` was sampled by sigma(d).
    factor = dr.rcp(facets.facing(_at(eye.d, s)))
    while has_room & (i <= s + t):
        is_eye = i <= s
        there = dr.select(is_eye, mi.UInt32(0), s + t + 1 - i)
        d = dr.select(is_eye, _at(eye.d, i), -_at(light.d, there))
        has_room &= (d.z > 0) | state.has_room()
        state.fly(facets.rate(d), d.z > 0)
        before = _at(light.d, there - 1)
        factor *= dr.select(is_eye, 1, facets.facing(before) / facets.facing(d))
        i += 1
    return dr.select(has_room, state.exit(facets.rate(-light.d[0])) * factor, 0)


@syntax
def _moved(
    facets: Facets, near: _Subpath, far: _Subpath, s: Any, t: Any, here: Any, active: Any
) -> Any:
    """Densities of the path split nearer to the end of `far`, over that of this split; their sum.

    `here` is ``D / 4`` of the facet where flight `s` of `near` meets flight `t` of `far`.
    """
    j, quotient, total = mi.UInt32(t), mi.Float(1), mi.Float(0)
    facing = facets.facing(_at(near.d, s))
    while active & (j > 0):
        quarter_d = _at(far.quarter_d, j)
        quotient *= here / facing * facets.facing(_at(far.d, j - 1)) / quarter_d
        # An infinite quotient times a probability of 0 would be no number.
        quotient = dr.minimum(quotient, 1e30) * _goes_on(s + t - j + 1) / _goes_on(j)
        total += quotient
        here, facing = quarter_d, facets.facing(-_at(far.d, j))
        j -= 1
    return total


def _goes_on(bounce: Any) -> Any:
    """Probability that a subpath makes this bounce once it has come so far."""
    return dr.select(bounce <= SURE, 1.0, dr.select(bounce < _MOST, GOES_ON, 0.0))
