"""What the tests of the Mitsuba plugins share; holds no test."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

import llvm


llvm.find()
mi: Any = pytest.importorskip("mitsuba", reason="Mitsuba is not installed: pip install mitsuba")
dr: Any = pytest.importorskip("drjit", reason="Dr.Jit is not installed")
np: Any = pytest.importorskip("numpy")

from specula_render import mitsuba as specula  # noqa: E402

__all__ = [
    "ALPHAS",
    "SAMPLERS",
    "WHITE",
    "Dict",
    "agrees",
    "conductor",
    "directions",
    "dr",
    "mi",
    "np",
    "numbers",
    "render_mean",
    "rgb",
    "scene_of",
    "specula",
    "surface",
    "unit",
    "use",
]

Dict = dict[str, Any]

SAMPLERS = ("exact", "bounded", "cap", "heitz")
ALPHAS: list[Dict] = [
    {"alpha": 0.1},
    {"alpha": 0.5},
    {"alpha": 1.0},
    {"alpha_u": 0.15, "alpha_v": 0.6},
]
WHITE: Dict = {"eta": 0.0, "k": 1.0}


@pytest.fixture(autouse=True)
def rgb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Vectorized RGB, unless the test sets another variant; failures leave tables in a folder."""
    monkeypatch.chdir(tmp_path)
    use("llvm_ad_rgb")


def use(variant: str) -> None:
    """Activate a variant and register the plugins."""
    try:
        mi.set_variant(variant)
    except ImportError as reason:
        if not variant.startswith("cuda"):
            raise
        pytest.skip(f"not of this machine: CUDA, {reason}")
    specula.register()
    if variant.startswith("llvm"):
        try:
            dr.eval(mi.Float(1) + mi.Float(2))
        except RuntimeError as reason:
            pytest.skip(f"Dr.Jit finds no LLVM (15 or newer, DRJIT_LIBLLVM_PATH): {reason}")


def conductor(**parameters: Any) -> Any:
    return mi.load_dict({"type": "specula_conductor", **parameters})


def unit(v: tuple[float, float, float]) -> list[float]:
    return [float(x) for x in np.asarray(v) / np.linalg.norm(v)]


def surface(wi: Any, n: int = 1) -> Any:
    """Points seen from `wi`, a direction or an array of them."""
    si = dr.zeros(mi.SurfaceInteraction3f, n)
    si.wi = mi.Vector3f(wi)
    si.uv = 3 * mi.Point2f(si.wi.x, si.wi.y)
    if mi.is_spectral:
        si.wavelengths = type(si.wavelengths)(450, 520, 580, 640)
    return si


def directions(n: int, seed: int, full_sphere: bool = False) -> Any:
    rng = np.random.default_rng(seed)
    v = rng.normal(size=(3, n))
    v /= np.linalg.norm(v, axis=0)
    if not full_sphere:
        v[2] = np.abs(v[2])
    return mi.Vector3f(v.astype(np.float32))


def numbers(n: int, seed: int) -> tuple[Any, Any]:
    rng = mi.PCG32(size=n, initstate=seed)
    x = rng.next_float32()
    return x, mi.Point2f(rng.next_float32(), rng.next_float32())


def agrees(ours: Any, theirs: Any, tolerance: float = 2e-4, floor: float = 1e-6) -> None:
    ours, theirs = np.array(ours), np.array(theirs)
    assert np.isfinite(ours).all()
    assert np.abs(theirs).max() > 0
    np.testing.assert_allclose(ours, theirs, rtol=tolerance, atol=floor)


def scene_of(bsdf: Dict, size: int = 24) -> Dict:
    """A ball under a lamp and a grey sky."""
    look_at = mi.ScalarTransform4f().look_at
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}}
    lamp = {"type": "area", "radiance": {"type": "rgb", "value": [20.0, 10.0, 5.0]}}
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 4},
        "sensor": {
            "type": "perspective",
            "fov": 25,
            "to_world": look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]),
            "film": film | {"pixel_format": "rgb"},
            "sampler": {"type": "independent", "sample_count": 64},
        },
        "ball": {"type": "sphere", "bsdf": bsdf},
        "lamp": {
            "type": "rectangle",
            "to_world": look_at([4, 3, 4], [0, 0, 0], [0, 1, 0]),
            "emitter": lamp,
        },
        "sky": {"type": "constant", "radiance": 0.5},
    }


def render_mean(scene: Dict, spp: int = 64, count: int = 4) -> tuple[Any, Any]:
    loaded = mi.load_dict(scene)
    means = [np.array(mi.render(loaded, seed=k, spp=spp)).mean((0, 1)) for k in range(count)]
    return np.mean(means, 0), np.std(means, 0, ddof=1) / count**0.5
