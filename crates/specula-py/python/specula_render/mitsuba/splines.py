"""B-splines of Rust's tables in the active variant: where a place lies, and sums of coefficients.

Source: `crates/specula-bsdf/src/energy/spline.rs` and `pairs.rs`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .runtime import dr, is_jit, mi

__all__ = ["Rows", "Spline", "pair", "spline"]


class Spline(NamedTuple):
    """Where a place of [0, 1] lies among the coefficients of an axis."""

    first: Any
    weights: Sequence[Any]

    def sum(self, value: Callable[[Any], Any]) -> Any:
        """The weighted sum of the values of the coefficients."""
        return sum(weight * value(self.first + k) for k, weight in enumerate(self.weights))


def spline(x: Any, count: int, degree: int = 3) -> Spline:
    """The coefficients about `x`, clamped to [0, 1], among `count`; cubic or quadratic."""
    cells = count - degree
    place = dr.clip(x, 0, 1) * cells
    first = mi.UInt32(dr.minimum(dr.detach(place), cells - 1))
    t = place - mi.Float(first)
    u = 1 - t
    if degree == 2:
        return Spline(first, (0.5 * u * u, 0.5 + t * u, 0.5 * t * t))
    t2, u2 = t * t, u * u
    inner = 2 / 3 - t2 * (1 - 0.5 * t), 2 / 3 - u2 * (1 - 0.5 * u)
    return Spline(first, (u2 * u / 6, *inner, t2 * t / 6))


class Rows:
    """A table whose last axis is a spline; rows are numbered.

    Parameters
    ----------
    values : (n,) array
        Coefficients, row after row.
    count : int
        Coefficients of a row.
    degree : int
        Of the splines along rows.
    """

    def __init__(self, values: npt.NDArray[np.float32], count: int, degree: int = 3) -> None:
        self._count, self._degree, self._cells = count, degree, count - degree
        # Each cell has its coefficients side by side: one access fetches four.
        rows = values.reshape(-1, count)
        cells = np.zeros((rows.shape[0], self._cells, 4), np.float32)
        for k in range(degree + 1):
            cells[:, :, k] = rows[:, k : k + self._cells]
        self._table: Any = mi.Float(cells.ravel()) if is_jit() else cells.reshape(-1, 4)

    def at(self, x: Any) -> Callable[[Any], Any]:
        """The function of a row's number that gives the row's value at `x` in [0, 1]."""
        place = spline(x, self._count, self._degree)

        def value(row: Any) -> Any:
            index = row * self._cells + place.first
            if is_jit():
                four = dr.gather(mi.Vector4f, self._table, index)
            else:
                four = [float(v) for v in self._table[int(index)]]
            return sum(weight * four[k] for k, weight in enumerate(place.weights))

        return value


def pair(i: Any, j: Any) -> tuple[Any, Any]:
    """Number of a pair of indices, the lower first; and whether they were exchanged."""
    exchanged = i > j
    low, high = dr.select(exchanged, j, i), dr.select(exchanged, i, j)
    return high * (high + 1) // 2 + low, exchanged
