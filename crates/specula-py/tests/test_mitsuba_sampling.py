"""Plugins for Mitsuba 3: samples against densities, weights, furnaces, walks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import specula_render as sr
from test_mitsuba_tools import (  # noqa: F401
    ALPHAS,
    SAMPLERS,
    WHITE,
    Dict,
    conductor,
    directions,
    dr,
    mi,
    np,
    numbers,
    render_mean,
    rgb,
    scene_of,
    surface,
    unit,
    use,
)

VIEWS = [(0.0, 0.0, 1.0), (0.8, 0.3, 0.35)]


def chi_square(
    bsdf: Dict,
    wi: tuple[float, float, float],
    count: int,
    scale: float = 1.0,
    pdf: Callable[[Any], Any] | None = None,
) -> bool:
    """Mitsuba's chi-square test of one lobe and view; `count` tests share the level of 1 %."""
    sample, density = mi.chi2.BSDFAdapter(bsdf["type"], bsdf, wi=unit(wi))
    test = mi.chi2.ChiSquareTest(
        domain=mi.chi2.SphericalDomain(),
        sample_func=sample,
        pdf_func=pdf or (lambda wo: density(wo) * scale),
        sample_dim=3,
        sample_count=200_000,
        res=101 if "dielectric" in bsdf["type"] else 61,
        ires=16,
    )
    passed = bool(test.run(significance_level=0.01, test_count=count, quiet=True))
    if not passed and scale == 1.0:
        print(test.messages)
    return passed


CHI_SQUARE: list[Dict] = [
    {"type": "specula_conductor", "sampler": sampler, **alpha}
    for sampler in SAMPLERS
    for alpha in ALPHAS
]
CHI_SQUARE += [
    {"type": "specula_conductor", "distribution": "beckmann", "alpha": 0.3},
    {"type": "specula_conductor", "distribution": "beckmann", "alpha_u": 0.2, "alpha_v": 0.5},
    {"type": "specula_conductor", "energy": "kulla_conty", "alpha": 0.6},
    {"type": "specula_conductor", "energy": "kulla_conty", "alpha_u": 0.9, "alpha_v": 0.3},
    {"type": "specula_conductor", "energy": "turquin", "alpha": 0.6},
    {
        "type": "specula_conductor",
        "energy": "kulla_conty",
        "distribution": "beckmann",
        "alpha": 0.8,
    },
]
CHI_SQUARE += [
    {"type": "specula_dielectric", **parameters}
    for parameters in (
        {"alpha": 0.3},
        {"alpha": 0.6, "sampler": "heitz"},
        {"alpha_u": 0.3, "alpha_v": 0.6, "int_ior": "diamond"},
        {"alpha": 0.4, "distribution": "beckmann"},
        {"alpha": 0.8, "energy": "kulla_conty"},
    )
]
# At the pole of the test's grid the narrow refractions along the normal would fall into one cell.
OBLIQUE = [(0.5, 0.2, 0.8), VIEWS[1]]
CASES = [
    (bsdf, view)
    for bsdf in CHI_SQUARE
    for view in (OBLIQUE if "dielectric" in bsdf["type"] else VIEWS)
]
CASES += [
    (bsdf, (view[0], view[1], -view[2]))
    for bsdf, view in CASES
    if bsdf["type"] == "specula_dielectric"
]


@pytest.mark.parametrize("case", range(len(CASES)))
def test_samples_follow_their_density(case: int) -> None:
    bsdf, view = CASES[case]
    assert chi_square(bsdf, view, len(CASES)), f"{bsdf} {view}"


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_chi_square_catches_a_density_five_percent_off(sampler: str) -> None:
    bsdf = {"type": "specula_conductor", "alpha": 0.5, "sampler": sampler}
    assert not chi_square(bsdf, VIEWS[1], 1, scale=1.05)


def test_walks_follow_the_expectation_of_their_evaluation() -> None:
    bsdf: Dict = {"type": "specula_multibounce", "alpha_u": 0.9, "alpha_v": 0.5, **WHITE}
    plugin = mi.load_dict(bsdf)

    def expected(wo: Any) -> Any:
        si = surface(unit(VIEWS[1]), dr.width(wo))
        total = mi.Float(0)
        for i in range(16):
            si.p = mi.Point3f(float(i), 0, 0)
            total += plugin.eval(mi.BSDFContext(), si, wo).x
            dr.eval(total)
        return total / 16

    assert chi_square(bsdf, VIEWS[1], 1, pdf=expected)
    assert not chi_square(bsdf, VIEWS[1], 1, scale=1.05, pdf=lambda wo: 1.05 * expected(wo))


@pytest.mark.parametrize("cosine", [0.5, -0.5])
def test_walks_through_glass_follow_the_expectation_of_their_evaluation(cosine: float) -> None:
    bsdf: Dict = {"type": "specula_multibounce_dielectric", "alpha_u": 0.9, "alpha_v": 0.5}
    plugin = mi.load_dict(bsdf)
    view = (0.8, 0.3, cosine)
    # As importance: radiance is compressed, so that its values are no density.
    ctx = mi.BSDFContext(mi.TransportMode.Importance)

    def expected(wo: Any) -> Any:
        si = surface(unit(view), dr.width(wo))
        total = mi.Float(0)
        for i in range(6):
            si.p = mi.Point3f(float(i), 0, 0)
            total += plugin.eval(ctx, si, wo).x
            dr.eval(total)
        return total / 6

    assert chi_square(bsdf, view, 2, pdf=expected)
    assert not chi_square(bsdf, view, 1, scale=1.05, pdf=lambda wo: 1.05 * expected(wo))


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "scalar_rgb"])
def test_walks_through_glass_are_those_of_the_library(variant: str) -> None:
    """Nothing is lost; shares of the branches, the density and mean values agree."""
    use(variant)
    is_scalar = variant.startswith("scalar")
    for alpha, cosine in ((0.3, 0.8), (1.0, 0.3), (0.6, -0.4), (1.0, -0.9)):
        bsdf = {"type": "specula_multibounce_dielectric", "alpha": alpha, "int_ior": 1.5}
        plugin = mi.load_dict({**bsdf, "ext_ior": 1.0})
        library = sr.MultibounceDielectric(alpha, 1.5, model="heitz")
        view = [(1 - cosine * cosine) ** 0.5, 0.0, cosine]
        ctx = mi.BSDFContext(mi.TransportMode.Importance)
        if is_scalar:
            si = mi.SurfaceInteraction3f()
            si.wi = mi.Vector3f(*view)
            points = [mi.Point2f(0.2, 0.1 * i) for i in range(9)]
            weights = [plugin.sample(ctx, si, 0.37, u)[1][0] for u in points]
            assert weights == [pytest.approx(1.0)] * 9
            wo = unit((0.3, -0.5, 0.6))
            density = plugin.pdf(ctx, si, mi.Vector3f(*wo))
            expected = float(library.pdf(np.array(view), np.array(wo)))
            assert density == pytest.approx(expected, rel=1e-3)
            assert plugin.eval(ctx, si, mi.Vector3f(*wo))[0] >= 0
            continue
        n = 200_000
        si = surface(view, n)
        sampled, weight = plugin.sample(ctx, si, *numbers(n, 3))
        assert np.array(weight.x).mean() == pytest.approx(1.0, abs=1e-4)
        reflected = float((np.array(sampled.sampled_component) == 0).mean())
        views = np.broadcast_to(np.array(view, np.float32), (n, 3)).copy()
        found = library.sample(views, seed=5, transport="importance")
        own = float((found.wi[:, 2] * cosine > 0).mean())
        assert abs(reflected - own) < 5 * (2 * own * (1 - own) / n) ** 0.5
        wo = np.array(directions(n, 8, True))
        density = np.array(plugin.pdf(ctx, si, mi.Vector3f(wo)))
        expected = library.pdf(np.array(view, np.float32), wo, axis=0)
        np.testing.assert_allclose(density, expected, rtol=2e-3, atol=1e-5)
        assert abs(4 * np.pi * density.mean() - 1) < 4 * 4 * np.pi * density.std() / n**0.5
        values = [
            np.array(plugin.eval(ctx, si, mi.Vector3f(wo)).x),
            library.eval(np.array(view, np.float32), wo, axis=0, transport="importance")[0],
        ]
        for side in (wo[2] > 0, wo[2] < 0):
            a, b = (4 * np.pi * v * side for v in values)
            assert abs(a.mean() - b.mean()) < 5 * (a.std() + b.std()) / n**0.5


LOBES: list[Dict] = [
    {"type": "specula_conductor", "material": "Cu", "alpha": 0.4, "energy": energy, **masking}
    for energy in ("none", "turquin", "kulla_conty")
    for masking in ({"masking": "separable"}, {"masking": "height_correlated"})
]
LOBES += [
    {"type": "specula_conductor", "material": "Cu", "alpha_u": 0.1, "alpha_v": 0.8},
    {"type": "specula_dielectric", "alpha": 0.4},
]


@pytest.mark.parametrize("bsdf", LOBES, ids=str)
def test_weight_is_value_by_density(bsdf: Dict) -> None:
    n = 20_000
    plugin, ctx = mi.load_dict(bsdf), mi.BSDFContext()
    si = surface(directions(n, 5, bsdf["type"] == "specula_dielectric"))
    sampled, weight = plugin.sample(ctx, si, *numbers(n, 6))
    value, pdf = plugin.eval_pdf(ctx, si, sampled.wo)
    weight, value, pdf = np.array(weight), np.array(value), np.array(pdf)
    ok = np.array(sampled.pdf) > 0
    assert ok.mean() > 0.8
    assert (weight[:, ~ok] == 0).all()
    np.testing.assert_allclose(weight[:, ok] * pdf[ok], value[:, ok], rtol=1e-4, atol=1e-6)
    np.testing.assert_allclose(np.array(sampled.pdf)[ok], pdf[ok], rtol=1e-4)
    np.testing.assert_allclose(np.array(plugin.pdf(ctx, si, sampled.wo)), pdf, rtol=1e-4)
    np.testing.assert_allclose(np.array(plugin.eval(ctx, si, sampled.wo)), value, rtol=1e-4)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("energy", ["none", "kulla_conty"])
def test_branches_of_glass_add_up(energy: str, side: int) -> None:
    """A context that asks for one branch gets all of it, and only it."""
    n = 100_000
    plugin = mi.load_dict({"type": "specula_dielectric", "alpha": 0.4, "energy": energy})
    si = surface(unit((0.6, 0.0, 0.8 * side)), n)
    means = []
    for component in (0, 1, 0xFFFFFFFF):
        ctx = mi.BSDFContext()
        ctx.component = component
        sampled, weight = plugin.sample(ctx, si, *numbers(n, 15))
        means.append(float(np.array(weight.x).mean()))
        kept = np.array(sampled.sampled_component)[np.array(weight.x) > 0]
        assert set(np.unique(kept)) == ({component} if component < 2 else {0, 1})
    assert means[0] + means[1] == pytest.approx(means[2], rel=5e-3)


EXTREMES: list[Dict] = [
    {"type": kind, **alpha, **more}
    for alpha in ({"alpha": 0.0}, {"alpha": 1e-3}, {"alpha_u": 1e-3, "alpha_v": 3.0})
    for kind, more in (
        *(("specula_conductor", {"sampler": sampler}) for sampler in SAMPLERS),
        ("specula_conductor", {"energy": "kulla_conty", "material": "Cu"}),
        ("specula_conductor", {"distribution": "beckmann", "material": "Cu"}),
        ("specula_dielectric", {}),
        ("specula_dielectric", {"energy": "kulla_conty"}),
        ("specula_multibounce", {"material": "Cu"}),
        ("specula_multibounce_dielectric", {}),
    )
]


@pytest.mark.parametrize("bsdf", EXTREMES, ids=str)
def test_extreme_alphas_and_views_stay_finite(bsdf: Dict) -> None:
    n = 30_000
    plugin, ctx = mi.load_dict(bsdf), mi.BSDFContext()
    wi = directions(n, 13, True)
    lane = dr.arange(mi.UInt32, n)
    wi.z = dr.select(lane % 3 == 0, wi.z * 1e-6, wi.z)
    wi = dr.select(lane % 3 == 1, mi.Vector3f(0, 0, 1), dr.normalize(wi))
    si = surface(wi)
    sampled, weight = plugin.sample(ctx, si, *numbers(n, 14))
    value, pdf = plugin.eval_pdf(ctx, si, sampled.wo)
    for array in (sampled.wo, sampled.pdf, weight, value, pdf):
        assert np.isfinite(np.array(array)).all()
    assert np.array(weight).min() >= 0
    # Kulla and Conty's second lobe is sampled by the cosine, which knows nothing of its loss: that
    # of narrow lobes is near the horizon alone, and the rare sample there counts much.
    if "energy" not in bsdf or "conductor" in bsdf["type"]:
        assert np.array(weight).max() < (20 if "energy" in bsdf else 4)
    length = np.linalg.norm(np.array(sampled.wo), axis=0)
    assert np.abs(length[np.array(sampled.pdf) > 0] - 1).max() < 1e-3


def test_the_exact_sampler_rejects_nothing() -> None:
    n = 1_000_000
    for alpha in (*ALPHAS, {"alpha_u": 0.02, "alpha_v": 1.4}, {"alpha": 1.5}):
        sampled, weight = conductor(**alpha).sample(
            mi.BSDFContext(), surface(directions(n, 7)), *numbers(n, 8)
        )
        rejected = np.mean(np.array(weight.x) == 0)
        assert rejected < 2e-5, f"{alpha}: {rejected}"
        assert np.array(weight.x).max() <= 1 + 1e-3


def mean_weight(bsdf: Dict, cosine: float, n: int, seed: int = 9) -> tuple[float, float]:
    """Mean of a lobe's weights, and its standard error."""
    si = surface([(1 - cosine * cosine) ** 0.5, 0.0, cosine], n)
    weight = np.array(mi.load_dict(bsdf).sample(mi.BSDFContext(), si, *numbers(n, seed))[1].x)
    return float(weight.mean()), float(weight.std() / n**0.5)


@pytest.mark.parametrize("masking", ["separable", "height_correlated"])
@pytest.mark.parametrize("energy", ["turquin", "kulla_conty"])
def test_compensated_white_metal_loses_less_than_a_percent(energy: str, masking: str) -> None:
    for alpha in (0.05, 0.2, 0.5, 1.0):
        for cosine in (1.0, 0.6, 0.2, 0.05):
            bsdf = {"type": "specula_conductor", "alpha": alpha, "energy": energy, **WHITE}
            mean, error = mean_weight(bsdf | {"masking": masking}, cosine, 100_000)
            assert abs(mean - 1) < 0.01 + 3 * error, f"alpha {alpha}, cosine {cosine}: {mean}"
    lost, _ = mean_weight({"type": "specula_conductor", "alpha": 1.0, **WHITE}, 0.6, 10_000)
    assert lost < 0.7


def test_white_walks_lose_nothing() -> None:
    for alpha in ({"alpha": 0.3}, {"alpha": 1.0}, {"alpha_u": 0.2, "alpha_v": 0.9}):
        for cosine in (1.0, 0.5, 0.1):
            bsdf = {"type": "specula_multibounce", **alpha, **WHITE}
            mean, _ = mean_weight(bsdf, cosine, 100_000)
            assert abs(mean - 1) < 1e-4, f"{alpha}, cosine {cosine}: {mean}"


@pytest.mark.parametrize("alpha", [{"alpha": 0.7}, {"alpha_u": 0.3, "alpha_v": 0.9}], ids=str)
def test_values_of_walks_integrate_to_their_weights(alpha: Dict) -> None:
    n = 400_000
    bsdf: Dict = {"type": "specula_multibounce", "eta": 1.2, "k": 2.0, **alpha}
    plugin, ctx, si = mi.load_dict(bsdf), mi.BSDFContext(), surface(unit((0.6, 0.2, 0.6)), n)
    _, u = numbers(n, 10)
    wo = mi.warp.square_to_uniform_hemisphere(u)
    value, pdf = plugin.eval_pdf(ctx, si, wo)
    value, pdf = 2 * np.pi * np.array(value.x), 2 * np.pi * np.array(pdf)
    weight = np.array(plugin.sample(ctx, si, *numbers(n, 11))[1].x)
    error = (value.std() + weight.std()) / n**0.5
    assert abs(value.mean() - weight.mean()) < 4 * error
    assert abs(pdf.mean() - 1) < 4 * pdf.std() / n**0.5


@pytest.mark.parametrize(
    "variant", ["llvm_ad_rgb", "llvm_ad_spectral", "llvm_ad_mono", "scalar_rgb"]
)
@pytest.mark.parametrize(
    "bsdf",
    [
        {"type": "specula_multibounce"},
        {"type": "specula_conductor", "energy": "kulla_conty"},
        {"type": "specula_conductor", "energy": "turquin"},
    ],
    ids=str,
)
def test_white_metal_is_invisible_under_a_white_sky(bsdf: Dict, variant: str) -> None:
    """Value, density and sample together: the sky is sampled too, and both are weighted."""
    use(variant)
    small = variant.startswith("scalar")
    scene = scene_of({**bsdf, "alpha": 0.8, **WHITE}, 6 if small else 16)
    scene.pop("lamp")
    scene["sky"]["radiance"] = {"type": "rgb", "value": 1.0}
    mean, error = render_mean(scene, 16 if small else 128)
    least = 1e-3 if "multibounce" in bsdf["type"] else 0.01
    assert (np.abs(mean - 1) < 5 * error + least).all(), mean
