"""The energy that single scattering off GGX loses, tabulated, for Turquin's and Kulla and Conty's
compensation.

    E(wi) = int f cos dwo,  F = 1           directional albedo;  loss = 1 - E

The table holds ``sqrt(1 - E)``, which is smooth where the loss vanishes, over

    alpha       t = sqrt(alpha / (alpha + 2)) / t_max,                   alpha in [0, 4]
    cosine      m = 1 - sqrt(1 - sqrt(mu (1 + alpha) / (mu + alpha)))

(`crates/specula-bsdf/src/energy/coordinates.rs`), bilinearly, by quadrature over the exact
sampler's disk: ``E`` is the mean of its weights. It is made once per process and masking.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from .runtime import dr, is_jit, mi

__all__ = ["Loss", "albedo_quadrature"]

Array = npt.NDArray[np.float64]

_ALPHAS, _COSINES = 64, 64
_MAX_ALPHA = 4.0
_MAX_ROOT = (_MAX_ALPHA / (_MAX_ALPHA + 2)) ** 0.5


def albedo_quadrature(
    alpha: float, cosines: Array, height_correlated: bool, nodes: tuple[int, int] = (12, 24)
) -> Array:
    """Directional albedo of isotropic GGX with F = 1.

    Parameters
    ----------
    alpha : float
        Width.
    cosines : (n,) array
        Cosines of the view, above 0.
    height_correlated : bool
        Smith's masking by height, or else the separable product.
    nodes : (int, int)
        Gauss nodes along the disk's radius, and midpoints of half its circle.

    Returns
    -------
    (n,) array
        In [0, 1].
    """
    x, weight = np.polynomial.legendre.leggauss(nodes[0])
    # Radius sin(pi/2 s): the weight's root at the rim, the horizon, is smooth in s.
    s = 0.25 * np.pi * (x + 1)
    radius, weight = np.sin(s), weight * 0.5 * np.pi * np.sin(s) * np.cos(s)
    angle = (np.arange(nodes[1]) + 0.5) * np.pi / nodes[1]
    disk_x = (radius[:, None] * np.sin(angle - 0.5 * np.pi)).ravel()
    disk_y = (radius[:, None] * np.cos(angle - 0.5 * np.pi)).ravel()
    weights = np.repeat(weight / nodes[1], nodes[1])

    a2 = alpha * alpha
    z = cosines[:, None]
    sine = np.sqrt(np.maximum(1 - z * z, 0))
    q = z * (1 - a2)
    delta = np.sqrt(q * q + 4 * a2)
    big = 0.5 * (np.abs(q) + delta)
    eigen = np.where(q >= 0, big, a2 / big)
    kappa = np.where(q >= 0, a2 / big, big)
    tilt = z * a2
    b = eigen + tilt
    length = np.sqrt(a2 * sine * sine + z * z)
    y2 = disk_y * disk_y
    middle = np.sqrt((1 - y2) * kappa * b + y2 * tilt * delta)
    on_t = np.sqrt(eigen * b) / b * disk_y
    on_k = (eigen * np.sqrt(eigen * b) * b * disk_x + alpha * sine * kappa * middle) / (
        delta * b * length
    )
    height = np.sqrt(np.maximum(1 - on_t**2 - on_k**2, 0))
    radial = alpha * (height * alpha * sine - z * on_k) / length
    up = (height * z + alpha * sine * on_k) / length
    scale = 2 * (sine * radial + z * up) / (radial**2 + (alpha * on_t) ** 2 + up**2)
    out = np.maximum(scale * up - z, 0)
    out_length = np.sqrt(a2 * np.maximum(1 - out * out, 0) + out * out)
    if height_correlated:
        ratio = 2 * out / (z * out_length + out * length)
    else:
        ratio = 4 * out / ((z + length) * (out + out_length))
    albedo: Array = (ratio * (eigen * eigen / delta)) @ weights
    return np.clip(albedo, 0, 1)


@lru_cache(maxsize=2)
def _tables(height_correlated: bool) -> tuple[npt.NDArray[np.float32], npt.NDArray[np.float32]]:
    """``sqrt(1 - E)``, (alphas, cosines), and ``sqrt(1 - E_avg)``, (alphas,)."""
    roots = np.linspace(0, 1, _ALPHAS) * _MAX_ROOT
    alphas = np.maximum(2 * roots**2 / (1 - roots**2), 1e-5)
    x, weight = np.polynomial.legendre.leggauss(24)
    mu, weight = 0.5 * (x + 1), 0.5 * weight
    m = np.linspace(0, 1, _COSINES)
    share = (1 - (1 - m) ** 2) ** 2
    table, average = np.zeros((_ALPHAS, _COSINES)), np.zeros(_ALPHAS)
    for i, alpha in enumerate(alphas):
        cosines = np.maximum(share * alpha / (1 + alpha - share), 1e-6)
        table[i] = np.sqrt(1 - albedo_quadrature(alpha, cosines, height_correlated))
        lost = 1 - albedo_quadrature(alpha, mu, height_correlated)
        average[i] = np.sqrt(2 * np.sum(weight * mu * lost))
    return table.astype(np.float32), average.astype(np.float32)


class Loss:
    """``1 - E`` and ``1 - E_avg`` of GGX in the active variant.

    Parameters
    ----------
    height_correlated : bool
        Which masking.

    Notes
    -----
    Equal alphas are exact to 4e-4. Unequal ones are looked up at their root mean square, for all
    azimuths: off by 0.024 (root mean square) and at most by 0.10 where they differ up to 8 times
    and are at most 1.2; their geometric mean would be off by 0.07 and 0.29.
    """

    def __init__(self, height_correlated: bool) -> None:
        table, average = _tables(height_correlated)
        self._table, self._average = table.ravel(), average
        if is_jit():
            self._table, self._average = mi.Float(self._table), mi.Float(average)

    def directional(self, facets: Any, w: Any) -> Any:
        """``1 - E(w)``, in [0, 1]; `facets` a `ggx.Ggx`, ``w.z > 0``."""
        alpha = _effective(facets)
        mu = dr.clip(w.z, 0, 1)
        share = dr.sqrt(dr.maximum(mu * (1 + alpha) / (mu + alpha), 1e-12))
        m = 1 - dr.sqrt(dr.maximum(1 - share, 1e-12))
        row, t = _cell(_alpha_coordinate(alpha), _ALPHAS)
        column, s = _cell(m, _COSINES)
        at = row * _COSINES + column
        near = dr.lerp(_fetch(self._table, at), _fetch(self._table, at + 1), s)
        far = dr.lerp(
            _fetch(self._table, at + _COSINES), _fetch(self._table, at + _COSINES + 1), s
        )
        return dr.clip(dr.square(dr.lerp(near, far, t)), 0, 1)

    def average(self, facets: Any) -> Any:
        """``1 - E_avg``, above 0."""
        row, t = _cell(_alpha_coordinate(_effective(facets)), _ALPHAS)
        root = dr.lerp(_fetch(self._average, row), _fetch(self._average, row + 1), t)
        return dr.maximum(dr.square(root), 1e-9)


def _effective(facets: Any) -> Any:
    """The alpha whose isotropic loss stands for that of unequal alphas."""
    if facets.isotropic:
        return facets.alpha_u
    return dr.sqrt(0.5 * (dr.square(facets.alpha_u) + dr.square(facets.alpha_v)))


def _alpha_coordinate(alpha: Any) -> Any:
    return dr.sqrt(alpha / (alpha + 2)) * (1 / _MAX_ROOT)


def _cell(coordinate: Any, count: int) -> tuple[Any, Any]:
    """Index of the cell of a coordinate in [0, 1], and the place inside it."""
    x = dr.clip(coordinate, 0, 1) * (count - 1)
    index = mi.UInt32(dr.minimum(dr.detach(x), count - 2))
    return index, x - mi.Float(index)


def _fetch(table: Any, index: Any) -> Any:
    return dr.gather(mi.Float, table, index) if is_jit() else float(table[int(index)])
