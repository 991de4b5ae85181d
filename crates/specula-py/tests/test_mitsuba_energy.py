"""Plugins for Mitsuba 3: lost energy and its compensation against the library's own lobes."""

from __future__ import annotations

import gc
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
    rgb,
    surface,
    unit,
    use,
)

from specula_render.mitsuba import energy  # noqa: E402

N = 4000
ALPHAS: list[tuple[Dict, Any]] = [
    ({"alpha": 0.05}, 0.05),
    ({"alpha": 0.6}, 0.6),
    ({"alpha": 2.0}, 2.0),
    ({"alpha_u": 0.1, "alpha_v": 0.7}, (0.1, 0.7)),
    ({"alpha_u": 0.9, "alpha_v": 0.3}, (0.9, 0.3)),
]
DISTRIBUTIONS = ["ggx", "beckmann"]
VARIANTS = ["llvm_ad_rgb", "scalar_rgb"]


def pairs(n: int, full_sphere: bool = False) -> tuple[Any, Any]:
    """Pairs of directions, (3, n); views above the horizon unless the sphere is asked for."""
    if mi.variant().startswith("scalar"):
        rng = np.random.default_rng(4)
        found = rng.normal(size=(2, 3, n))
        found /= np.linalg.norm(found, axis=1, keepdims=True)
        if not full_sphere:
            found[:, 2] = np.abs(found[:, 2])
        return found[0], found[1]
    return np.array(directions(n, 4, full_sphere)), np.array(directions(n, 5, full_sphere))


def values(bsdf: Dict, wi: Any, wo: Any) -> Any:
    """``f cos`` of a plugin, (3, n)."""
    plugin, ctx = mi.load_dict(bsdf), mi.BSDFContext()
    if mi.variant().startswith("scalar"):
        found = []
        for a, b in zip(wi.T, wo.T, strict=True):
            si = mi.SurfaceInteraction3f()
            si.wi = mi.Vector3f(*a)
            found.append(np.array(plugin.eval(ctx, si, mi.Vector3f(*b))))
        return np.array(found).T
    return np.array(plugin.eval(ctx, surface(mi.Vector3f(wi), wi.shape[1]), mi.Vector3f(wo)))


def colour(value: tuple[float, ...]) -> Dict:
    return {"type": "rgb", "value": list(value)}


#: Gold's index in red, green and blue: no two channels alike.
ETA, K = (0.143, 0.375, 1.442), (3.983, 2.386, 1.603)
METALS: dict[str, tuple[Dict, sr.Reflectance]] = {
    "white": (WHITE, sr.Reflectance.constant(1.0)),
    "gold": ({"eta": colour(ETA), "k": colour(K)}, sr.Reflectance.conductor(ETA, K)),
}


@pytest.mark.parametrize("metal", METALS)
@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("masking", ["separable", "height_correlated"])
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_what_compensation_adds_is_the_library_s(
    distribution: str, masking: str, variant: str, metal: str
) -> None:
    """Turquin's factor as a ratio, so that masking by Mitsuba's fit cancels; the second lobe."""
    use(variant)
    wi, wo = pairs(N if variant.startswith("llvm") else 100)
    index, reflectance = METALS[metal]
    for given, alpha in ALPHAS:
        bsdf = {"type": "specula_conductor", "distribution": distribution, **given, **index}
        bsdf["masking"] = masking
        named: Dict = {"distribution": distribution, "masking": masking.replace("_", "-")}
        native = {
            energy: sr.RoughConductor(alpha, reflectance, energy=energy, **named).eval(
                wi, wo, axis=0
            )
            for energy in (None, "turquin", "kulla-conty")
        }
        own = {
            energy: values({**bsdf, "energy": energy or "none"}, wi, wo)
            for energy in (None, "turquin", "kulla_conty")
        }
        # What is far below the lobe's largest value is rounded away.
        seen = native[None] > 1e-3 * native[None].max()
        factor = own["turquin"][seen] / own[None][seen]
        expected = native["turquin"][seen] / native[None][seen]
        np.testing.assert_allclose(factor, expected, rtol=3e-4, err_msg=f"{given}")
        # Beside a narrow lobe the second one is rounded, too.
        dull = native[None] < 1e2 * (native["kulla-conty"] - native[None])
        second = (own["kulla_conty"] - own[None])[dull]
        expected = (native["kulla-conty"] - native[None])[dull]
        assert dull.sum() > 20
        np.testing.assert_allclose(second, expected, rtol=2e-3, atol=1e-6, err_msg=f"{given}")


@pytest.mark.parametrize("variant", VARIANTS)
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_the_second_lobe_of_glass_is_the_library_s(distribution: str, variant: str) -> None:
    """Tinted, so that no two channels and no two branches are alike."""
    use(variant)
    reflected, transmitted = (0.9, 0.6, 0.3), (0.4, 0.8, 1.0)
    tints = {"specular_reflectance": colour(reflected)}
    tints["specular_transmittance"] = colour(transmitted)
    wi, wo = pairs(N if variant.startswith("llvm") else 100, True)
    for given, alpha in ALPHAS:
        for eta in (1.5, 1 / 1.8):
            bsdf = {"type": "specula_dielectric", "distribution": distribution, **given}
            bsdf |= {"int_ior": eta, "ext_ior": 1.0, **tints}
            native = [
                sr.RoughDielectric(
                    alpha,
                    eta,
                    distribution=distribution,  # type: ignore[arg-type]
                    masking="separable",
                    compensated=compensated,
                    reflection_tint=reflected,
                    transmission_tint=transmitted,
                ).eval(wi, wo, axis=0)
                for compensated in (False, True)
            ]
            own = [values({**bsdf, "energy": e}, wi, wo) for e in ("none", "kulla_conty")]
            expected = native[1] - native[0]
            dull = native[0] < 1e2 * expected
            assert dull.sum() > 20
            np.testing.assert_allclose(
                (own[1] - own[0])[dull], expected[dull], rtol=3e-3, atol=1e-5, err_msg=f"{given}"
            )


GLASS: list[tuple[Dict, float]] = [
    ({"alpha": 0.3}, 0.007),
    ({"alpha": 1.0}, 0.007),
    ({"alpha": 0.5, "distribution": "beckmann"}, 0.01),
    ({"alpha_u": 0.2, "alpha_v": 0.7}, 0.02),
]


@pytest.mark.parametrize(("given", "tolerance"), GLASS, ids=str)
def test_compensated_glass_keeps_its_light(given: Dict, tolerance: float) -> None:
    """Importance is neither compressed nor spread at the interface: all of it goes on."""
    n = 200_000
    plugin = mi.load_dict({"type": "specula_dielectric", "energy": "kulla_conty", **given})
    bare = mi.load_dict({"type": "specula_dielectric", **given})
    ctx = mi.BSDFContext(mi.TransportMode.Importance)
    lost = 0.0
    for cosine in (0.9, 0.4, 0.1, -0.1, -0.5, -1.0):
        si = surface([(1 - cosine * cosine) ** 0.5, 0.0, cosine], n)
        weight = np.array(plugin.sample(ctx, si, *numbers(n, 21))[1].x)
        error = weight.std() / n**0.5
        assert abs(weight.mean() - 1) < tolerance + 4 * error, f"{cosine}: {weight.mean()}"
        single = np.array(bare.sample(ctx, si, *numbers(n, 22))[1].x)
        lost = max(lost, 1 - float(single.mean()))
    assert lost > 2 * tolerance


def test_plugins_share_their_tables() -> None:
    """For as long as one of them is there; each distribution, masking and variant has its own."""
    given = {"type": "specula_conductor", "energy": "turquin", "alpha_u": 0.1, "alpha_v": 0.2}
    glass = {"type": "specula_dielectric", "energy": "kulla_conty", "alpha": 0.2}
    gc.collect()
    before = len(energy._SHARED)
    first, second = mi.load_dict(given), mi.load_dict({**given, "alpha_u": 0.3})
    others = [
        mi.load_dict(given | {"distribution": "beckmann"}),
        mi.load_dict(given | {"masking": "height_correlated"}),
        mi.load_dict(glass),
    ]
    assert first.lobe.loss._rows is second.lobe.loss._rows
    assert first.lobe.loss._average is second.lobe.loss._average
    tables = [plugin.lobe.loss._rows for plugin in (first, *others)]
    assert len({id(table) for table in tables}) == 4
    use("llvm_ad_spectral")
    assert mi.load_dict(given).lobe.loss._rows is not tables[0]
    del first, second, others, tables
    gc.collect()
    assert len(energy._SHARED) == before


@pytest.mark.parametrize("given", [{"alpha": 0.5}, {"alpha_u": 0.2, "alpha_v": 0.7}], ids=str)
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_losses_have_derivatives(given: Dict, distribution: str) -> None:
    """Of the compensated value by alpha, against differences."""
    bsdf = {"type": "specula_conductor", "energy": "kulla_conty", "eta": 0.2, "k": 3.0}
    bsdf |= {"distribution": distribution, **given}
    wi, wo = directions(64, 6), directions(64, 7)
    key = "alpha.value" if "alpha" in given else "alpha_u.value"

    def total(alpha: Any) -> Any:
        plugin = mi.load_dict(bsdf)
        parameters = mi.traverse(plugin)
        parameters[key] = alpha
        parameters.update()
        return dr.sum(plugin.eval(mi.BSDFContext(), surface(wi, 64), wo).x)

    at = next(iter(given.values()))
    alpha = mi.Float(at)
    dr.enable_grad(alpha)
    dr.backward(total(alpha))
    step = 2e-3
    slope = (float(total(mi.Float(at + step))[0]) - float(total(mi.Float(at - step))[0])) / 2 / step
    assert float(dr.grad(alpha)[0]) == pytest.approx(slope, rel=0.02)
