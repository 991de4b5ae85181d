"""Directions by angles, and patches: rectangles in polar angle and azimuth.

Patches are rows `(theta_0, theta_1, phi_0, phi_1)` of an array of shape (p, 4), in radians.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .arrays import BoolArray, FloatArray, IntArray


class Peak(NamedTuple):
    """A direction about which a density may be sharp."""

    direction: tuple[float, float, float]
    """Unit direction."""
    width: float
    """Angular width, radians: patches near the peak start no larger than this."""


def angles(w: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Polar angle in [0, pi] and azimuth in [0, 2 pi), radians, of directions (n, 3)."""
    # By arctan2, which is accurate near the poles, unlike arccos.
    theta = np.arctan2(np.hypot(w[:, 0], w[:, 1]), w[:, 2])
    phi = np.arctan2(w[:, 1], w[:, 0])
    phi = np.where(phi < 0.0, phi + 2.0 * np.pi, phi)
    return theta, np.where(phi >= 2.0 * np.pi, 0.0, phi)


def direction(cos_theta: FloatArray, phi: FloatArray) -> FloatArray:
    """Unit directions (n, 3) of cosines of the polar angle and azimuths in radians, each (n,)."""
    sin_theta = np.sqrt(np.maximum((1.0 - cos_theta) * (1.0 + cos_theta), 0.0))
    return np.stack([sin_theta * np.cos(phi), sin_theta * np.sin(phi), cos_theta], axis=1)


def extents(patches: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Height and width on the unit sphere, radians, each (p,); the width where it is widest."""
    theta_0, theta_1 = patches[:, 0], patches[:, 1]
    spans_equator = (theta_0 < 0.5 * np.pi) & (theta_1 > 0.5 * np.pi)
    widest = np.where(spans_equator, 1.0, np.maximum(np.sin(theta_0), np.sin(theta_1)))
    return theta_1 - theta_0, widest * (patches[:, 3] - patches[:, 2])


def solid_angles(patches: FloatArray) -> FloatArray:
    """Solid angles, sr, (p,)."""
    height = np.cos(patches[:, 0]) - np.cos(patches[:, 1])
    return np.asarray(height * (patches[:, 3] - patches[:, 2]))


def longer_axis(patches: FloatArray) -> IntArray:
    """The side that is longer on the sphere, (p,): 0 theta, 1 phi."""
    height, width = extents(patches)
    return (width > height).astype(np.int64)


def bisect(patches: FloatArray, axis: IntArray) -> tuple[FloatArray, FloatArray]:
    """The two halves of each patch, cut across `axis`, (p, 2, 4); and the places of the cuts."""
    k = np.arange(len(patches))
    at = 0.5 * (patches[k, 2 * axis] + patches[k, 2 * axis + 1])
    halves = np.repeat(patches[:, None, :], 2, axis=1)
    halves[k, 0, 2 * axis + 1] = at
    halves[k, 1, 2 * axis] = at
    return halves, at


def are_near(patches: FloatArray, peak: Peak) -> BoolArray:
    """Whether patches contain a peak or lie, nearly, within its width of it, (p,)."""
    theta, phi = (float(x[0]) for x in angles(np.array([peak.direction])))
    margin_phi = peak.width / max(np.sin(theta), peak.width)
    centre = 0.5 * (patches[:, 2] + patches[:, 3])
    across = np.abs((phi - centre + np.pi) % (2.0 * np.pi) - np.pi)
    return np.asarray(
        (theta > patches[:, 0] - peak.width)
        & (theta < patches[:, 1] + peak.width)
        & (across < 0.5 * (patches[:, 3] - patches[:, 2]) + margin_phi)
    )
