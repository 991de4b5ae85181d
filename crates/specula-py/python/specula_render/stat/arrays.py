"""Types of arrays, and checks of what callers and their callables hand over."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]
Function = Callable[[FloatArray, FloatArray], Any]
"""Of wo (n, 3) and of wi or random numbers (n, 3)."""

UNIT_TOLERANCE = 1e-5
"""How far the squared length of a unit vector may be from 1: ample for single precision."""


def is_unit(w: FloatArray) -> BoolArray:
    """Whether directions, shape (n, 3), are finite and of length 1."""
    squared = np.einsum("ij,ij->i", w, w)
    return np.asarray(np.abs(squared - 1.0) < UNIT_TOLERANCE, dtype=np.bool_)


def unit_directions(value: npt.ArrayLike, name: str) -> FloatArray:
    """Directions of a caller as an array of shape (n, 3).

    Parameters
    ----------
    value
        Unit directions, shape (n, 3) or (3,).
    name
        What messages call them.

    Raises
    ------
    ValueError
        If the shape is another one, or a direction is not a unit vector: its index is named.
    """
    w: FloatArray = np.atleast_2d(np.asarray(value, dtype=np.float64))
    if w.ndim != 2 or w.shape[1] != 3 or w.shape[0] == 0:
        raise ValueError(f"{name}: shape (n, 3) with n > 0 expected, {np.shape(value)} came")
    off = np.flatnonzero(~is_unit(w))
    if off.size:
        k = int(off[0])
        length = float(np.linalg.norm(w[k]))
        text = ", ".join(f"{x:g}" for x in w[k])
        raise ValueError(f"{name}[{k}] = ({text}) has length {length:g}: a unit vector expected")
    return w


def one_direction(value: npt.ArrayLike, name: str) -> FloatArray:
    """A caller's one unit direction, shape (3,).

    Raises
    ------
    ValueError
        If it is not one, or not a unit vector.
    """
    if np.shape(value) != (3,):
        raise ValueError(f"{name}: shape (3,) expected, {np.shape(value)} came")
    return np.asarray(unit_directions(value, name)[0])


def returned(value: Any, what: str, n: int, columns: int, *, spread: bool = False) -> FloatArray:
    """What a callable returned, in double precision, shape (n,) or (n, columns).

    Parameters
    ----------
    value
        The returned value.
    what
        The callable and the part of its result, for messages.
    n, columns
        The expected shape; `columns` is 0 for (n,).
    spread
        Whether shape (n,) is welcome too: it then fills all columns.

    Raises
    ------
    ValueError
        If the shape is another one, or the values are not real numbers.
    """
    expected = (n, columns) if columns else (n,)
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise TypeError
    except (TypeError, ValueError):
        raise ValueError(
            f"{what}: an array of real numbers of shape {expected} expected, "
            f"{type(value).__name__} came"
        ) from None
    if spread and array.shape == (n,):
        array = np.repeat(array[:, None], columns, axis=1)
    if array.shape != expected:
        also = f" or {(n,)}" if spread else ""
        raise ValueError(f"{what}: shape {expected}{also} expected, {array.shape} came")
    return np.asarray(array, dtype=np.float64)
