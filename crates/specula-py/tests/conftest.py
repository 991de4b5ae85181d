"""What the tests share: directions, lobes, and room for figures."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

import specula_render as sr
from specula_render.lab.process import call


# What chores and tests share.
sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))

# Shells start background jobs that ignore Ctrl-C, and so would every process that tests interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)


def directions(
    count: int, *, seed: int = 1, both_sides: bool = False, least: float = 0.02
) -> npt.NDArray[np.float64]:
    """Return ``count`` unit vectors: cosines even in [least, 1], azimuths even."""
    rng = np.random.default_rng(seed)
    z = least + (1.0 - least) * rng.random(count)
    if both_sides:
        z *= np.where(rng.random(count) < 0.5, 1.0, -1.0)
    phi = 2.0 * np.pi * rng.random(count)
    r = np.sqrt(1.0 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)


def measured() -> sr.MeasuredBrdf:
    """Return GGX gold as a measurement has it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "gold.bsdf"
        command = ["tabulate", "conductor Au alpha 0.3", "--views", "8", "--colours", "12"]
        call([*command, "-o", str(file)], progress=False)
        return sr.MeasuredBrdf(file)


LOBES: dict[str, sr.Bsdf] = {
    "lambert": sr.Lambert((0.2, 0.5, 0.8)),
    "eon": sr.Eon((0.2, 0.5, 0.8), 0.7),
    "sheet": sr.DiffuseTransmission((0.2, 0.3, 0.4), (0.1, 0.2, 0.3)),
    "mirror": sr.SmoothConductor("Ag"),
    "gold exact": sr.RoughConductor((0.2, 0.5), "Au"),
    "gold bounded": sr.RoughConductor(0.3, "Au", sampler="bounded"),
    "gold cap": sr.RoughConductor(0.3, "Au", sampler="cap", masking="separable"),
    "gold heitz": sr.RoughConductor(0.3, "Au", sampler="heitz"),
    "gold beckmann": sr.RoughConductor((0.2, 0.5), "Au", distribution="beckmann"),
    "turquin": sr.RoughConductor(0.7, "Cu", energy="turquin"),
    "kulla-conty": sr.RoughConductor(0.7, "Cu", energy="kulla-conty"),
    "schlick": sr.RoughConductor(0.4, sr.Reflectance.schlick((0.9, 0.6, 0.3))),
    "f82": sr.RoughConductor(0.4, sr.Reflectance.f82_tint((0.9, 0.6, 0.3), (0.8, 0.9, 1.0))),
    "multibounce": sr.MultibounceConductor(0.7, "Cu"),
    "multibounce heitz": sr.MultibounceConductor((0.3, 0.7), "Cu", model="heitz"),
    "smooth glass": sr.SmoothDielectric(1.5),
    "pane": sr.ThinDielectric(1.5),
    "glass": sr.RoughDielectric(0.3, 1.5),
    "glass beckmann": sr.RoughDielectric(0.3, 1.33, distribution="beckmann"),
    "compensated glass": sr.RoughDielectric(0.5, 1.5, compensated=True),
    "multibounce glass": sr.MultibounceDielectric(0.5, 1.5),
    "coated": sr.CoatedDiffuse(0.2, 1.5, (0.2, 0.5, 0.8)),
    "layered": sr.Layered(0.2, 1.5, reflectance="Au", base_alpha=0.4, thickness=0.2),
    "plastic": sr.Plastic(0.2, 1.49, (0.2, 0.5, 0.8)),
    "smooth plastic": sr.Plastic(None, 1.49, 0.5, nonlinear=True),
    "principled": sr.Principled((0.2, 0.5, 0.8), 0.4, metallic=0.5, clearcoat=0.5),
    "gltf": sr.Gltf((0.9, 0.6, 0.3), 0.5, 0.4, clearcoat=0.3, sheen_color=0.2),
    "measured": measured(),
    "hair": sr.Hair(colour=(0.5, 0.3, 0.15), beta_m=0.4, beta_n=0.5),
}
"""One of each class and choice, by name."""


@pytest.fixture(params=LOBES, ids=lambda name: name.replace(" ", "-"))
def lobe(request: pytest.FixtureRequest) -> sr.Bsdf:
    """One lobe after another."""
    return LOBES[request.param]


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Tell of a skip where all tests of the workspace tell of theirs."""
    file = os.environ.get("SPECULA_SKIPS")
    if report.skipped and file is not None:
        path, line, reason = report.longrepr  # type: ignore[misc]
        label = "NOT OF THIS MACHINE" if "not of this machine" in reason else "SKIPPED"
        with Path(file).open("a", encoding="utf-8") as skips:
            skips.write(f"{label} {path}:{line}: {report.nodeid}: {reason}\n")
