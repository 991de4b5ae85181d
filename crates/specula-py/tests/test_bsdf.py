"""Lobes over arrays: shapes, precisions, layouts, threads, errors, and their own mathematics."""

from __future__ import annotations

import os
import threading
import time
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import specula_render as sr
from conftest import LOBES, directions

N = 2000


def u_of(count: int, seed: int = 2) -> np.ndarray:
    return np.random.default_rng(seed).random((count, 3))


def test_shapes_and_types(lobe: sr.Bsdf) -> None:
    wo, wi = directions(24), directions(24, seed=3)
    for dtype in (np.float32, np.float64):
        a, b = wo.astype(dtype), wi.astype(dtype)
        f_cos, pdf = lobe.eval_pdf(a, b)
        assert f_cos.shape == (24, 3) and pdf.shape == (24,)
        assert f_cos.dtype == pdf.dtype == dtype
        grid = lobe.pdf(a.reshape(2, 3, 4, 3), b.reshape(2, 3, 4, 3))
        assert np.array_equal(grid.ravel(), lobe.pdf(a, b))
        samples = lobe.sample(a, u_of(24).astype(dtype))
        assert samples.wi.shape == samples.weight.shape == (24, 3)
        assert samples.pdf.shape == samples.outcome.shape == (24,)
        assert samples.outcome.dtype == np.uint8
    # One element, as lists.
    assert lobe.eval([0.6, 0.0, 0.8], [0.0, 0.6, 0.8]).shape == (3,)
    assert np.ndim(lobe.pdf([0.6, 0.0, 0.8], [0.0, 0.6, 0.8])) == 0
    empty = np.empty((0, 3))
    assert lobe.eval(empty, empty).shape == (0, 3)


def test_axes_agree_without_copies(lobe: sr.Bsdf) -> None:
    wo, wi, u = directions(N), directions(N, seed=3), u_of(N)
    rows, columns = lobe.eval(wo, wi, seed=5), lobe.eval(wo.T.copy(), wi.T.copy(), axis=0, seed=5)
    assert np.array_equal(rows, columns.T)
    a, b = lobe.sample(wo, u, seed=5), lobe.sample(wo.T.copy(), u.T.copy(), axis=0, seed=5)
    assert np.array_equal(a.wi, b.wi.T) and np.array_equal(a.weight, b.weight.T)
    assert np.array_equal(a.pdf, b.pdf) and np.array_equal(a.outcome, b.outcome)


def test_threads_layouts_and_places_do_not_matter(lobe: sr.Bsdf) -> None:
    wo, wi, u = directions(N), directions(N, seed=3), u_of(N)
    f_cos = lobe.eval(wo, wi, seed=9)
    assert np.array_equal(f_cos, lobe.eval(wo, wi, seed=9, threads=0))
    assert np.array_equal(f_cos, lobe.eval(wo, wi, seed=9, threads=3))
    strided = np.zeros((N, 6))
    strided[:, ::2] = wo
    assert np.array_equal(f_cos, lobe.eval(strided[:, ::2], wi, seed=9))
    out = np.full((N, 3), np.nan)
    assert lobe.eval(wo, wi, seed=9, out=out) is out
    assert np.array_equal(f_cos, out)
    samples = lobe.sample(wo, u, seed=9)
    again = lobe.sample(wo, u, seed=9, threads=0)
    assert np.array_equal(samples.wi, again.wi) and np.array_equal(samples.pdf, again.pdf)
    wi_before = again.wi
    filled = lobe.sample(wo, u_of(N, seed=5), seed=9, out=again)
    assert filled.wi is wi_before
    assert np.array_equal(filled.wi, lobe.sample(wo, u_of(N, seed=5), seed=9).wi)
    one = lobe.eval(wo[0], wi, seed=9)
    assert np.array_equal(one, lobe.eval(np.tile(wo[0], (N, 1)), wi, seed=9))


def test_eval_and_pdf_together_are_each_alone(lobe: sr.Bsdf) -> None:
    wo, wi = directions(N), directions(N, seed=3, both_sides=True)
    f_cos, pdf = lobe.eval_pdf(wo, wi, seed=4)
    # Kernels fuse products and sums in other places.
    assert np.allclose(f_cos, lobe.eval(wo, wi, seed=4), rtol=1e-9, atol=1e-12)
    assert np.allclose(pdf, lobe.pdf(wo, wi), rtol=1e-9, atol=1e-12)
    assert np.isfinite(f_cos).all() and (f_cos >= 0).all() and (pdf >= 0).all()


def test_weights_are_values_over_densities(lobe: sr.Bsdf) -> None:
    wo = directions(N, least=0.1)
    samples = lobe.sample(wo, u_of(N), seed=4)
    smooth = (samples.outcome == 1) | (samples.outcome == 2)
    kept = smooth & (samples.pdf > 0)
    wi = samples.wi[kept]
    assert np.allclose(np.linalg.norm(wi, axis=-1), 1.0, atol=1e-9)
    assert np.allclose(samples.pdf[kept], lobe.pdf(wo[kept], wi), rtol=1e-4, atol=1e-9)
    if lobe.is_stochastic or not kept.any():
        return
    f_cos = lobe.eval(wo[kept], wi)
    assert np.allclose(samples.weight[kept] * samples.pdf[kept, None], f_cos, rtol=1e-4)
    rejected = samples.outcome == 0
    assert (samples.wi[rejected] == 0).all() and (samples.weight[rejected] == 0).all()


@pytest.mark.parametrize("name", ["gold exact", "glass", "coated", "gltf", "principled"])
def test_single_precision_agrees_with_double(name: str) -> None:
    lobe = LOBES[name]
    wo, wi = directions(N, least=0.05), directions(N, seed=3, least=0.05)
    single = lobe.eval(wo.astype(np.float32), wi.astype(np.float32))
    double = lobe.eval(wo, wi)
    assert np.allclose(single, double, rtol=2e-3, atol=1e-5)
    # Not the same: each precision computes in its own.
    assert not np.array_equal(single.astype(np.float64), double)


def test_values_are_those_of_rust() -> None:
    path = os.environ.get("SPECULA_VALUES")
    if path is None:
        pytest.skip("no values of Rust (cargo xtask python makes them)")
    rows: dict[str, list[list[float]]] = {}
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        name, *numbers = line.split("\t")
        rows.setdefault(name, []).append([float(x) for x in numbers])
    assert len(rows) > 12
    for name, listed in rows.items():
        table, lobe = np.array(listed), LOBES[name]
        wo, wi, f_cos, pdf = table[:, :3], table[:, 3:6], table[:, 6:9], table[:, 9]
        # Vector instructions fuse products and sums.
        near = {"rtol": 1e-9, "atol": 1e-12}
        assert np.allclose(lobe.eval(wo, wi), f_cos, **near), name
        assert np.allclose(lobe.pdf(wo, wi), pdf, **near), name
        samples = lobe.sample(wo, [0.3, 0.6, 0.2])
        assert np.allclose(samples.wi, table[:, 10:13], rtol=1e-7, atol=1e-9), name
        assert np.allclose(samples.weight, table[:, 13:16], rtol=1e-7, atol=1e-9), name
        assert np.allclose(samples.pdf, table[:, 16], rtol=1e-7, atol=1e-9), name
        # One element at a time.
        for i in range(5):
            assert np.allclose(lobe.eval(wo[i], wi[i]), f_cos[i], **near), name


def test_white_furnace() -> None:
    view = [0.6, 0.0, 0.8]
    for lobe, expected, within in [
        (sr.Lambert(1.0), 1.0, 1e-12),
        (sr.MultibounceConductor(0.8, 1.0), 1.0, 2e-3),
        (sr.RoughConductor(0.8, 1.0, energy="turquin"), 1.0, 5e-3),
        (sr.RoughConductor(0.8, 1.0, energy="kulla-conty"), 1.0, 2e-2),
        (sr.SmoothDielectric(1.5), 1.0 / 1.5**2 + (1 - 1.0 / 1.5**2) * 0.0428, 0.02),
    ]:
        got = sr.albedo(lobe, view, samples=8192)
        assert np.allclose(got, expected, atol=within), (lobe, got)
    # Single scattering loses light, and gold is not white.
    assert sr.albedo(sr.RoughConductor(0.8, 1.0), view)[1] < 0.87
    # Compensation restores energy, not colour: gold's green by simulated bounces and by Turquin.
    green = {
        name: sr.albedo(lobe, [0.0, 0.0, 1.0], samples=1 << 15)[1]
        for name, lobe in {
            "specula": sr.MultibounceConductor(1.0, "Au"),
            "heitz": sr.MultibounceConductor(1.0, "Au", model="heitz"),
            "turquin": sr.RoughConductor(1.0, "Au", energy="turquin"),
        }.items()
    }
    assert abs(green["specula"] - 0.533) < 0.004 and abs(green["heitz"] - 0.533) < 0.004
    assert abs(green["turquin"] - 0.591) < 0.004


def test_distributions() -> None:
    wm = directions(200_000, least=0.0)
    for ndf in (sr.Ggx((0.2, 0.6)), sr.Beckmann((0.3, 0.6))):
        # Uniform over the hemisphere: the mean of D cos times its solid angle is 1.
        assert abs(np.mean(ndf.d(wm) * wm[:, 2]) * 2 * np.pi - 1) < 0.03
        wo = np.array([0.48, 0.36, 0.8])
        assert np.allclose(ndf.g1(wo), 1 / (1 + ndf.lambda_(wo)))
        correlated, separable = ndf.g2(wo, wm[:9]), ndf.g2(wo, wm[:9], masking="separable")
        assert (correlated >= separable).all()
        normals = ndf.sample_wm(wo, u_of(1000))
        assert np.allclose(np.linalg.norm(normals, axis=-1), 1)
        assert (ndf.d_visible(wo, normals) > 0).all()
    ggx = sr.Ggx(0.3)
    for sampler in ("heitz", "cap", "bounded", "exact"):
        wi = ggx.sample_reflection([0.6, 0.0, 0.8], u_of(5000), sampler=sampler)
        kept = wi[:, 2] > 0
        assert kept.all() == (sampler == "exact")
        pdf = ggx.reflection_pdf([0.6, 0.0, 0.8], wi[kept], sampler=sampler)
        assert (pdf > 0).all()


def test_reflectances() -> None:
    assert np.allclose(sr.dielectric(1.0, 1.5), 0.04)
    # Beyond the critical angle from inside.
    assert sr.dielectric(-0.5, 1.5) == 1.0
    gold = sr.Reflectance.metal("Au")
    measured = next(m for m in sr.metals() if m["symbol"] == "Au")
    assert np.allclose(gold.eval(1.0), measured["f0"])
    assert gold.eval(np.linspace(0, 1, 5, dtype=np.float32)).dtype == np.float32
    tinted = gold.tinted((1.0, 0.5, 0.25))
    assert np.allclose(tinted.eval(0.7), gold.eval(0.7) * [1.0, 0.5, 0.25])
    assert "conductor" in repr(gold) and "tinted" in repr(tinted)


def test_a_generator_and_seeds() -> None:
    lobe, wo = LOBES["gold exact"], directions(100)
    a = lobe.sample(wo, rng=np.random.default_rng(7))
    b = lobe.sample(wo, seed=7)
    assert np.array_equal(a.wi, b.wi)
    wi, weight, pdf, outcome = lobe.sample(wo, seed=8)
    assert not np.array_equal(wi, a.wi)
    assert weight.shape == wi.shape and (pdf > 0).all() and (outcome == 1).all()


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda w: LOBES["glass"].eval(w * 2, w), ValueError, r"wo\[0\]: expected a unit vector"),
        (lambda w: LOBES["glass"].pdf(w, w[:, :2]), ValueError, r"wi: expected vectors of shape"),
        (lambda w: LOBES["glass"].eval(w, w[:3]), ValueError, "elements of shape"),
        (lambda w: LOBES["glass"].sample(w, w + 1), ValueError, r"u\[0\]: expected numbers in"),
        (lambda w: LOBES["glass"].eval(w, w, axis=1), ValueError, "axis: expected -1"),
        (lambda w: LOBES["glass"].eval(w, w, transport="x"), ValueError, "no such transport"),
        (lambda w: LOBES["glass"].eval(w.astype(int), w), TypeError, "float32 or float64"),
        (lambda w: LOBES["glass"].eval(w, w, out=np.zeros(3)), ValueError, "out: expected"),
        (lambda w: sr.RoughConductor(0.0), ValueError, "alpha"),
        (lambda w: sr.RoughConductor(0.3, "Unobtainium"), ValueError, "no such metal"),
        (lambda w: sr.RoughConductor(0.3, 1.5), ValueError, r"in \[0, 1\]"),
        (lambda w: sr.RoughConductor(0.3, sampler="best"), ValueError, "no such sampler"),
        (
            lambda w: sr.RoughConductor(0.3, sampler="cap", distribution="beckmann"),
            ValueError,
            "is of GGX",
        ),
        (lambda w: sr.MultibounceDielectric(0.3, model="wang"), ValueError, "is of metals"),
        (lambda w: sr.Layered(0.3), ValueError, "one of the two"),
        (lambda w: sr.Ggx(0.3).sample_wm(w, w, sampler="exact"), ValueError, "not normals"),
        (lambda w: sr.Reflectance.metal("Au").eval(2.0), ValueError, r"cos\[0\]"),
        (lambda w: sr.albedo(sr.Lambert(), w, samples=0), ValueError, "1 or more"),
    ],
)
def test_errors_tell_what_was_expected(call, error, words) -> None:
    with pytest.raises(error, match=words):
        call(directions(5))


def test_the_first_bad_element_is_named() -> None:
    wo = directions(10_000)
    wo[7777] = np.nan
    for threads in (1, 4):
        with pytest.raises(ValueError, match=r"wo\[7777\]"):
            LOBES["gold exact"].eval(wo, directions(10_000), threads=threads)


class Lent:
    """An array of another library, by DLPack alone."""

    def __init__(self, array: np.ndarray) -> None:
        self.array = array

    def __dlpack__(self, **options: object) -> object:
        return self.array.__dlpack__(**options)

    def __dlpack_device__(self) -> tuple[int, int]:
        return self.array.__dlpack_device__()


def test_arrays_of_other_libraries() -> None:
    lobe, wo, wi = LOBES["gold exact"], directions(100), directions(100, seed=3)
    assert np.array_equal(lobe.eval(Lent(wo), Lent(wi)), lobe.eval(wo, wi))


def test_nothing_leaks() -> None:
    lobe, wo, u = LOBES["gold exact"], directions(16), u_of(16)
    for _ in range(1000):
        lobe.sample(wo, u)
    tracemalloc.start()
    before, _ = tracemalloc.get_traced_memory()
    for _ in range(100_000):
        lobe.sample(wo, u)
    after, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert after - before < 100_000


def test_the_interpreter_is_free_while_it_computes() -> None:
    lobe = LOBES["coated"]
    wo, wi = directions(400_000), directions(400_000, seed=3)
    counted = 0
    done = threading.Event()

    def work() -> None:
        lobe.eval(wo, wi)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 3


def test_numbers_that_nobody_reads_are_not_looked_at() -> None:
    """One lobe has no choice to make: the first number says nothing, and costs nothing."""
    wo, u = np.array([[0.6, 0.0, 0.8]] * 600), u_of(600)
    for lobe in (sr.RoughConductor(0.3, "Au"), sr.RoughConductor(0.3, distribution="beckmann")):
        expected = lobe.sample(wo, u)
        other = u.copy()
        other[:, 0] = np.nan
        np.testing.assert_array_equal(lobe.sample(wo, other).wi, expected.wi)
        other[17, 2] = 1.0
        with pytest.raises(ValueError, match=r"u\[17\]"):
            lobe.sample(wo, other)
    u[17, 0] = np.nan
    with pytest.raises(ValueError, match=r"u\[17\]"):
        sr.RoughDielectric(0.3).sample(wo, u)
