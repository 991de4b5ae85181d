"""Textures of the scenes in this folder, and their reference pictures by Mitsuba 3.

    python -m venv venv && venv/bin/pip install mitsuba==3.9.1 numpy
    venv/bin/python make.py [SCENE...]

Each reference is the mean of many samples; its `-variance` is the variance of one sample.
"""

import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
HERE = Path(__file__).parent
SAMPLES = 16384
PARTS = 128


def save(name, array, component):
    bitmap = mi.Bitmap(np.ascontiguousarray(array))
    bitmap.convert(component_format=component).write(str(HERE / name))


def save_bytes(name, array, srgb=False):
    bitmap = mi.Bitmap(np.ascontiguousarray(np.clip(array, 0, 1).astype(np.float32)))
    bitmap.convert(component_format=mi.Struct.Type.UInt8, srgb_gamma=srgb).write(str(HERE / name))


def textures():
    n = 128
    v, u = np.mgrid[0:n, 0:n] / n
    # Tiles: a smooth period of a quarter of the picture.
    height = 0.25 * (1 - np.cos(8 * np.pi * u)) * (1 - np.cos(8 * np.pi * v))
    save_bytes("textures/tiles-height.png", height[..., None])
    dx, dy = 0.35 * np.sin(8 * np.pi * u), 0.35 * np.sin(8 * np.pi * v)
    normal = np.stack([dx, dy, np.sqrt(1 - dx * dx - dy * dy)], -1)
    save_bytes("textures/tiles-normal.png", 0.5 * normal + 0.5)
    rings = 0.5 + 0.5 * np.sin(2 * np.pi * (3 * u + 0.3 * np.sin(2 * np.pi * v)))
    wood = np.stack([0.35 + 0.3 * rings, 0.2 + 0.2 * rings, 0.08 + 0.1 * rings], -1)
    save_bytes("textures/rings.png", wood, srgb=True)
    disk = ((u - 0.5) ** 2 + (v - 0.5) ** 2 < 0.16) | ((u * 8).astype(int) % 2 == 1)
    save_bytes("textures/mask.png", disk.astype(np.float32)[..., None])
    # An environment: a bright window in a dim room, smooth at all borders.
    v, u = np.mgrid[0:64, 0:128]
    u, v = (u + 0.5) / 128, (v + 0.5) / 64
    window = 6 * np.exp(-60 * ((u - 0.7) ** 2 + (v - 0.35) ** 2))
    room = 0.4 + 0.2 * np.cos(2 * np.pi * u) * np.sin(np.pi * v)
    colour = np.stack([room + window, room + 0.9 * window, 1.2 * room + 0.7 * window], -1)
    save("textures/room.exr", colour.astype(np.float32), mi.Struct.Type.Float16)


def reference(path):
    scene = mi.load_file(str(path))
    # The integrator's own moments are of XYZ: the variance is that of parts.
    path_tracer = mi.load_dict({"type": "path", "max_depth": 2})
    parts = np.array([
        np.array(mi.render(scene, integrator=path_tracer, spp=SAMPLES // PARTS, seed=seed))
        for seed in range(PARTS)
    ], dtype=np.float64)
    name = f"references/{path.stem}"
    mean = parts.mean(axis=0)
    save(f"{name}.exr", mean.astype(np.float32), mi.Struct.Type.Float32)
    variance = parts.var(axis=0, ddof=1) * (SAMPLES // PARTS)
    save(f"{name}-variance.exr", variance.astype(np.float32), mi.Struct.Type.Float32)
    print(path.stem, parts.shape, mean.mean(axis=(0, 1)), flush=True)


if __name__ == "__main__":
    textures()
    wanted = set(sys.argv[1:])
    for path in sorted(HERE.glob("*.xml")):
        if not wanted or path.stem in wanted:
            reference(path)
