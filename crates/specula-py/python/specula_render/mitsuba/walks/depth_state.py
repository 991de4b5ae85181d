"""How deep a walk is, given its directions alone: a mixture of sums of exponential layers.

With ``l = |Lambda(d)|`` the rates of the flights (`facets.Facets.rate`), the depth of a collision
is ``sum_j c_j Hypoexponential(l_j, .., l_N)``, all ``c_j >= 0``, of mass ``sum_j c_j`` not yet left:

    down (rate l)   one more layer below:  append l with c = 0
    up (rate L)     r = (c_j + carry) / (L + l_j),  c_j = L r,  carry = l_j r,  j = 1..N
                    the last carry is the mass that leaves
    exit (rate L)   that mass alone:  s = (s + c_j) l_j / (l_j + L)

``exit`` is ``sum_j a_j / (b_j + L)`` of Bitterli and d'Eon 2022, and ``S_k`` of Cui et al. 2023,
eq. 14, times the product of the rates. Nothing cancels, so single precision serves where their
forms have differences of rates.

Source: `crates/specula-bsdf/src/multibounce/state.rs`, with its derivation.
"""

from __future__ import annotations

from typing import Any

from ..runtime import dr, mi

__all__ = ["DepthState"]

#: Layers that a state holds unless told otherwise: one for each downward flight. Enough to alpha 5.
_LAYERS = 16


class DepthState:
    """The mixture; begins with one layer, ``Exp(rate)``, of mass 1.

    Parameters
    ----------
    rate : Float
        Of the flight that enters.
    room : int
        Layers that the state can hold.

    Attributes
    ----------
    mass : Float
        What has not left.

    Notes
    -----
    Layers lie at the end of the lists: those before them have mass 0, and change nothing.
    """

    DRJIT_STRUCT = {"rates": list, "masses": list, "layers": object, "mass": object}

    def __init__(self, rate: Any = None, room: int = _LAYERS) -> None:
        if rate is None:  # Dr.Jit copies by making an empty object.
            return
        self.rates = [mi.Float(1)] * (room - 1) + [mi.Float(rate)]
        self.masses = [mi.Float(0)] * (room - 1) + [mi.Float(1)]
        self.layers, self.mass = mi.UInt32(1), mi.Float(1)

    def has_room(self) -> Any:
        """Whether one more layer can be held."""
        return self.layers < len(self.rates)

    def fly(self, rate: Any, is_up: Any) -> Any:
        """Fly on to the next collision, down only where `has_room`; the mass that leaves."""
        carry, mass = mi.Float(0), mi.Float(0)
        risen = []
        for layer, held in zip(self.rates, self.masses, strict=True):
            share = (held + carry) / (rate + layer)
            risen.append(rate * share)
            mass += rate * share
            carry = layer * share
        sunk = [*self.masses[1:], mi.Float(0)], [*self.rates[1:], rate]
        self.masses = [dr.select(is_up, a, b) for a, b in zip(risen, sunk[0], strict=True)]
        self.rates = [dr.select(is_up, a, b) for a, b in zip(self.rates, sunk[1], strict=True)]
        self.layers += dr.select(is_up, mi.UInt32(0), mi.UInt32(1))
        self.mass = dr.select(is_up, mass, self.mass)
        return dr.select(is_up, carry, 0)

    def exit(self, rate: Any) -> Any:
        """The mass that an upward flight would lead out."""
        leaving = mi.Float(0)
        for layer, held in zip(self.rates, self.masses, strict=True):
            leaving = (leaving + held) * (layer / (layer + rate))
        return leaving

    def sample(self, rng: Any) -> Any:
        """A depth of the mixture, its mass taken as 1."""
        left, depth = rng.next_float32() * self.mass, mi.Float(0)
        is_inside = mi.Mask(False)
        for k, (layer, held) in enumerate(zip(self.rates, self.masses, strict=True)):
            left -= held
            is_inside |= (left < 0) | (k + 1 == len(self.rates))
            step = -dr.log(dr.maximum(1 - rng.next_float32(), 1e-12)) / layer
            depth += dr.select(is_inside, step, 0)
        return depth
