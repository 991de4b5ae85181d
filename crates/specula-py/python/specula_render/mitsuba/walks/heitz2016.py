"""Heitz, Hanika, d'Eon and Dachsbacher 2016: a random walk over directions and heights.

    down   tau += E / |Lambda(d)|,  E = -ln U
    up     tau -= E / Lambda(d),    below 0 the ray has left
    connect  F D(h) / (4 sigma(-d)) exp(-tau Lambda(wo))      at every facet

in the depth ``tau = -ln C1(h)``, so that no height is needed (Section 4 of the paper has them).

Dielectric facets reflect, or refract into the other side (`interface`).

Departure: one bounce off metal is in closed form, as in the library. Limitation, the model's: the variance of
a connection diverges, as a logarithm, for `wo` along the normal.

Source: `crates/specula-bsdf/src/multibounce/heitz2016.rs`.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi, syntax
from . import interface
from .facets import MAX_BOUNCES, Facets, advance, uniform2

__all__ = ["collisions", "eval", "eval_interface", "sample", "sample_interface"]


@syntax
def eval(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f cos``."""
    total, weight = facets.single(wi, wo), mi.Spectrum(1)
    d, bounces = -wi, mi.UInt32(1)
    tau = advance(facets, d, mi.Float(0), rng)
    leaving = facets.rate(wo)
    while active & (tau >= 0) & (bounces < MAX_BOUNCES):
        _, fresnel, d = facets.bounce(d, uniform2(rng))
        tau = advance(facets, d, tau, rng)
        weight *= fresnel
        fresnel, quarter_d = facets.connection(d, wo)
        leaves = dr.select(tau >= 0, dr.exp(-tau * leaving), 0)
        total += weight * fresnel * (quarter_d / facets.facing(d) * leaves)
        bounces += 1
    return total


@syntax
def sample(facets: Facets, wi: Any, u: Any, rng: Any, active: Any) -> tuple[Any, Any]:
    """Where a walk leaves, and the product of its facets' reflectances."""
    d, weight, bounces = -wi, mi.Spectrum(1), mi.UInt32(0)
    tau = advance(facets, d, mi.Float(0), rng)
    while active & (tau >= 0) & (bounces < MAX_BOUNCES):
        _, fresnel, d = facets.bounce(d, u)
        tau = advance(facets, d, tau, rng)
        weight *= fresnel
        u = uniform2(rng)
        bounces += 1
    return d, dr.select(tau < 0, weight, 0)


def eval_interface(facets: Facets, eta: Any, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """An estimate of ``f |cos|`` of a dielectric, as importance; `wi` above the horizon."""
    tau = advance(facets, -wi, mi.Float(0), rng)
    return collisions(facets, -wi, tau, eta, wo, rng, active)


@syntax
def collisions(
    facets: Facets, d: Any, tau: Any, eta: Any, wo: Any, rng: Any, active: Any
) -> Any:
    """The estimate of all light that leaves along `wo` from the collision of `d` at `tau` on.

    Directions are in the frame of the side of `d`.
    """
    d, tau, eta, wo = mi.Vector3f(d), mi.Float(tau), mi.Float(eta), mi.Vector3f(wo)
    total, bounces = mi.Float(0), mi.UInt32(0)
    while active & (tau >= 0) & (bounces < MAX_BOUNCES):
        total += interface.connection(facets, d, tau, eta, wo)
        d, crosses = interface.bounce(facets, d, eta, rng.next_float32(), uniform2(rng))
        tau = advance(facets, d, dr.select(crosses, interface.depth_beyond(tau), tau), rng)
        eta = dr.select(crosses, dr.rcp(eta), eta)
        wo.z = dr.select(crosses, -wo.z, wo.z)
        bounces += 1
    return total


@syntax
def sample_interface(
    facets: Facets, eta: Any, wi: Any, u: Any, u2: Any, rng: Any, active: Any
) -> tuple[Any, Any]:
    """Where a walk leaves a dielectric, in the frame of `wi`, and whether it does.

    `u` and `u2` take the first facet. Nothing is lost: the weight, as importance, is 1.
    """
    d, eta, bounces, is_beyond = -wi, mi.Float(eta), mi.UInt32(0), mi.Mask(False)
    tau = advance(facets, d, mi.Float(0), rng)
    while active & (tau >= 0) & (bounces < MAX_BOUNCES):
        d, crosses = interface.bounce(facets, d, eta, u, u2)
        tau = advance(facets, d, dr.select(crosses, interface.depth_beyond(tau), tau), rng)
        eta = dr.select(crosses, dr.rcp(eta), eta)
        is_beyond ^= crosses
        u = rng.next_float32()
        u2 = uniform2(rng)
        bounces += 1
    return dr.select(is_beyond, interface.turned(d), d), tau < 0
