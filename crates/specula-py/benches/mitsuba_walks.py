"""Variance and time of the models of multiple bounces in Mitsuba, as a table of ratios.

    PYTHONPATH=crates/specula-py/python python crates/specula-py/benches/mitsuba_walks.py [PICTURES]

A sphere of gold under a lamp and a grey environment, by Mitsuba's path integrator. All models render
in turns, so that what else the machine does hits all alike; times are of the processor. With a
folder, pictures of a ball in a white furnace and of the scene go there.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))

import llvm

llvm.find()

import mitsuba as mi

mi.set_variant("llvm_ad_rgb")

from specula_render import mitsuba as specula
from specula_render.mitsuba.multibounce import MODELS

ROUNDS, SPP, SIZE = 12, 32, 64
ALPHAS = (0.2, 0.5, 1.0)
Dict = dict[str, Any]


def scene(bsdf: Dict, size: int, lit: bool = True) -> Dict:
    """The ball; where it is not `lit`, in a white furnace."""
    look_at = mi.ScalarTransform4f().look_at
    film: Dict = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}}
    found: Dict = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 3, "hide_emitters": lit},
        "sensor": {
            "type": "perspective",
            "fov": 24,
            "to_world": look_at([0, 0, 5], [0, 0, 0], [0, 1, 0]),
            "film": film | {"pixel_format": "rgb"},
        },
        "ball": {"type": "sphere", "bsdf": bsdf},
        "sky": {"type": "constant", "radiance": 0.5},
    }
    if lit:
        lamp = {"type": "area", "radiance": {"type": "rgb", "value": [12.0, 11.0, 10.0]}}
        where = look_at([4, 3, 4], [0, 0, 0], [0, 1, 0])
        found["lamp"] = {"type": "rectangle", "to_world": where, "emitter": lamp}
    return found


def metals(alpha: float, **more: Any) -> dict[str, Dict]:
    """Mitsuba's metal, and ours by each model."""
    given = {"material": "Au"} | more | {"alpha": alpha}
    found = {"roughconductor": {"type": "roughconductor", "distribution": "ggx", **given}}
    for model in MODELS:
        found[model] = {"type": "specula_multibounce", "model": model, **given}
    return found


def measure(alpha: float) -> dict[str, tuple[float, float]]:
    """Variance of a pixel and seconds of a render, by model."""
    scenes = {name: mi.load_dict(scene(bsdf, SIZE)) for name, bsdf in metals(alpha).items()}
    pictures: dict[str, list[Any]] = {name: [] for name in scenes}
    times: dict[str, list[float]] = {name: [] for name in scenes}
    for k in range(ROUNDS + 1):
        for name, loaded in scenes.items():
            start = time.process_time()
            picture = np.array(mi.render(loaded, seed=k, spp=SPP))
            if k > 0:  # The first one compiles.
                times[name].append(time.process_time() - start)
                pictures[name].append(picture)
    return {
        name: (float(np.var(pictures[name], axis=0, ddof=1).mean()), float(np.median(times[name])))
        for name in scenes
    }


def write_pictures(folder: Path) -> None:
    """A row of balls, by model: gold, and white in a white furnace."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, lit, more in (("gold", True, {}), ("furnace", False, {"material": "none"})):
        balls = [
            np.array(mi.render(mi.load_dict(scene(bsdf, 160, lit)), spp=256))
            for bsdf in metals(0.8, **more).values()
        ]
        half = len(balls) // 2
        rows = [np.concatenate(row, axis=1) for row in (balls[:half], balls[half:])]
        mi.util.write_bitmap(str(folder / f"{name}.png"), np.concatenate(rows, axis=0))


def main() -> None:
    """Print the table."""
    specula.register()
    if len(sys.argv) > 1:
        write_pictures(Path(sys.argv[1]))
        return
    found = {alpha: measure(alpha) for alpha in ALPHAS}
    print("| | " + " | ".join(f"alpha {a}: variance, time" for a in ALPHAS) + " |")
    print("|---" * (len(ALPHAS) + 1) + "|")
    for name in found[ALPHAS[0]]:
        cells = []
        for alpha in ALPHAS:
            (variance, seconds), (least, shortest) = found[alpha][name], found[alpha]["specula"]
            cells.append(f"{variance / least:.2f}, {seconds / shortest:.2f}")
        print(f"| `{name}` | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
