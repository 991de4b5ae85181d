"""Half vectors of visible GGX normals by caps, bounded caps, and the hemisphere's section.

``wi`` is the view, ``u`` uniform in [0, 1)^2; half vectors come in any length. The exact sampler is
in `exact`.
"""

from __future__ import annotations

from typing import Any

from .runtime import dr, mi

__all__ = ["bounded_half_vector", "bounded_norm", "cap_half_vector", "heitz_half_vector"]


def _stretched(alpha_u: Any, alpha_v: Any, w: Any) -> tuple[Any, Any]:
    """The unit stretched direction, and ``1 + z`` of it, which cancels in neither hemisphere."""
    x, y = alpha_u * w.x, alpha_v * w.y
    radius2 = dr.square(x) + dr.square(y)
    length = dr.sqrt(dr.maximum(radius2 + dr.square(w.z), 1e-30))
    inverse = dr.rcp(length)
    long = length + dr.abs(w.z)
    one_plus_z = dr.select(w.z > 0, long, radius2 * dr.rcp(long)) * inverse
    return mi.Vector3f(x * inverse, y * inverse, w.z * inverse), one_plus_z


def _on_cap(alpha_u: Any, alpha_v: Any, i: Any, one_plus_z: Any, v: Any, turns: Any) -> Any:
    """In the surface's space: the half vector of `i` and the sphere's point `v` below the top."""
    sine = dr.sqrt(dr.maximum(v * (2 - v), 0))
    s, c = dr.sincos(dr.two_pi * turns)
    x, y = dr.fma(sine, c, i.x), dr.fma(sine, s, i.y)
    return mi.Vector3f(alpha_u * x, alpha_v * y, one_plus_z - v)


def cap_half_vector(alpha_u: Any, alpha_v: Any, wi: Any, u: Any) -> Any:
    """Visible normals by spherical caps (Dupuy and Benyoub 2023), of any hemisphere's view.

    Departure from the listing: with ``t = 1 + i.z`` and ``v = u t``, ``sin = sqrt(v (2 - v))`` and
    ``h.z = t - v`` cancel nowhere.
    """
    i, one_plus_z = _stretched(alpha_u, alpha_v, wi)
    return _on_cap(alpha_u, alpha_v, i, one_plus_z, u.x * one_plus_z, u.y)


def _bound(alpha_u: Any, alpha_v: Any, wi: Any) -> Any:
    """``k`` of the cap ``z > -k i.z``.

    Source: Tokuyoshi and Eto 2024, eqs. 6 and 7. Departure: alphas above 1 are not clamped, and
    ``s = 1 + sgn(1 - a) sqrt(x^2 + y^2)`` keeps the bound conservative there.
    """
    a = dr.minimum(alpha_u, alpha_v)
    sine = dr.sqrt(dr.maximum(dr.square(wi.x) + dr.square(wi.y), 1e-30))
    a2 = dr.square(a)
    s2 = dr.square(1 + dr.select(a <= 1, sine, -sine))
    return (1 - a2) * s2 / dr.maximum(s2 + a2 * dr.square(wi.z), 1e-24)


def bounded_norm(alpha_u: Any, alpha_v: Any, wi: Any) -> Any:
    """``N = (k z + |(alpha_u x, alpha_v y, z)|) / 2``; Tokuyoshi and Eto 2024, eq. 10."""
    radius2 = dr.square(alpha_u * wi.x) + dr.square(alpha_v * wi.y)
    length = dr.sqrt(radius2 + dr.square(wi.z))
    return 0.5 * dr.fma(_bound(alpha_u, alpha_v, wi), wi.z, length)


def bounded_half_vector(alpha_u: Any, alpha_v: Any, wi: Any, u: Any) -> Any:
    """Reflections by bounded spherical caps (Tokuyoshi and Eto 2024); ``wi.z > 0``."""
    i, one_plus_z = _stretched(alpha_u, alpha_v, wi)
    height = dr.fma(_bound(alpha_u, alpha_v, wi), i.z, 1)
    return _on_cap(alpha_u, alpha_v, i, one_plus_z, u.x * height, u.y)


def heitz_half_vector(alpha_u: Any, alpha_v: Any, wi: Any, u: Any) -> Any:
    """Visible normals by the hemisphere's cross section (Heitz 2018)."""
    i, one_plus_z = _stretched(alpha_u, alpha_v, wi)
    sine2 = dr.square(i.x) + dr.square(i.y)
    tilted = sine2 > 1e-24
    inverse = dr.rsqrt(dr.maximum(sine2, 1e-24))
    axis = mi.Vector3f(
        dr.select(tilted, -i.y * inverse, 1), dr.select(tilted, i.x * inverse, 0), 0
    )
    s, c = dr.sincos(dr.two_pi * u.y)
    r = dr.sqrt(u.x)
    t1 = r * c
    chord = dr.sqrt(dr.maximum(1 - dr.square(t1), 0))
    d = 0.5 * one_plus_z * (chord - r * s)
    t3 = dr.sqrt(dr.maximum(d * (2 * chord - d), 0))
    m = axis * t1 + dr.cross(i, axis) * (chord - d) + i * t3
    return mi.Vector3f(alpha_u * m.x, alpha_v * m.y, m.z)
