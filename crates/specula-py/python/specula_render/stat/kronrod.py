"""The nested 7/15-point Gauss-Kronrod rule on patches of the sphere, many patches at a time.

Nodes and weights: Piessens et al. 1983, QUADPACK, `qk15`.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import FloatArray, IntArray

Integrand = Callable[[FloatArray], FloatArray]
"""Of unit directions (n, 3), per steradian: (n, c) for c components."""

_HALF_NODES = [
    0.9914553711208126, 0.9491079123427585, 0.8648644233597691, 0.7415311855993944,
    0.5860872354676911, 0.4058451513773972, 0.20778495500789848, 0.0,
]  # fmt: skip
_HALF_KRONROD = [
    0.022935322010529224, 0.06309209262997855, 0.10479001032225018, 0.14065325971552592,
    0.1690047266392679, 0.1903505780647854, 0.2044329400752989, 0.20948214108472783,
]  # fmt: skip
_HALF_GAUSS = [
    0.0, 0.1294849661688697, 0.0, 0.27970539148927664, 0.0, 0.3818300505051189, 0.0,
    0.4179591836734694,
]  # fmt: skip

NODES: FloatArray = np.array([-x for x in _HALF_NODES] + _HALF_NODES[-2::-1])
"""Nodes of both rules on [-1, 1], ascending."""
KRONROD: FloatArray = np.array(_HALF_KRONROD + _HALF_KRONROD[-2::-1])
"""Weights of the 15-point rule."""
GAUSS: FloatArray = np.array(_HALF_GAUSS + _HALF_GAUSS[-2::-1])
"""Weights of the 7-point rule, 0 at the nodes that it lacks."""

POINTS = 225
"""Directions for each patch."""
_BLOCK = 512
"""Patches for each call of the integrand: about 10^5 directions."""


def integrate(patches: FloatArray, f: Integrand) -> tuple[FloatArray, FloatArray, IntArray]:
    """Integrals over patches, by the tensor product of the rule in theta and phi.

    The integrand is taken in (theta, phi), not (cos theta, phi): smooth functions stay smooth at
    the poles.

    Parameters
    ----------
    patches
        Shape (p, 4), p > 0.
    f
        The integrand; it is called with many directions at a time.

    Returns
    -------
    value
        Integrals of the components, (p, c).
    error
        Estimates of the absolute error, the largest over the components, (p,); infinite where
        the integrand is not finite.
    worse_axis
        The side that causes more of the error, (p,): 0 theta, 1 phi.
    """
    blocks = [_integrate(patches[k : k + _BLOCK], f) for k in range(0, len(patches), _BLOCK)]
    value, error, axis = zip(*blocks, strict=True)
    return np.concatenate(value), np.concatenate(error), np.concatenate(axis)


def _integrate(patches: FloatArray, f: Integrand) -> tuple[FloatArray, FloatArray, IntArray]:
    p = len(patches)
    middle = 0.5 * (patches[:, 0::2] + patches[:, 1::2])
    half = 0.5 * (patches[:, 1::2] - patches[:, 0::2])
    theta = middle[:, :1] + half[:, :1] * NODES
    phi = middle[:, 1:] + half[:, 1:] * NODES
    sin_theta = np.sin(theta)
    w = np.empty((p, 15, 15, 3))
    w[..., 0] = sin_theta[:, :, None] * np.cos(phi)[:, None, :]
    w[..., 1] = sin_theta[:, :, None] * np.sin(phi)[:, None, :]
    w[..., 2] = np.cos(theta)[:, :, None]
    values = f(w.reshape(-1, 3)).reshape(p, 15, 15, -1)
    with np.errstate(invalid="ignore", over="ignore"):
        area = sin_theta * (half[:, :1] * half[:, 1:])
        values = values * area[:, :, None, None]
        over_phi = np.einsum("j,pijc->pic", KRONROD, values)
        both = np.einsum("i,pic->pc", KRONROD, over_phi)
        in_theta = np.einsum("i,pic->pc", GAUSS, over_phi)
        in_phi = np.einsum("i,j,pijc->pc", KRONROD, GAUSS, values, optimize=True)
        squares = np.einsum("i,j,pij->p", KRONROD, KRONROD, np.sum(values**2, axis=-1))
        spread = np.maximum(np.abs(both).max(axis=1), np.sqrt(4.0 * squares))
        errors = np.stack(
            [
                _bound(np.abs(both - in_theta).max(axis=1), spread),
                _bound(np.abs(both - in_phi).max(axis=1), spread),
            ]
        )
        is_finite = np.isfinite(both).all(axis=1)
        error = np.where(is_finite, errors.sum(axis=0), np.inf)
        return both, error, (errors[1] > errors[0]).astype(np.int64)


def _bound(difference: FloatArray, spread: FloatArray) -> FloatArray:
    """A bound of the 15-point rule's error, from its difference to the 7-point rule.

    QUADPACK's, which is the lower one where the integrand is smooth; at kinks ten times the
    difference, because once is too little where a kink makes both rules err alike.
    """
    safe = np.where(spread > 0.0, spread, 1.0)
    smooth = safe * (200.0 * difference / safe) ** 1.5
    bound = np.maximum(np.minimum(smooth, 10.0 * difference), 1e-16 * safe)
    return np.where(spread == 0.0, 0.0, bound)
