"""Exactly the reflections off visible GGX normals that lie above the surface: none is rejected.

The half vectors ``m`` of such reflections form a cone over an ellipse. With ``i`` the view,
``h = (alpha_u i.x, alpha_v i.y, i.z)`` and ``Dj = lambda + i.z alpha_j^2``,

    lambda = i.z + hx^2/Dx + hy^2/Dy                   the cone's eigenvalue
    v = (hx/Dx, hy/Dy, 1)                              its axis
    N = lambda^2 / (|v|^2 sqrt(Dx Dy))                 pdf = D(m) / (4 N)

Source: Specula, ``docs/exact-reflection-sampling.md``, whose notation the code keeps. Equal alphas
have a map in closed form; unequal ones walk along the chords of the cone's projection.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .runtime import dr, mi

__all__ = ["half_vector", "norm"]

#: The rim of the disk is the horizon, below which rounding would leave some reflections.
_RIM = 1 - 2e-6


def norm(alpha_u: Any, alpha_v: Any, isotropic: bool, wi: Any) -> Any:
    """``N`` of ``pdf = D(m) / (4 N)``; ``wi.z > 0``."""
    if isotropic:
        delta, eigenvalue, _ = _roots(alpha_u, wi.z)
        return dr.square(eigenvalue) / delta
    return _Cone.of(alpha_u, alpha_v, wi).norm()


def half_vector(alpha_u: Any, alpha_v: Any, isotropic: bool, wi: Any, u: Any) -> Any:
    """A half vector of any length; ``wi.z > 0``, `u` a point of the disk (radius^2, turns)."""
    s, c = dr.sincos(dr.two_pi * u.y)
    radius = dr.sqrt(dr.minimum(u.x, _RIM))
    x, y = radius * c, radius * s
    if isotropic:
        return _isotropic(alpha_u, wi, x, y)
    m = _chords(_Cone.of(alpha_u, alpha_v, wi), x, y)
    return mi.Vector3f(alpha_u * m.x, alpha_v * m.y, m.z)


def _roots(a: Any, z: Any) -> tuple[Any, Any, Any]:
    """``(Delta, lambda, kappa)`` of equal alphas."""
    p = dr.square(a)
    q = z * (1 - p)
    delta = dr.sqrt(dr.square(q) + 4 * p)
    big = 0.5 * (dr.abs(q) + delta)
    small = p / big
    narrow = q >= 0
    return delta, dr.select(narrow, big, small), dr.select(narrow, small, big)


def _isotropic(a: Any, wi: Any, disk_x: Any, disk_y: Any) -> Any:
    """Equal alphas: scales, and a shift along the chords, of a point of the disk."""
    z = wi.z
    delta, eigenvalue, kappa = _roots(a, z)
    tilt = z * dr.square(a)
    b = eigenvalue + tilt
    scale = dr.rcp(delta * b)
    root = dr.sqrt(eigenvalue * b)

    # The plane of incidence, defined at the normal too.
    sine2 = dr.square(wi.x) + dr.square(wi.y)
    tilted = sine2 > 1e-24
    sine = dr.sqrt(dr.maximum(sine2, 1e-24))
    x, y = dr.select(tilted, wi.x / sine, 1), dr.select(tilted, wi.y / sine, 0)
    r = a * sine
    per_length = dr.rsqrt(dr.square(r) + dr.square(z))

    y2 = dr.square(disk_y)
    middle = dr.sqrt(dr.maximum((1 - y2) * kappa * b + y2 * tilt * delta, 0))
    on_t = root * scale * delta * disk_y
    on_k = per_length * scale * (eigenvalue * root * b * disk_x + r * kappa * middle)
    height = dr.sqrt(dr.maximum(1 - dr.square(on_t) - dr.square(on_k), 0))

    radial = per_length * (height * r - z * on_k)
    up = per_length * (height * z + r * on_k)
    return mi.Vector3f(a * (radial * x - on_t * y), a * (radial * y + on_t * x), up)


@dataclass(frozen=True)
class _Cone:
    """The valid half vectors of one view, in the space of unit roughness."""

    h: Any
    tilt: tuple[Any, Any]
    eigenvalue: Any
    inverse_d: tuple[Any, Any]
    v: tuple[Any, Any]
    v2: Any

    @staticmethod
    def of(alpha_u: Any, alpha_v: Any, wi: Any) -> _Cone:
        """The cone of `wi`, ``wi.z > 0``; the eigenvalue by three steps (relative error 1e-7)."""
        hx, hy, z = alpha_u * wi.x, alpha_v * wi.y, wi.z
        # Never along the normal, so that the plane of incidence is defined.
        hx = dr.select(dr.square(hx) + dr.square(hy) > 1e-18, hx, 1e-9)
        tilt = (z * dr.square(alpha_u), z * dr.square(alpha_v))
        p = (dr.square(hx), dr.square(hy))
        near = _root(p, z, tilt, dr.sqrt(p[0] + p[1] + dr.square(z)))

        # Newton's step, with the reciprocals carried along to first order.
        x, y = dr.rcp(near + tilt[0]), dr.rcp(near + tilt[1])
        px, py = p[0] * x, p[1] * y
        step = (z + px + py - near) / (1 + px * x + py * y)
        inverse_d = (x - step * x * x, y - step * y * y)
        v = (hx * inverse_d[0], hy * inverse_d[1])
        v2 = 1 + dr.square(v[0]) + dr.square(v[1])
        return _Cone(mi.Vector3f(hx, hy, z), tilt, near + step, inverse_d, v, v2)

    def norm(self) -> Any:
        """``lambda^2 / (|v|^2 sqrt(Dx Dy))``."""
        area = dr.sqrt(self.inverse_d[0] * self.inverse_d[1])
        return dr.square(self.eigenvalue) * area / self.v2


def _root(p: tuple[Any, Any], z: Any, tilt: tuple[Any, Any], guess: Any) -> Any:
    """Near the positive root of ``l = z + p[0] / (l + tilt[0]) + p[1] / (l + tilt[1])``.

    One pole with the value and slope of the two (a quadratic equation), then Halley's step.
    """
    x, y = guess + tilt[0], guess + tilt[1]
    value = p[0] * y + p[1] * x
    quotient = value / (p[0] * y * y + p[1] * x * x)
    d = quotient * x * y - guess
    half = 0.5 * (z - d)
    near = half + dr.sqrt(dr.square(half) + z * d + quotient * value)

    x, y = near + tilt[0], near + tilt[1]
    product = x * y
    f = (near - z) * product - p[0] * y - p[1] * x
    px, py = p[0] * y * y, p[1] * x * x
    slope = dr.square(product) + px + py
    bend = px * y + py * x
    return near - f * slope * product / (dr.square(slope) + f * bend)


def _chords(cone: _Cone, disk_x: Any, disk_y: Any) -> Any:
    """Unequal alphas: a walk along the chord of a point of the disk, or its opposite chord."""
    h, tilt, v, inverse_d = cone.h, cone.tilt, cone.v, cone.inverse_d
    h2 = dr.squared_norm(h)

    # k = h x v and t = k x h, free of cancellation.
    rise = h.x * v[0] + h.y * v[1]
    k = mi.Vector3f(
        v[1] * (rise + tilt[1]), -v[0] * (rise + tilt[0]), v[0] * v[1] * (tilt[0] - tilt[1])
    )
    t = dr.cross(k, h)
    k2 = dr.squared_norm(k)

    # Conjugate half axes of the ellipse: across and along the chords.
    gx, gy = k.x * inverse_d[0], k.y * inverse_d[1]
    g = k.x * gx + k.y * gy
    axis = dr.sqrt(cone.eigenvalue / g)
    thin = axis * dr.sqrt(inverse_d[0] * inverse_d[1])
    across, along = (axis * gx, axis * gy), (k.y * thin, -k.x * thin)
    c = dr.sqrt(dr.maximum(1 - dr.square(disk_y), 0))

    # Ends of the chord along t, in units of |k| |h|.
    lever = k2 / cone.v2
    curve = cone.v2 / cone.eigenvalue

    def slide(w: tuple[Any, Any]) -> Any:
        return t.x * w[0] + t.y * w[1] - (v[0] * w[0] + v[1] * w[1]) * lever

    def lift(w: tuple[Any, Any]) -> Any:
        curved = tilt[0] * dr.square(w[0]) + tilt[1] * dr.square(w[1])
        return dr.sqrt(dr.square(v[0] * w[0] + v[1] * w[1]) + curve * curved) * lever

    s1, s2 = slide(across), slide(along)
    centre = (disk_y * across[0], disk_y * across[1])
    reach = (c * along[0], c * along[1])
    far = lift((centre[0] + reach[0], centre[1] + reach[1]))
    near = lift((centre[0] - reach[0], centre[1] - reach[1]))

    # The opposite chord ends at the mirror image of this one's start, lifted as that is.
    walked = disk_x * s2 + near
    sign = dr.select(walked - c * s2 > far, -1.0, 1.0)
    on_t = (sign * disk_y * s1 + walked) / k2
    on_k = sign * disk_y * axis * g / k2
    height = dr.sqrt(dr.maximum(1 - dr.square(on_k) * k2 - dr.square(on_t) * (k2 / h2), 0))
    return k * on_k + t * (on_t / h2) + h * (height * dr.rsqrt(h2))
