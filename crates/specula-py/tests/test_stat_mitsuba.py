"""BSDFs of Mitsuba 3 through the proofs."""

from __future__ import annotations

import os
import re
from glob import glob
from typing import Any

import numpy as np
import pytest
from specula_render import stat


def newest_llvm() -> str | None:
    """The shared library of the newest LLVM here.

    Dr.Jit looks in few places, and takes no old one.
    """
    found = glob("/usr/lib/*-linux-gnu/libLLVM*.so*") + glob("/usr/lib/llvm-*/lib/libLLVM*.so*")
    version = {path: re.search(r"libLLVM(?:-|\.so\.)(\d+)", path) for path in found}
    numbered = [(int(match[1]), path) for path, match in version.items() if match]
    return max(numbered)[1] if numbered else None


_path = newest_llvm()
if _path is not None:
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", _path)

mi: Any = pytest.importorskip("mitsuba", reason="Mitsuba is not installed")


@pytest.fixture(autouse=True)
def variant() -> Any:
    before = mi.variant()
    try:
        mi.set_variant("llvm_ad_rgb")
        mi.Float([1.0]) + 1.0
    except Exception as error:
        pytest.skip(f"Mitsuba's variant llvm_ad_rgb does not run here: {error}")
    yield
    if before is not None:
        mi.set_variant(before)


def conductor(alpha: float) -> dict[str, Any]:
    return {"type": "roughconductor", "material": "Au", "distribution": "ggx", "alpha": alpha}


VIEWS = stat.views(azimuth_deg=(20.0,))
GLASS = {
    "type": "roughdielectric",
    "distribution": "ggx",
    "alpha": 0.3,
    "int_ior": 1.5,
    "ext_ior": 1.0,
}


@pytest.mark.parametrize(
    ("description", "plan", "views"),
    [
        ({"type": "diffuse"}, stat.Plan(), VIEWS),
        (conductor(0.1), stat.Plan(), VIEWS),
        (conductor(0.5), stat.Plan(), VIEWS),
        (
            GLASS,
            stat.Plan(eta=1.5, reciprocity="everywhere"),
            stat.views(cos_theta=(0.7, 0.05), azimuth_deg=(20.0,), below=True),
        ),
        ({"type": "dielectric"}, stat.Plan(reciprocity="nowhere"), VIEWS[:2]),
    ],
    ids=["diffuse", "conductor 0.1", "conductor 0.5", "glass", "smooth glass"],
)
def test_mitsuba_passes(description: dict[str, Any], plan: stat.Plan, views: Any) -> None:
    report = stat.prove(description["type"], mi.load_dict(description), views, plan)
    assert report.is_pass, str(report)


def test_glass_without_the_factor_of_refraction_is_not_reciprocal() -> None:
    subject = stat.Subject.of_mitsuba(mi.load_dict(GLASS))
    check = stat.reciprocity(subject, stat.Plan(eta=1.0, reciprocity="everywhere"))
    assert not check.passed
    assert check.value == pytest.approx(1.0 - 1.5**-2, rel=0.05)


def test_values_are_those_of_mitsuba() -> None:
    bsdf = mi.load_dict(conductor(0.3))
    subject = stat.Subject.of_mitsuba(bsdf)
    wo, wi = np.array([[0.6, 0.0, 0.8]] * 2), np.array([[-0.6, 0.0, 0.8], [0.0, 0.6, 0.8]])
    si = mi.SurfaceInteraction3f()
    si.wi = [0.6, 0.0, 0.8]
    for k in range(2):
        value = bsdf.eval(mi.BSDFContext(), si, mi.Vector3f(*wi[k].tolist()))
        assert subject.eval(wo, wi)[k] == pytest.approx(np.ravel(value), rel=1e-5)
    assert subject.is_single


def test_black_is_evaluated_in_the_shape_asked_for() -> None:
    subject = stat.Subject.of_mitsuba(mi.load_dict({"type": "diffuse", "reflectance": 0.0}))
    wo = np.tile([0.0, 0.0, 1.0], (5, 1))
    assert subject.eval(wo, wo).shape == (5, 3)
    assert subject.sample(wo, np.full((5, 3), 0.5)).weight.shape == (5, 3)


def test_variants_that_cannot_be_tested_are_told() -> None:
    bsdf = mi.load_dict({"type": "diffuse"})
    mi.set_variant("scalar_rgb")
    with pytest.raises(ValueError, match="scalar_rgb: a vectorised one expected"):
        stat.Subject.of_mitsuba(bsdf)
    mi.set_variant("llvm_ad_rgb")
