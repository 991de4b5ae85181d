"""Random numbers by seed and name, and directions of all kinds."""

from __future__ import annotations

import zlib

import numpy as np

from .arrays import FloatArray
from .sphere import direction
from .subject import Subject


def generator(seed: int, name: str) -> np.random.Generator:
    """A stream of its own for each name, the same in every run."""
    return np.random.default_rng([seed, zlib.crc32(name.encode())])


def triples(subject: Subject, n: int, rng: np.random.Generator) -> FloatArray:
    """Uniform random numbers in [0, 1), (n, 3).

    Where the subject computes in single precision they are singles, so that its own rounding
    makes none of them 1.
    """
    if subject.is_single:
        return rng.random((n, 3), dtype=np.float32).astype(np.float64)
    return rng.random((n, 3))


def probes(n: int, rng: np.random.Generator) -> FloatArray:
    """Directions (n, 3): two in three uniform on the sphere, the rest near the horizon or a pole.

    Distances from those go down to 1e-12.
    """
    kind, place, azimuth, side = rng.random((4, n))
    small = 10.0 ** (-12.0 * place)
    cos_theta = np.select(
        [kind < 0.65, kind < 0.85, kind < 0.95, kind < 0.98],
        [place, small, 1.0 - small, np.ones(n)],
        0.0,
    )
    return direction(np.where(side < 0.5, -cos_theta, cos_theta), 2.0 * np.pi * azimuth)
