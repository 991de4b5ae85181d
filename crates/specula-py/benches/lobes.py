"""Nanoseconds per element of lobes over arrays, beside NumPy and Mitsuba: a Markdown table.

Run it with the package on the path. Each figure is the least of several rounds, in which all take
their turns.
"""

from __future__ import annotations

import argparse
import subprocess
import time
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

import specula_render as sr

Array = npt.NDArray[np.float32]


def seconds(call: Callable[[], object]) -> float:
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def numpy_sample(alpha: float, f0: Array, wo: Array, u: Array) -> tuple[Array, Array, Array]:
    """Sample rough metal by spherical caps (Dupuy and Benyoub 2023), in NumPy."""
    h = wo * np.array([alpha, alpha, 1.0], np.float32)
    i = h / np.linalg.norm(h, axis=-1, keepdims=True)
    z = (1.0 - u[:, 1]) * (1.0 + i[:, 2]) - i[:, 2]
    sin = np.sqrt(np.maximum(1.0 - z * z, 0.0))
    phi = np.float32(2.0 * np.pi) * u[:, 2]
    c = np.stack([sin * np.cos(phi), sin * np.sin(phi), z], axis=-1)
    m = (c + i) * np.array([alpha, alpha, 1.0], np.float32)
    m /= np.linalg.norm(m, axis=-1, keepdims=True)
    cos = np.sum(wo * m, axis=-1, keepdims=True)
    wi = 2.0 * cos * m - wo
    a2 = np.float32(alpha * alpha)
    root = [np.sqrt(a2 + (1.0 - a2) * w[:, 2] ** 2) for w in (wo, wi)]
    d = a2 / (np.float32(np.pi) * (m[:, 2] ** 2 * (a2 - 1.0) + 1.0) ** 2)
    g1 = 2.0 * wo[:, 2] / (wo[:, 2] + root[0])
    g2 = 2.0 * wo[:, 2] * wi[:, 2] / (wo[:, 2] * root[1] + wi[:, 2] * root[0])
    fresnel = f0 + (1.0 - f0) * (1.0 - cos) ** 5
    above = wi[:, 2] > 0.0
    pdf = np.where(above, d * g1 / (4.0 * wo[:, 2]), 0.0)
    weight = np.where(above[:, None], fresnel * (g2 / g1)[:, None], 0.0)
    return wi, weight, pdf


def mitsuba_sample(n: int, wo: Array, u: Array) -> Callable[[], object] | None:
    """Return a call of Mitsuba's rough conductor over the same views, or nothing without Mitsuba."""
    try:
        import drjit as dr
        import mitsuba as mi

        mi.set_variant("llvm_ad_rgb")
    except ImportError:
        return None
    bsdf = mi.load_dict({"type": "roughconductor", "material": "Au", "alpha": 0.3})
    interaction = dr.zeros(mi.SurfaceInteraction3f, n)
    interaction.wi = mi.Vector3f(wo.T)
    first, second = mi.Float(u[:, 0]), mi.Point2f(u[:, 1:].T)
    dr.eval(interaction.wi, first, second)

    def call() -> None:
        sample, weight = bsdf.sample(mi.BSDFContext(), interaction, first, second)
        dr.eval(sample.wo, sample.pdf, weight)
        dr.sync_thread()

    call()
    return call


def rust_nanoseconds(program: str, n: int) -> dict[str, float]:
    """Return what a Rust program, `specula-bsdf`'s bench `sample_speed`, measures of its batches."""
    told = subprocess.run([program, str(n)], check=True, capture_output=True, text=True).stdout
    return {name: float(value) for name, value in map(str.split, told.splitlines())}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1 << 20, help="elements of a call")
    parser.add_argument("--rounds", type=int, default=9, help="rounds of which the least counts")
    parser.add_argument("--mitsuba", action="store_true", help="measure Mitsuba, too")
    parser.add_argument(
        "--rust", metavar="PROGRAM", help="the built bench sample_speed of specula-bsdf"
    )
    options = parser.parse_args()
    n = options.count
    rng = np.random.default_rng(1)
    z = (0.1 + 0.9 * rng.random(n)).astype(np.float32)
    phi = (2.0 * np.pi * rng.random(n)).astype(np.float32)
    r = np.sqrt(1.0 - z * z)
    wo = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1)
    u = rng.random((n, 3), dtype=np.float32)
    columns = np.ascontiguousarray(wo.T), np.ascontiguousarray(u.T)
    f0 = np.array([0.9, 0.6, 0.3], np.float32)
    calls: dict[str, Callable[[], object]] = {}
    for sampler in ("cap", "bounded", "exact"):
        lobe = sr.RoughConductor(0.3, sr.Reflectance.schlick(tuple(f0)), sampler=sampler)
        calls[f"{sampler}, (n, 3)"] = lambda lobe=lobe: lobe.sample(wo, u)
        calls[f"{sampler}, (3, n)"] = lambda lobe=lobe: lobe.sample(*columns, axis=0)
        room = lobe.sample(*columns, axis=0)
        calls[f"{sampler}, (3, n), out="] = lambda lobe=lobe, room=room: lobe.sample(
            *columns, axis=0, out=room
        )
        calls[f"{sampler}, (3, n), all threads"] = lambda lobe=lobe: lobe.sample(
            *columns, axis=0, threads=0
        )
    calls["cap, NumPy"] = lambda: numpy_sample(0.3, f0, wo, u)
    if options.mitsuba and (call := mitsuba_sample(n, wo, u)) is not None:
        calls["rough conductor, Mitsuba llvm_ad_rgb, all threads"] = call
    least = dict.fromkeys(calls, np.inf)
    for _ in range(options.rounds):
        for name, call in calls.items():
            least[name] = min(least[name], seconds(call))
        if options.rust:
            for name, value in rust_nanoseconds(options.rust, n).items():
                row = f"{name}, batches in Rust"
                least[row] = min(least.get(row, np.inf), 1e-9 * value * n)
    print(f"Level {sr.level()}, {n} elements.\n")
    print("| sample of rough metal, float32 | ns per element |\n|---|---|")
    for name, took in least.items():
        print(f"| {name} | {took / n * 1e9:.1f} |")
    one, numbers = wo[:1].copy(), u[:1].copy()
    lobe = sr.RoughConductor(0.3, "Au")
    took = min(seconds(lambda: [lobe.sample(one, numbers) for _ in range(1000)]) for _ in range(9))
    print(f"| one element: a call | {took * 1e6:.0f} |")


if __name__ == "__main__":
    main()
