"""Plugins for Mitsuba 3: every model of multiple bounces against the library's own, and in renders."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import pytest

import specula_render as sr
from test_mitsuba_tools import (  # noqa: F401
    WHITE,
    Dict,
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

MODELS = ["specula", "heitz", "bitterli", "wang", "wang-uncorrelated", "cui", "cui-bidirectional"]
#: Whose mean is that of Heitz 2016.
UNBIASED = [model for model in MODELS if "wang" not in model]
GLASS = ["specula", "heitz"]
#: Those that no other test here is for.
VARIANTS = [v for v in mi.variants() if "polarized" not in v and v != "llvm_ad_rgb"]
#: Gold's index in red, green and blue: no two channels alike.
ETA, K = (0.143, 0.375, 1.442), (3.983, 2.386, 1.603)
ALPHAS: list[Any] = [0.4, 1.0, (0.9, 0.3)]
LIBRARY_COUNT = 150_000
Vector = tuple[float, float, float]
PAIRS: list[tuple[Vector, Vector]] = [
    ((0.6, 0.0, 0.8), (-0.3, 0.5, 0.6)),
    ((0.95, 0.1, 0.2), (0.8, -0.2, 0.5)),
    ((0.1, -0.3, 1.0), (0.3, 0.2, 1.0)),
    ((0.2, 0.7, 0.4), (-0.9, -0.3, 0.1)),
]


def colour(value: tuple[float, ...]) -> Dict:
    return {"type": "rgb", "value": list(value)}


def metal(model: str, alpha: Any = 0.7, **more: Any) -> Dict:
    """Gold, unless another index is given."""
    widths = {"alpha": alpha}
    if isinstance(alpha, tuple):
        widths = {"alpha_u": alpha[0], "alpha_v": alpha[1]}
    gold = {"eta": colour(ETA), "k": colour(K)}
    return {"type": "specula_multibounce", "model": model, **widths, **(gold | more)}


def seen(view: Any, n: int) -> Any:
    """Points seen from `view`, another of which is no other kernel."""
    si = surface(unit(view), n)
    dr.make_opaque(si)
    return si


def estimates(
    bsdf: Dict, wi: Vector, wo: Vector, n: int, importance: bool = False, seed: int = 0
) -> Any:
    """Values of one pair of directions by `n` random numbers, (channels, n)."""
    mode = mi.TransportMode.Importance if importance else mi.TransportMode.Radiance
    si, wo = seen(wi, n), mi.Vector3f(unit(wo))
    si.p = mi.Point3f(dr.arange(mi.Float, n), float(seed), 0)
    dr.make_opaque(wo)
    return np.array(mi.load_dict(bsdf).eval(mi.BSDFContext(mode), si, wo))


@lru_cache
def library_estimates(
    model: str, alpha: Any, wi: Vector, wo: Vector, index: Any = (ETA, K)
) -> tuple[Any, Any]:
    """Mean of the library's estimates, and its standard error, by channel."""
    n = LIBRARY_COUNT
    reflectance = sr.Reflectance.conductor(*index)
    lobe = sr.MultibounceConductor(alpha, reflectance, model=model)  # type: ignore[arg-type]
    views = np.tile(unit(wi), (n, 1)), np.tile(unit(wo), (n, 1))
    found = lobe.eval(*views, seed=3)
    return found.mean(0), found.std(0) / n**0.5


def of_library(model: str) -> str:
    """The library's model of the same mean and the least variance."""
    return "specula" if model in UNBIASED else model


def scores(found: Any, mean: Any, error: Any) -> Any:
    """By how many standard errors the mean of `found` differs, by channel."""
    ours = found.std(-1) / found.shape[-1] ** 0.5
    return (found.mean(-1) - mean) / np.hypot(ours, error)


@pytest.mark.parametrize("model", MODELS)
def test_values_are_those_of_the_library(model: str) -> None:
    """In every channel: gold has no two alike, so that exchanged ones are noticed."""
    found = []
    for alpha in ALPHAS:
        for pair in PAIRS:
            mean, error = library_estimates(of_library(model), alpha, *pair)
            found.append(scores(estimates(metal(model, alpha), *pair, 60_000), mean, error))
            assert np.abs(found[-1]).max() < 4.5, f"alpha {alpha}, {pair}: {found[-1]}"
    together = np.sum(found, 0) / len(found) ** 0.5
    assert np.abs(together).max() < 4, f"all pairs: {together}"


@pytest.mark.parametrize("model", MODELS)
def test_noise_is_that_of_the_library(model: str) -> None:
    """Weights between strategies, and roulette, change no mean."""
    n, (alpha, pair) = 200_000, (1.0, PAIRS[1])
    _, error = library_estimates(model, alpha, *pair)
    ratio = estimates(metal(model, alpha), *pair, n).std(-1) / (error * LIBRARY_COUNT**0.5)
    assert np.abs(ratio - 1).max() < 0.012, f"{ratio}"


@pytest.mark.parametrize("model", ["specula", "heitz", "wang", "cui-bidirectional"])
def test_spectra_have_the_values_of_their_wavelengths(model: str) -> None:
    use("llvm_ad_spectral")
    wavelengths, pair = (450.0, 520.0, 580.0, 640.0), PAIRS[0]
    eta, k = (1.4, 0.7, 0.3, 0.15), (1.7, 2.1, 2.7, 3.5)

    def spectrum(values: tuple[float, ...]) -> Dict:
        nodes, given = (", ".join(str(v) for v in row) for row in (wavelengths, values))
        return {"type": "irregular", "wavelengths": nodes, "values": given}

    bsdf = metal(model, 0.7, eta=spectrum(eta), k=spectrum(k))
    found = estimates(bsdf, *pair, 60_000)
    assert found.shape[0] == 4
    for of in (slice(0, 3), slice(1, 4)):
        mean, error = library_estimates(of_library(model), 0.7, *pair, (eta[of], k[of]))
        assert np.abs(scores(found[of], mean, error)).max() < 4


@pytest.mark.parametrize(
    "bsdf",
    [metal(model, (0.9, 0.5)) for model in MODELS]
    + [
        {"type": "specula_multibounce_dielectric", "model": model, "alpha_u": 0.9, "alpha_v": 0.5}
        for model in GLASS
    ],
    ids=lambda bsdf: f"{bsdf['type']}-{bsdf['model']}",
)
def test_scalar_variants_walk_the_same_walks(bsdf: Dict) -> None:
    """The same numbers make the same walks, but for rounding in single precision."""
    n, is_glass = 40, "dielectric" in bsdf["type"]
    wi, wo = (np.array(directions(n, seed, is_glass)) for seed in (31, 32))
    u, v = (np.array(x) for x in numbers(n, 33))
    si, ctx = surface(mi.Vector3f(wi), n), mi.BSDFContext()
    plugin = mi.load_dict(bsdf)
    sampled, weight = plugin.sample(ctx, si, mi.Float(u), mi.Point2f(v))
    wide = [np.array(x) for x in (plugin.eval(ctx, si, mi.Vector3f(wo)), sampled.wo, weight)]
    use("scalar_rgb")
    plugin, ctx = mi.load_dict(bsdf), mi.BSDFContext()
    found = []
    for k in range(n):
        si = surface_of(wi[:, k])
        value = plugin.eval(ctx, si, mi.Vector3f(*wo[:, k].tolist()))
        sampled, weight = plugin.sample(ctx, si, float(u[k]), mi.Point2f(*v[:, k].tolist()))
        found.append([np.array(x) for x in (value, sampled.wo, weight)])
    for ours, theirs in zip(np.moveaxis(found, 0, -1), wide, strict=True):
        same = np.isclose(ours, theirs, rtol=2e-3, atol=1e-5).all(0)
        assert same.mean() >= 0.95, f"{same.mean()}"


def surface_of(wi: Any) -> Any:
    """A point of a scalar variant, where `surface` has its texture's coordinates."""
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(*(float(x) for x in wi))
    si.uv = mi.Point2f(3 * float(wi[0]), 3 * float(wi[1]))
    return si


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_variant_has_every_model(variant: str) -> None:
    use(variant)
    ctx, wo = mi.BSDFContext(), mi.Vector3f(*unit((0.1, -0.4, 0.7)))
    for kind, models in (("", MODELS), ("_dielectric", GLASS)):
        for model in models:
            plugin = mi.load_dict(
                {"type": f"specula_multibounce{kind}", "model": model, "alpha": 0.8}
            )
            scalar = variant.startswith("scalar")
            si = surface_of(unit((0.3, 0.2, 0.8))) if scalar else surface(unit((0.3, 0.2, 0.8)))
            sampled, weight = plugin.sample(ctx, si, 0.4, mi.Point2f(0.3, 0.6))
            value, pdf = plugin.eval_pdf(ctx, si, wo)
            dr.eval(sampled, weight, value, pdf)
            assert 0 < np.array(weight).max() < 2
            assert np.linalg.norm(np.array(sampled.wo)) == pytest.approx(1, abs=1e-5)
            assert np.array(value).max() > 0
            assert np.array(pdf).max() > 0


@pytest.mark.parametrize("model", MODELS)
def test_samples_and_values_are_of_the_same_light(model: str) -> None:
    """Weights by a function of the direction against values integrated with it, in all channels."""
    n = 200_000
    plugin, ctx = mi.load_dict(metal(model, (0.9, 0.4))), mi.BSDFContext()
    si = surface(unit((0.6, 0.2, 0.5)), n)
    sampled, weight = plugin.sample(ctx, si, *numbers(n, 41))
    wo = mi.warp.square_to_uniform_hemisphere(numbers(n, 42)[1])
    value = plugin.eval(ctx, si, wo)
    dr.eval(sampled, weight, wo, value)

    def moments(w: Any, light: Any) -> Any:
        return np.array([np.array(light * f) for f in (1, w.x, w.y, w.z, dr.square(w.x), w.x * w.z)])

    by_walks = moments(sampled.wo, weight)
    by_values = moments(wo, 2 * dr.pi * value)
    error = np.hypot(by_walks.std(-1), by_values.std(-1)) / n**0.5
    score = (by_walks.mean(-1) - by_values.mean(-1)) / error
    assert np.abs(score).max() < 4, f"{score}"


@pytest.mark.parametrize("model", MODELS)
def test_white_metal_loses_nothing(model: str) -> None:
    """By every model: also Wang's, whose bias is of directions alone."""
    n = 50_000
    for alpha in (0.2, 1.0, (0.2, 0.9)):
        for cosine in (1.0, 0.5, 0.1):
            plugin = mi.load_dict(metal(model, alpha, **WHITE))
            si = seen(((1 - cosine * cosine) ** 0.5, 0.0, cosine), n)
            weight = np.array(plugin.sample(mi.BSDFContext(), si, *numbers(n, 9))[1].x)
            # Cui's walks make up by their weights for when they left.
            error = 4 * weight.std() / n**0.5 if "cui" in model else 0
            assert abs(weight.mean() - 1) < 1e-4 + error, f"{alpha}, {cosine}: {weight.mean()}"


def chi_square(model: str, scale: float = 1.0) -> bool:
    """Mitsuba's chi-square test of white walks against the mean of their values.

    Walks are accepted in proportion to their weights: those that are accepted follow the values.
    """
    plugin, ctx = mi.load_dict(metal(model, (0.9, 0.5), **WHITE)), mi.BSDFContext()
    view, most = unit((0.8, 0.3, 0.35)), 2.0 if "cui" in model else 1.0
    # Values whose noise is far below that of a cell's count.
    repeats = 6 if model in ("specula", "cui-bidirectional") else 20

    def sample(u: Any) -> Any:
        n = dr.width(u)
        sampled, weight = plugin.sample(ctx, surface(view, n), u.x, mi.Point2f(u.y, u.z))
        accepted = numbers(n, 52)[0] * most < weight.x
        return sampled.wo, dr.select(accepted, mi.Float(1), 0)

    def expected(wo: Any) -> Any:
        si, total = surface(view, dr.width(wo)), mi.Float(0)
        for k in range(repeats):
            si.p = mi.Point3f(float(k), 0, 0)
            total += plugin.eval(ctx, si, wo).x
            dr.eval(total)
        return scale * total / (repeats * most)

    test = mi.chi2.ChiSquareTest(
        domain=mi.chi2.SphericalDomain(),
        sample_func=sample,
        pdf_func=expected,
        sample_dim=3,
        sample_count=int(60_000 * most),
        res=41,
        ires=12,
    )
    passed = bool(test.run(significance_level=0.01, test_count=len(MODELS), quiet=True))
    if not passed and scale == 1.0:
        print(test.messages)
    return passed


@pytest.mark.parametrize("model", MODELS)
def test_walks_follow_their_values(model: str) -> None:
    assert chi_square(model)


def test_chi_square_notices_values_five_percent_off() -> None:
    assert not chi_square("specula", 1.05)
    assert not chi_square("cui", 1.05)


@pytest.mark.parametrize("model", MODELS)
def test_directions_of_the_density_follow_it(model: str) -> None:
    """Mitsuba's chi-square test of `sampling` ``pdf``, as it is; the weights are of the same light."""
    bsdf = metal(model, (0.9, 0.5), sampling="pdf")
    view, n = unit((0.8, 0.3, 0.35)), 100_000
    sample, density = mi.chi2.BSDFAdapter(bsdf["type"], bsdf, wi=view)
    for scale in (1.0, 1.05):
        test = mi.chi2.ChiSquareTest(
            domain=mi.chi2.SphericalDomain(),
            sample_func=sample,
            pdf_func=lambda wo, scale=scale: density(wo) * scale,
            sample_dim=3,
            sample_count=n,
            res=41,
            ires=12,
        )
        passed = test.run(significance_level=0.01, test_count=len(MODELS), quiet=True)
        assert passed == (scale == 1.0), test.messages
    means, errors = [], []
    for sampling in ("pdf", "walk"):
        plugin = mi.load_dict(bsdf | {"sampling": sampling})
        sampled, weight = plugin.sample(mi.BSDFContext(), surface(view, n), *numbers(n, 61))
        light = np.array(weight * (1 + 0.5 * sampled.wo.x))
        means.append(light.mean(-1))
        errors.append(light.std(-1) / n**0.5)
    assert np.abs((means[0] - means[1]) / np.hypot(*errors)).max() < 4


def test_densities_for_importance_sampling_integrate_to_one() -> None:
    """All models have the same."""
    n = 100_000
    wo = mi.warp.square_to_uniform_hemisphere(numbers(n, 10)[1])
    for alpha in (0.4, (0.9, 0.3)):
        for view in ((0.0, 0.0, 1.0), (0.9, 0.1, 0.1)):
            si, densities = seen(view, n), []
            for model in MODELS:
                plugin = mi.load_dict(metal(model, alpha))
                densities.append(np.array(plugin.pdf(mi.BSDFContext(), si, wo)))
            assert (np.array(densities) == densities[0]).all()
            found = 2 * np.pi * densities[0]
            assert abs(found.mean() - 1) < 4.5 * found.std() / n**0.5, f"{alpha}, {view}"


@pytest.mark.parametrize("model", MODELS)
def test_values_are_reciprocal(model: str) -> None:
    """But for Wang's correlated model as it was released."""
    alpha, (wi, wo), n = 0.8, ((0.95, 0.0, 0.3), (-0.1, 0.4, 0.9)), 100_000
    there = estimates(metal(model, alpha), wi, wo, n) / unit(wo)[2]
    back = estimates(metal(model, alpha), wo, wi, n, seed=1) / unit(wi)[2]
    score = np.abs(scores(there, back.mean(-1), back.std(-1) / n**0.5)).max()
    if model == "wang":
        assert score > 8
    else:
        assert score < 4


@pytest.mark.parametrize("model", ["specula", "heitz", "wang", "cui"])
def test_strategies_of_direct_light_agree(model: str) -> None:
    """Lights sampled, walks sampled, and both with their weights: the density need not be theirs."""
    scene = scene_of(metal(model, (0.9, 0.5)), 16)
    scene["sky"] = {"type": "constant", "radiance": {"type": "rgb", "value": [0.3, 0.5, 0.9]}}
    scene["lamp"]["to_world"] = mi.ScalarTransform4f().look_at([2, 3, 4], [0, 0, 0], [0, 1, 0])
    found = []
    for lights, walks in ((1, 0), (0, 1), (1, 1)):
        scene["integrator"] = {
            "type": "direct",
            "emitter_samples": lights,
            "bsdf_samples": walks,
            "hide_emitters": True,
        }
        found.append(render_mean(scene, 128))
    (both, error) = found[2]
    for mean, other in found[:2]:
        assert (np.abs(mean - both) < 5 * np.hypot(error, other) + 1e-3).all(), f"{found}"
    assert both.min() > 0.05
    assert both[0] > 1.2 * both[2]


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral", "scalar_rgb"])
@pytest.mark.parametrize("model", ["heitz", "wang", "cui"])
def test_white_walks_are_invisible_under_a_white_sky(model: str, variant: str) -> None:
    use(variant)
    small = variant.startswith("scalar")
    scene = scene_of(metal(model, 0.8, **WHITE), 4 if small else 12)
    scene.pop("lamp")
    scene["sky"]["radiance"] = {"type": "rgb", "value": 1.0}
    mean, error = render_mean(scene, 16 if small else 128)
    assert (np.abs(mean - 1) < 5 * error + 1e-3).all(), mean


@pytest.mark.parametrize("model", MODELS)
def test_walks_stay_finite_at_extreme_alphas_and_views(model: str) -> None:
    n = 20_000
    wi, lane = directions(n, 13, True), dr.arange(mi.UInt32, n)
    wi.z = dr.select(lane % 3 == 0, wi.z * 1e-6, wi.z)
    wi = dr.select(lane % 3 == 1, mi.Vector3f(0, 0, 1), dr.normalize(wi))
    for alpha in (0.0, 1e-3, (1e-3, 3.0), 3.0):
        plugin, ctx, si = mi.load_dict(metal(model, alpha)), mi.BSDFContext(), surface(wi)
        sampled, weight = plugin.sample(ctx, si, *numbers(n, 14))
        dr.eval(sampled, weight)
        for wo in (sampled.wo, directions(n, 15)):
            both = plugin.eval_pdf(ctx, si, wo)
            dr.eval(both)
            value, pdf = (np.array(x) for x in both)
            assert np.isfinite(value).all() and value.min() >= 0
            assert np.isfinite(pdf).all()
        assert np.isfinite(np.array(weight)).all() and np.array(weight).min() >= 0
        assert np.isfinite(np.array(sampled.wo)).all()


@pytest.mark.parametrize("alpha", [0.3, 1.0, (0.9, 0.3)], ids=str)
@pytest.mark.parametrize("model", GLASS)
def test_values_of_glass_are_those_of_the_library(model: str, alpha: Any) -> None:
    """From both sides to both sides."""
    widths = {"alpha": alpha}
    if isinstance(alpha, tuple):
        widths = {"alpha_u": alpha[0], "alpha_v": alpha[1]}
    bsdf = {"type": "specula_multibounce_dielectric", "model": model, **widths}
    bsdf |= {"int_ior": 1.5, "ext_ior": 1.0}
    found, n = [], 200_000
    for wi, wo in ((a, b) for a in (0.8, -0.5) for b in (0.4, -0.7)):
        view, light = (0.6, 0.2, wi), (-0.4, 0.3, wo)
        library = sr.MultibounceDielectric(alpha, 1.5)
        pair = np.tile(unit(view), (n, 1)), np.tile(unit(light), (n, 1))
        for importance in (False, True):
            transport = "importance" if importance else "radiance"
            theirs = library.eval(*pair, seed=7, transport=transport)[:, 0]  # type: ignore[arg-type]
            ours = estimates(bsdf, view, light, 100_000, importance)[:1]
            found.append(scores(ours, theirs.mean(), theirs.std() / n**0.5)[0])
    assert np.abs(found).max() < 4.5, f"{found}"


def test_walks_inside_dense_glass_go_on_with_heights() -> None:
    """Where total reflection sends walks down more often than a state has room for."""
    n, view, light = 200_000, (0.3, 0.2, -0.9), (-0.4, 0.3, -0.7)
    bsdf = {"type": "specula_multibounce_dielectric", "alpha": 3.0, "int_ior": 4.0, "ext_ior": 1.0}
    pair = np.tile(unit(view), (n, 1)), np.tile(unit(light), (n, 1))
    theirs = sr.MultibounceDielectric(3.0, 4.0).eval(*pair, seed=5, threads=0)[:, 0]
    score = scores(estimates(bsdf, view, light, n)[:1], theirs.mean(), theirs.std() / n**0.5)
    assert abs(score[0]) < 4, score


@pytest.mark.parametrize("model", GLASS)
def test_noise_of_glass_is_that_of_the_library(model: str) -> None:
    n, bsdf = 200_000, {"type": "specula_multibounce_dielectric", "model": model, "alpha": 1.0}
    bsdf |= {"int_ior": 1.5, "ext_ior": 1.0}
    library = sr.MultibounceDielectric(1.0, 1.5, model=model)  # type: ignore[arg-type]
    for wi, wo in ((0.8, -0.7), (-0.5, -0.7)):
        view, light = (0.6, 0.2, wi), (-0.4, 0.3, wo)
        theirs = library.eval(np.tile(unit(view), (n, 1)), np.tile(unit(light), (n, 1)), seed=5)
        ratio = estimates(bsdf, view, light, n)[0].std() / theirs[:, 0].std()
        assert abs(ratio - 1) < 0.03, f"{view}, {light}: {ratio}"


def test_models_that_there_are_not() -> None:
    for kind, expected in (
        ("specula_multibounce", ", ".join(MODELS)),
        ("specula_multibounce_dielectric", ", ".join(GLASS)),
    ):
        with pytest.raises(Exception, match=rf"no such model: 'cook' \(expected {expected}\)"):
            mi.load_dict({"type": kind, "model": "cook"})
