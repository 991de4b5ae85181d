"""Variance at equal time: Mitsuba's rough metal and glass against Specula's plugins.

    python benches/mitsuba_variance.py [--size 64] [--spp 64] [--rounds 8]

Renders of all candidates alternate, so that a busy machine slows all alike; seconds are medians.
``variance x time`` is relative to the first row of a scene: below 1 is less noise in the same time.
Needs ``mitsuba``, and LLVM for the variant ``llvm_ad_rgb``.
"""

from __future__ import annotations

import argparse
import importlib
import time
from collections.abc import Callable
from typing import Any

import numpy as np

# Untyped: their types depend on the variant.
dr: Any = importlib.import_module("drjit")
mi: Any = importlib.import_module("mitsuba")
mi.set_variant("llvm_ad_rgb")

from specula_render import mitsuba as specula  # noqa: E402

Dict = dict[str, Any]
METAL: Dict = {"material": "Al", "distribution": "ggx"}


def transform() -> Any:
    """The identity, to build on."""
    return mi.ScalarTransform4f()


def camera(origin: list[float], target: list[float], fov: float, size: int) -> Dict:
    """A pinhole camera with a box filter, so that pixels are independent."""
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}}
    return {
        "type": "perspective",
        "fov": fov,
        "to_world": transform().look_at(origin, target, [0, 1, 0]),
        "film": film | {"pixel_format": "rgb"},
        "sampler": {"type": "independent"},
    }


def room(wall: Dict, depth: int, size: int) -> Dict:
    """A closed cube of edge 4 with a square lamp below its ceiling."""
    lamp = transform().translate([0, 1.98, 0]).rotate([1, 0, 0], 90).scale(0.6)
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": depth},
        "sensor": camera([0, 0, 1.9], [0, -0.3, 0], 70, size),
        "walls": {
            "type": "cube",
            "to_world": transform().scale(2),
            "bsdf": {"type": "twosided", "wall": wall},
        },
        "lamp": {
            "type": "rectangle",
            "to_world": lamp,
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 12.0}},
        },
    }


def ball(bsdf: Dict) -> Dict:
    """A ball in the middle of the room."""
    return {"type": "sphere", "center": [0, -0.6, -0.2], "radius": 1.0, "bsdf": bsdf}


def metal_ball(bsdf: Dict, size: int) -> Dict:
    """A rough metal ball in a grey room."""
    grey = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}}
    return room(grey, 6, size) | {"ball": ball(bsdf)}


def metal_room(bsdf: Dict, size: int) -> Dict:
    """A closed room of the metal with a ball of it."""
    return room(bsdf, 12, size) | {"ball": ball(bsdf)}


def glass_ball(bsdf: Dict, size: int) -> Dict:
    """A ball of rough glass in a grey room under a sky that lights it from all sides."""
    board = {"type": "checkerboard", "to_uv": transform().scale(8)}
    floor = {
        "type": "rectangle",
        "to_world": transform().translate([0, -1.6, 0]).rotate([1, 0, 0], -90).scale(6),
        "bsdf": {"type": "diffuse", "reflectance": board},
    }
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 10},
        "sensor": camera([0, 0.8, 5], [0, -0.5, 0], 35, size),
        "floor": floor,
        "ball": ball(bsdf),
        "sky": {"type": "constant", "radiance": 1.0},
    }


def metals(roughness: Dict) -> list[tuple[str, Dict]]:
    """Mitsuba's metal and Specula's by sampler."""
    rows: list[tuple[str, Dict]] = [
        ("roughconductor", {"type": "roughconductor", **METAL, **roughness})
    ]
    for sampler in ("cap", "bounded", "exact"):
        given = {"type": "specula_conductor", "sampler": sampler, **METAL, **roughness}
        rows.append((f"specula_conductor, {sampler}", given))
    return rows


def glasses(roughness: Dict) -> list[tuple[str, Dict]]:
    """Mitsuba's glass and Specula's."""
    given = {"distribution": "ggx", **roughness}
    return [
        ("roughdielectric", {"type": "roughdielectric", **given}),
        ("specula_dielectric", {"type": "specula_dielectric", **given}),
    ]


def interleaved(jobs: list[Callable[[int], Any]], rounds: int) -> tuple[list[Any], list[float]]:
    """Results, (rounds, ...) each, and median seconds of jobs that take turns.

    One round more, the first, compiles kernels and does not count.
    """
    results: list[list[Any]] = [[] for _ in jobs]
    seconds: list[list[float]] = [[] for _ in jobs]
    for seed in range(rounds + 1):
        for i, job in enumerate(jobs):
            start = time.perf_counter()
            value = job(seed)
            if seed > 0:
                seconds[i].append(time.perf_counter() - start)
                results[i].append(value)
    return [np.array(r) for r in results], [float(np.median(s)) for s in seconds]


def compare_scene(
    title: str, build: Callable[[Dict, int], Dict], lobes: list[tuple[str, Dict]], options: Any
) -> None:
    """Print the rows of one scene."""

    def renderer(bsdf: Dict) -> Callable[[int], Any]:
        scene = mi.load_dict(build(bsdf, options.size))
        return lambda seed: np.array(mi.render(scene, seed=seed, spp=options.spp))

    images, seconds = interleaved([renderer(bsdf) for _, bsdf in lobes], options.rounds)
    base = 0.0
    for (name, _), image, took in zip(lobes, images, seconds, strict=True):
        variance = float(image.var(axis=0, ddof=1).mean())
        base = base or variance * took
        print(
            f"| {title} | {name} | {image.mean():.4f} | {variance:.3e} | {took:.3f} |"
            f" {variance * took / base:.2f} |",
            flush=True,
        )


def compare_gradient(alpha: float, options: Any) -> None:
    """Print the variance of the derivative of a squared error by alpha (path replay)."""
    lobes = metals({"alpha": alpha})
    tracer = mi.load_dict({"type": "prb", "max_depth": 4})
    target_scene = mi.load_dict(metal_ball(lobes[0][1] | {"alpha": 0.6 * alpha}, options.size))
    target = mi.render(target_scene, integrator=tracer, spp=8 * options.spp, seed=99)
    dr.eval(target)

    def job(bsdf: Dict) -> Callable[[int], Any]:
        scene = mi.load_dict(metal_ball(bsdf, options.size))
        parameters = mi.traverse(scene)
        key = next(k for k in parameters.keys() if k.startswith("ball") and "alpha" in k)

        def gradient(seed: int) -> Any:
            width = mi.Float(alpha)
            dr.enable_grad(width)
            parameters[key] = width
            parameters.update()
            image = mi.render(
                scene, parameters, integrator=tracer, spp=options.spp, seed=1000 * seed
            )
            dr.backward(dr.mean(dr.square(image.array - target.array)))
            return dr.grad(width)[0]

        return gradient

    values, seconds = interleaved([job(bsdf) for _, bsdf in lobes], 4 * options.rounds)
    base = 0.0
    for (name, _), value, took in zip(lobes, values, seconds, strict=True):
        base = base or value.var(ddof=1) * took
        error = value.std(ddof=1) / len(value) ** 0.5
        print(
            f"| {alpha} | {name} | {value.mean():.5f} ± {error:.5f} | {value.var(ddof=1):.3e} |"
            f" {took:.3f} | {value.var(ddof=1) * took / base:.2f} |",
            flush=True,
        )


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=64, help="pixels along an edge")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel")
    parser.add_argument("--rounds", type=int, default=8, help="renders of each candidate")
    options = parser.parse_args()
    specula.register()

    print("| scene | plugin | mean | variance per pixel | seconds | variance x time |")
    print("|---|---|---|---|---|---|")
    for roughness in ({"alpha": 0.2}, {"alpha": 0.6}, {"alpha_u": 0.15, "alpha_v": 0.6}):
        title = ", ".join(str(value) for value in roughness.values())
        compare_scene(f"metal ball, {title}", metal_ball, metals(roughness), options)
        compare_scene(f"metal room, {title}", metal_room, metals(roughness), options)
    for roughness in ({"alpha": 0.2}, {"alpha": 0.6}):
        title = f"glass ball, {roughness['alpha']}"
        compare_scene(title, glass_ball, glasses(roughness), options)

    print("\n| alpha | plugin | derivative | its variance | seconds | variance x time |")
    print("|---|---|---|---|---|---|")
    for alpha in (0.2, 0.6):
        compare_gradient(alpha, options)


if __name__ == "__main__":
    main()
