"""BSDFs in NumPy, written from the papers, that all checks must pass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from specula_render import stat

Array = npt.NDArray[np.float64]

METAL = np.array([0.95, 0.64, 0.54])
"""Reflectance at normal incidence."""


@dataclass(frozen=True)
class Sampled:
    """What `Subject.of` takes."""

    wi: Array
    weight: Array
    pdf: Array


@dataclass(frozen=True)
class Lambert:
    """Diffuse reflection, of both sides if `is_translucent` transmits half of it."""

    is_translucent: bool = False

    def pdf(self, wo: Array, wi: Array) -> Array:
        is_same = wo[:, 2] * wi[:, 2] > 0.0
        share = 0.5 if self.is_translucent else np.where(is_same & (wo[:, 2] > 0.0), 1.0, 0.0)
        return np.asarray(share * np.abs(wi[:, 2]) / np.pi)

    def eval(self, wo: Array, wi: Array) -> Array:
        return np.asarray(self.pdf(wo, wi)[:, None] * METAL)

    def sample(self, wo: Array, u: Array) -> Sampled:
        r, phi = np.sqrt(u[:, 0]), 2.0 * np.pi * u[:, 1]
        wi = np.stack([r * np.cos(phi), r * np.sin(phi), np.sqrt(1.0 - u[:, 0])], axis=1)
        if self.is_translucent:
            wi[u[:, 2] < 0.5, 2] *= -1.0
        return Sampled(wi, np.tile(METAL, (len(wi), 1)), self.pdf(wo, wi))


@dataclass(frozen=True)
class Ggx:
    """A GGX metal with Schlick's Fresnel term, correlated masking, and visible normals."""

    ax: float
    ay: float

    def d(self, wm: Array) -> Array:
        e = (wm[:, 0] / self.ax) ** 2 + (wm[:, 1] / self.ay) ** 2 + wm[:, 2] ** 2
        return np.asarray(1.0 / (np.pi * self.ax * self.ay * e * e))

    def lambda_(self, w: Array) -> Array:
        """Heitz 2014, eq. 72."""
        z_squared = np.maximum(w[:, 2] ** 2, 1e-300)
        slope_squared = ((self.ax * w[:, 0]) ** 2 + (self.ay * w[:, 1]) ** 2) / z_squared
        return np.asarray(0.5 * (np.sqrt(1.0 + slope_squared) - 1.0))

    def terms(self, wo: Array, wi: Array) -> tuple[Array, Array, npt.NDArray[np.bool_]]:
        """Half vector, wo . wm, and where both directions are above."""
        wm = wo + wi
        length = np.linalg.norm(wm, axis=1)
        wm = wm / np.where(length > 0.0, length, 1.0)[:, None]
        return wm, np.einsum("ij,ij->i", wo, wm), (wo[:, 2] > 0.0) & (wi[:, 2] > 0.0)

    def pdf(self, wo: Array, wi: Array) -> Array:
        wm, _, is_above = self.terms(wo, wi)
        with np.errstate(all="ignore"):
            density = self.d(wm) / ((1.0 + self.lambda_(wo)) * 4.0 * wo[:, 2])
        return np.where(is_above, density, 0.0)

    def eval(self, wo: Array, wi: Array) -> Array:
        wm, cos_m, is_above = self.terms(wo, wi)
        with np.errstate(all="ignore"):
            g2 = 1.0 / (1.0 + self.lambda_(wo) + self.lambda_(wi))
            value = self.d(wm) * g2 / (4.0 * wo[:, 2])
        fresnel = METAL + (1.0 - METAL) * ((1.0 - cos_m) ** 5)[:, None]
        return np.asarray(np.where(is_above, value, 0.0)[:, None] * fresnel)

    def sample(self, wo: Array, u: Array) -> Sampled:
        """Dupuy and Benyoub 2023: half vectors of directions uniform on a spherical cap."""
        stretch = np.array([self.ax, self.ay, 1.0])
        i = wo * stretch
        i /= np.linalg.norm(i, axis=1, keepdims=True)
        z = 1.0 - u[:, 0] * (1.0 + i[:, 2])
        r, phi = np.sqrt(np.maximum(1.0 - z * z, 0.0)), 2.0 * np.pi * u[:, 1]
        wm = (np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1) + i) * stretch
        wm /= np.linalg.norm(wm, axis=1, keepdims=True)
        wi = 2.0 * np.einsum("ij,ij->i", wo, wm)[:, None] * wm - wo
        wi /= np.linalg.norm(wi, axis=1, keepdims=True)
        pdf = self.pdf(wo, wi)
        with np.errstate(all="ignore"):
            weight = np.where(pdf[:, None] > 0.0, self.eval(wo, wi) / pdf[:, None], 0.0)
        return Sampled(wi, weight, pdf)


class SingleGgx(Ggx):
    """The same in single precision."""

    def pdf(self, wo: Array, wi: Array) -> Array:
        return super().pdf(single(wo), single(wi)).astype(np.float32)

    def eval(self, wo: Array, wi: Array) -> Array:
        return super().eval(single(wo), single(wi)).astype(np.float32)

    def sample(self, wo: Array, u: Array) -> Sampled:
        return super().sample(single(wo), single(u))


def single(values: Array) -> Any:
    return values.astype(np.float32)


@pytest.mark.parametrize(
    "alpha", [(0.02, 0.02), (0.1, 0.1), (0.5, 0.5), (1.0, 1.0), (0.1, 0.6)], ids=str
)
def test_ggx_passes(alpha: tuple[float, float]) -> None:
    report = stat.prove(f"GGX {alpha}", Ggx(*alpha), stat.views())
    assert report.is_pass, str(report)
    assert len(report.checks) == 5 * 7 + 1


def test_single_precision_passes_with_its_own_tolerance() -> None:
    subject = stat.Subject.of(SingleGgx(0.1, 0.6))
    report = stat.prove("GGX in single precision", subject)
    assert subject.is_single
    assert report.is_pass, str(report)
    worst = max(c.value for c in report.checks if c.name.startswith("weight"))
    assert 0.0 < worst < subject.relative_tolerance == 1e-3


def test_lambert_passes() -> None:
    report = stat.prove("Lambert", Lambert())
    assert report.is_pass, str(report)


def test_lambert_that_transmits_passes_from_both_sides() -> None:
    plan = stat.Plan(reciprocity="everywhere")
    views = stat.views(cos_theta=(1.0, 0.3), below=True)
    report = stat.prove("translucent", Lambert(is_translucent=True), views, plan)
    assert report.is_pass, str(report)
