"""The energy that single scattering loses, for Turquin's and Kulla and Conty's compensation.

    E(wi) = int f cos dwo,  F = 1           directional albedo;  L = 1 - E
    L_avg = 2 int L(mu) mu dmu

Tables hold ``sqrt(1 - E)``, which is smooth where the loss vanishes, as coefficients of splines.
They are those of the library (`crates/specula-bsdf/src/energy`): GGX and Beckmann, both maskings,
unequal alphas by azimuth, interfaces by index.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any, TypeVar
from weakref import WeakValueDictionary

import numpy as np
import numpy.typing as npt

from specula_render import _native

from .runtime import dr, is_jit, mi
from .splines import Rows, Spline, pair, spline

__all__ = ["DielectricLoss", "Loss"]

_ALPHAS, _COSINES = 48, 40
_PAIRED_ALPHAS, _AZIMUTHS, _PAIRED_COSINES = 24, 12, 22
_ETAS, _INTERFACE_ALPHAS, _INTERFACE_COSINES = 20, 20, 22
_INTERFACE_PAIRED = {"etas": 12, "alphas": 12, "azimuths": 10, "cosines": 14}
_LEAST_ROOT, _MOST_ROOT = (1e-4 / 2.0001) ** 0.5, (10 / 12) ** 0.5
_LEAST_ETA_ROOT, _MOST_ETA_ROOT = 0.02**0.5, 0.5**0.5


T = TypeVar("T")
#: Tables of the active variants, for as long as a plugin holds them.
_SHARED: WeakValueDictionary[tuple[Any, ...], Any] = WeakValueDictionary()


def _shared(make: Callable[[], T], *key: Any) -> T:
    """A table that all plugins of a variant share, by what tells it from others."""
    found: T | None = _SHARED.get((mi.variant(), *key))
    if found is None:
        found = _SHARED[(mi.variant(), *key)] = make()
    return found


@lru_cache(maxsize=4)
def _tables(distribution: str, masking: str) -> dict[str, npt.NDArray[np.float32]]:
    return _native.energy_tables(distribution, masking)


def _named(distribution: str, height_correlated: bool) -> dict[str, npt.NDArray[np.float32]]:
    return _tables(distribution, "height-correlated" if height_correlated else "separable")


class _Numbers:
    """A table of numbers in the active variant."""

    def __init__(self, values: npt.NDArray[np.float32]) -> None:
        self._values: Any = mi.Float(values) if is_jit() else values

    def __call__(self, index: Any) -> Any:
        if is_jit():
            return dr.gather(mi.Float, self._values, index)
        return float(self._values[int(index)])


class Loss:
    """``1 - E`` and ``1 - E_avg`` of facets that reflect everything.

    Parameters
    ----------
    distribution : str
        ``ggx`` or ``beckmann``.
    height_correlated : bool
        Smith's masking by height, or else the separable product.
    isotropic : bool
        Whether both alphas are the same parameter.

    Notes
    -----
    Largest errors of ``E``: 9e-5 with equal alphas up to 2; 5e-4 with others in [0.02, 2].
    """

    def __init__(self, distribution: str, height_correlated: bool, isotropic: bool) -> None:
        tables = _named(distribution, height_correlated)
        self._isotropic = isotropic
        name, count = ("isotropic", _COSINES) if isotropic else ("anisotropic", _PAIRED_COSINES)
        key = distribution, height_correlated, name
        self._rows = _shared(lambda: Rows(tables[name], count), *key)
        self._average = _shared(lambda: _Numbers(tables[f"{name}_average"]), *key, "average")

    def directional(self, facets: Any, w: Any) -> Any:
        """``1 - E(w)``, in [0, 1]; `facets` a `ggx.Ggx` or `beckmann.Beckmann`, ``w.z > 0``."""
        mu = dr.clip(w.z, 0, 1)
        if self._isotropic:
            value = self._rows.at(_cosine_coordinate(mu, facets.alpha_u))
            root = spline(_alpha_coordinate(facets.alpha_u), _ALPHAS).sum(value)
        else:
            low, high = _ordered(facets)
            azimuth = _Azimuth(facets, w)
            value = self._rows.at(_cosine_coordinate(mu, azimuth.alpha))
            narrow, wide = (spline(_alpha_coordinate(a), _PAIRED_ALPHAS) for a in (low, high))
            place = spline(azimuth.v, _AZIMUTHS)
            root = _over_pairs(narrow, wide, place, _AZIMUTHS, value)
        return dr.clip(dr.square(root), 0, 1)

    def average(self, facets: Any) -> Any:
        """``1 - E_avg``, in (0, 1]."""
        if self._isotropic:
            root = spline(_alpha_coordinate(facets.alpha_u), _ALPHAS).sum(self._average)
        else:
            low, high = (
                spline(_alpha_coordinate(a), _PAIRED_ALPHAS) for a in _ordered(facets)
            )
            root = low.sum(lambda i: high.sum(lambda j: self._average(pair(i, j)[0])))
        return _scaled_average(root, facets)


class DielectricLoss:
    """``1 - E`` and ``1 - E_avg`` of an interface, reflection and refraction together.

    Parameters
    ----------
    distribution : str
        ``ggx`` or ``beckmann``.
    isotropic : bool
        Whether both alphas are the same parameter.

    Notes
    -----
    Masking is separable, as in `dielectric.Dielectric`. Indices are tabulated in [1/3, 3]; beyond,
    the nearest is taken. Largest errors of ``E`` with indices in [1.1, 2.4] and their inverses:
    7e-3 with equal alphas in [0.02, 2], 3e-2 with others.
    """

    def __init__(self, distribution: str, isotropic: bool) -> None:
        tables = _named(distribution, False)
        self._isotropic = isotropic
        name, count, degree = "interface", _INTERFACE_COSINES, 3
        if not isotropic:
            name, count, degree = "interface_anisotropic", _INTERFACE_PAIRED["cosines"], 2
        key = distribution, name
        self._rows = _shared(lambda: Rows(tables[name], count, degree), *key)
        self._average = _shared(lambda: _Numbers(tables[f"{name}_average"]), *key, "average")

    def directional(self, facets: Any, eta: Any, w: Any) -> Any:
        """``1 - E(w)``, in [0, 1]; `eta` the index beyond over that of the side of `w`."""
        mu = dr.clip(dr.abs(w.z), 0, 1)
        edge = _edge(eta)
        if self._isotropic:
            value = self._rows.at(_interface_cosine_coordinate(mu, facets.alpha_u, edge))
            etas, alphas = self._etas(eta), self._alphas(facets.alpha_u)
            root = etas.sum(lambda e: alphas.sum(lambda i: value(e * _INTERFACE_ALPHAS + i)))
        else:
            count, azimuths = _INTERFACE_PAIRED["alphas"], _INTERFACE_PAIRED["azimuths"]
            each = count * (count + 1) // 2 * azimuths
            azimuth = _Azimuth(facets, w)
            value = self._rows.at(_interface_cosine_coordinate(mu, azimuth.alpha, edge))
            low, high = (self._alphas(a) for a in _ordered(facets))
            place = spline(azimuth.interface(edge), azimuths, 2)
            root = self._etas(eta).sum(
                lambda e: _over_pairs(
                    low, high, place, azimuths, lambda row: value(e * each + row)
                )
            )
        return dr.clip(dr.square(root), 0, 1)

    def average(self, facets: Any, eta: Any) -> Any:
        """``1 - E_avg``, in (0, 1]."""
        etas = self._etas(eta)
        if self._isotropic:
            alphas = self._alphas(facets.alpha_u)
            root = etas.sum(
                lambda e: alphas.sum(lambda i: self._average(e * _INTERFACE_ALPHAS + i))
            )
        else:
            count = _INTERFACE_PAIRED["alphas"]
            pairs = count * (count + 1) // 2
            low, high = (self._alphas(a) for a in _ordered(facets))
            root = etas.sum(
                lambda e: low.sum(
                    lambda i: high.sum(lambda j: self._average(e * pairs + pair(i, j)[0]))
                )
            )
        return _scaled_average(root, facets)

    def _alphas(self, alpha: Any) -> Spline:
        coordinate = _alpha_coordinate(alpha)
        if self._isotropic:
            return spline(coordinate, _INTERFACE_ALPHAS)
        return spline(coordinate, _INTERFACE_PAIRED["alphas"], 2)

    def _etas(self, eta: Any) -> Spline:
        """Indices below 1 have the first half of the rows."""
        root = dr.sqrt(dr.abs((eta - 1) / (eta + 1)))
        coordinate = (root - _LEAST_ETA_ROOT) / (_MOST_ETA_ROOT - _LEAST_ETA_ROOT)
        count = _ETAS if self._isotropic else _INTERFACE_PAIRED["etas"]
        place = spline(coordinate, count // 2, 3 if self._isotropic else 2)
        half = mi.UInt32(dr.select(dr.detach(eta) < 1, mi.UInt32(0), mi.UInt32(count // 2)))
        return Spline(place.first + half, place.weights)


class _Azimuth:
    """A view as the tables of unequal alphas see it."""

    def __init__(self, facets: Any, w: Any) -> None:
        low, high = _ordered(facets)
        excess = (high - low) * (high + low) / dr.square(low)
        x2, y2 = dr.square(w.x), dr.square(w.y)
        length2 = x2 + y2
        along = dr.select(facets.alpha_u > facets.alpha_v, y2, x2)
        #: Share of the squared sine along the narrow axis; from above, all azimuths are the same.
        self.narrow = dr.select(length2 > 1e-30, along / dr.maximum(length2, 1e-30), 0.5)
        square = 1 + excess * (1 - self.narrow)
        #: Alpha along the view.
        self.alpha = low * dr.sqrt(square)
        #: Coordinate of the azimuth.
        self.v = dr.log(square) / dr.maximum(dr.log(1 + excess), 1e-7)

    def interface(self, edge: Any) -> Any:
        """Coordinate of the azimuth for an interface."""
        return 0.5 * (self.v + (1 - _bend(self.narrow, edge)))


def _over_pairs(low: Spline, high: Spline, azimuth: Spline, azimuths: int, value: Any) -> Any:
    """The sum over pairs of alphas and azimuths of the values of rows."""

    def row(i: Any, j: Any, v: Any) -> Any:
        number, exchanged = pair(i, j)
        return number * azimuths + dr.select(exchanged, azimuths - 1 - v, v)

    return low.sum(
        lambda i: high.sum(lambda j: azimuth.sum(lambda v: value(row(i, j, v))))
    )


def _ordered(facets: Any) -> tuple[Any, Any]:
    u, v = facets.alpha_u, facets.alpha_v
    return dr.minimum(u, v), dr.maximum(u, v)


def _scaled_average(root: Any, facets: Any) -> Any:
    alpha = dr.sqrt(0.5 * (dr.square(facets.alpha_u) + dr.square(facets.alpha_v)))
    return dr.clip(dr.square(root * alpha / (1 + alpha)), 1e-18, 1)


def _alpha_coordinate(alpha: Any) -> Any:
    return (dr.sqrt(alpha / (alpha + 2)) - _LEAST_ROOT) / (_MOST_ROOT - _LEAST_ROOT)


def _cosine_coordinate(mu: Any, alpha: Any) -> Any:
    # Bounds keep the derivatives of both roots finite.
    share = dr.sqrt(dr.maximum(mu * (1 + alpha) / (mu + alpha), 1e-12))
    return 1 - dr.sqrt(dr.maximum(1 - share, 1e-12))


def _interface_cosine_coordinate(mu: Any, alpha: Any, edge: Any) -> Any:
    return 0.7 * _cosine_coordinate(mu, alpha) + 0.3 * _bend(dr.square(mu), 1 - edge)


def _edge(eta: Any) -> Any:
    inside = dr.clip(eta, 1 / 3, 3)
    return dr.select(inside < 1, dr.square(inside), 0.5)


def _bend(y: Any, edge: Any) -> Any:
    """A map of [0, 1] to itself that is steepest at `edge` and takes it to the middle."""
    w = y * (1 - edge) / (y * (1 - 2 * edge) + edge)
    x = 2 * w - 1
    return 0.5 + 0.5 * x * dr.sqrt(1.5 / (dr.square(x) + 0.5))
