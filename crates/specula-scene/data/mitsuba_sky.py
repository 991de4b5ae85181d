"""Irradiances of Mitsuba's sky and sun, as src/mitsuba/sky_table.rs has them.

Needs `pip install mitsuba==3.9.1 numpy`; prints the table: `python3 mitsuba_sky.py > table`.
Ground irradiance of the sky is a sum over 20,000 directions of a spiral (error below 0.5 %); the
sun's is its radiance times its solid angle, on a surface that faces it.
"""
import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
TURBIDITY = [1, 2, 3, 4, 6, 8, 10]
ZENITH_DEG = [0, 15, 30, 45, 60, 70, 80, 85, 89]
DIRECTIONS = 20_000
SOLID_ANGLE = 2 * np.pi * (1 - np.cos(np.radians(0.5338 / 2)))


def emitter(turbidity, zenith, sun, sky):
    direction = [float(np.sin(zenith)), 0.0, float(np.cos(zenith))]
    return direction, mi.load_dict(
        {
            "type": "sunsky",
            "turbidity": float(turbidity),
            "albedo": 0.3,
            "sun_direction": direction,
            "sun_scale": sun,
            "sky_scale": sky,
        }
    )


def radiance(light, direction):
    si = mi.SurfaceInteraction3f()
    si.wi = -mi.Vector3f(*direction)
    return np.array(light.eval(si))


def spiral():
    i = np.arange(DIRECTIONS) + 0.5
    z = i / DIRECTIONS
    phi = i * np.pi * (3 - np.sqrt(5))
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1)


for turbidity in TURBIDITY:
    print("    [")
    for degrees in ZENITH_DEG:
        zenith = np.radians(degrees)
        _, light = emitter(turbidity, zenith, 0.0, 1.0)
        sky = sum(radiance(light, d.tolist()) * d[2] for d in spiral())
        sky = np.maximum(sky * 2 * np.pi / DIRECTIONS, 1e-6)
        direction, light = emitter(turbidity, zenith, 1.0, 0.0)
        sun = np.maximum(radiance(light, direction) * SOLID_ANGLE, 1e-6)
        row = ", ".join(f"{x:.4f}" if x >= 1e-4 else f"{x:.6f}" for x in [*sky, *sun])
        print(f"        [{row}],")
    print("    ],")
