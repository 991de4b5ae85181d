"""Plugins for Mitsuba 3 against Mitsuba's own: values, pictures, parameters, errors."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import pytest

from test_mitsuba_tools import (  # noqa: F401
    ALPHAS,
    SAMPLERS,
    Dict,
    agrees,
    conductor,
    directions,
    dr,
    mi,
    np,
    render_mean,
    rgb,
    scene_of,
    specula,
    surface,
    unit,
    use,
)

CHECKS: Dict = {"type": "checkerboard", "color0": 0.1, "color1": 0.6}
PARAMETERS: list[Dict] = [
    {"distribution": distribution, **alpha, **index}
    for distribution in ("ggx", "beckmann")
    for alpha in (*ALPHAS, {"alpha": 0.003}, {"alpha_u": CHECKS, "alpha_v": 0.3})
    for index in ({"material": "Cu"}, {"eta": 1.5, "k": 2.0, "specular_reflectance": 0.7})
]


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
@pytest.mark.parametrize("sampler", SAMPLERS)
def test_metal_has_the_value_of_mitsubas(variant: str, sampler: str) -> None:
    use(variant)
    wi, wo = directions(4000, 1), directions(4000, 2)
    # Half of the pairs near the mirror direction, for narrow lobes.
    wo = dr.select(
        dr.arange(mi.UInt32, 4000) % 2 == 0,
        wo,
        dr.normalize(mi.Vector3f(-wi.x, -wi.y, wi.z) + 0.01 * wo),
    )
    for parameters in PARAMETERS:
        options = {"sampler": sampler} if parameters["distribution"] == "ggx" else {}
        si, ctx = surface(wi), mi.BSDFContext()
        ours = conductor(**parameters, **options)
        theirs = mi.load_dict({"type": "roughconductor", **parameters})
        agrees(ours.eval(ctx, si, wo), theirs.eval(ctx, si, wo))


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral"])
def test_glass_has_the_value_of_mitsubas(variant: str) -> None:
    use(variant)
    wi, wo = directions(20_000, 3, True), directions(20_000, 4, True)
    for distribution in ("ggx", "beckmann"):
        for alpha in ALPHAS:
            for more in ({}, {"int_ior": "diamond", "specular_transmittance": 0.6}):
                given = {"distribution": distribution, **alpha, **more}
                ours = mi.load_dict({"type": "specula_dielectric", **given})
                theirs = mi.load_dict({"type": "roughdielectric", **given})
                for mode in (mi.TransportMode.Radiance, mi.TransportMode.Importance):
                    ctx, si = mi.BSDFContext(mode), surface(wi)
                    # Mitsuba's eval keeps facets seen from behind, its eval_pdf does not.
                    theirs_value = theirs.eval_pdf(ctx, si, wo)[0]
                    agrees(ours.eval(ctx, si, wo), theirs_value, 2e-3, 3e-6)


def test_scalar_variant_has_the_value_of_mitsubas() -> None:
    use("scalar_rgb")
    for kind, theirs in (("conductor", "roughconductor"), ("dielectric", "roughdielectric")):
        ours = mi.load_dict({"type": f"specula_{kind}", "alpha": 0.4})
        reference = mi.load_dict({"type": theirs, "alpha": 0.4, "distribution": "ggx"})
        ctx, si = mi.BSDFContext(), mi.SurfaceInteraction3f()
        si.wi = mi.Vector3f(unit((0.5, 0.2, 0.7)))
        for wo in ((-0.3, 0.1, 0.9), (0.4, -0.5, 0.3)):
            wo = mi.Vector3f(unit(wo))
            agrees(ours.eval(ctx, si, wo), reference.eval(ctx, si, wo))
            sampled, weight = ours.sample(ctx, si, 0.3, mi.Point2f(0.2, 0.6), True)
            value, pdf = ours.eval_pdf(ctx, si, sampled.wo)
            agrees(weight, np.array(value) / pdf)
            assert sampled.pdf == pytest.approx(pdf)


def nested_metal() -> Dict:
    """Gold under bumps, seen from both sides."""
    waves = 0.05 * np.sin(np.linspace(0, 40, 64, dtype=np.float32))[None, :, None]
    bumps = mi.Bitmap(np.ascontiguousarray(np.repeat(waves, 64, axis=0)))
    metal = {"type": "roughconductor", "material": "Au", "alpha": 0.3, "distribution": "ggx"}
    bumpy = {
        "type": "bumpmap",
        "arbitrary": {"type": "bitmap", "bitmap": bumps, "raw": True},
        "bsdf": metal,
    }
    return {"type": "twosided", "nested": bumpy}


@pytest.mark.parametrize("variant", ["llvm_ad_rgb", "llvm_ad_spectral", "scalar_rgb"])
def test_a_scene_with_replaced_metals_renders_to_the_same_mean(variant: str) -> None:
    use(variant)
    scene = scene_of(nested_metal(), 12 if variant.startswith("scalar") else 24)
    replaced = specula.replace_roughconductors(scene)
    assert replaced.replaced == 1
    spp = 16 if variant.startswith("scalar") else 128
    theirs, error = render_mean(scene, spp)
    ours, our_error = render_mean(replaced, spp)
    assert (np.abs(ours - theirs) < 5 * (error + our_error) + 2e-3).all(), f"{ours} {theirs}"


def test_glass_renders_to_the_same_mean() -> None:
    bsdf: Dict = {"type": "roughdielectric", "alpha": 0.3, "distribution": "ggx"}
    theirs, error = render_mean(scene_of(bsdf), 256)
    ours, our_error = render_mean(scene_of(bsdf | {"type": "specula_dielectric"}), 256)
    assert (np.abs(ours - theirs) < 5 * (error + our_error) + 1e-3).all(), f"{ours} {theirs}"


@pytest.mark.parametrize(
    "bsdf",
    [
        {"type": "specula_conductor", "material": "Cu"},
        {"type": "specula_conductor", "material": "Cu", "energy": "kulla_conty"},
        {"type": "specula_dielectric"},
        {"type": "specula_multibounce", "material": "Cu"},
        {"type": "specula_multibounce", "material": "Cu", "model": "cui-bidirectional"},
        {"type": "specula_multibounce_dielectric"},
    ],
    ids=str,
)
def test_a_frozen_render_sees_new_parameters(bsdf: Dict) -> None:
    scene = mi.load_dict(scene_of(bsdf | {"alpha": 0.5}, 8))
    parameters = mi.traverse(scene)
    key = next(k for k in parameters.keys() if k.endswith("alpha.value"))
    frozen = dr.freeze(lambda scene, seed: mi.render(scene, spp=16, seed=seed))
    for alpha, seed in ((0.5, 1), (0.5, 2), (0.2, 3)):
        parameters[key] = alpha
        parameters.update()
        replayed = np.array(frozen(scene, mi.UInt32(seed)))
        np.testing.assert_allclose(replayed, np.array(mi.render(scene, spp=16, seed=seed)), 1e-4)


def test_replacing_keeps_parameters_and_the_given_scene() -> None:
    texture = {"type": "checkerboard"}
    metal: Dict = {"type": "roughconductor", "alpha_u": 0.1, "alpha_v": texture, "eta": 1.0}
    scene: Dict = {
        "type": "scene",
        "a": {"type": "sphere", "bsdf": {**metal, "sample_visible": False}},
        "b": {"type": "twosided", "x": {**metal, "distribution": "ggx"}},
        "c": {"type": "diffuse"},
    }
    replaced = specula.replace_roughconductors(scene, sampler="cap", masking="height_correlated")
    assert replaced.replaced == 2
    expected = {**metal, "type": "specula_conductor", "masking": "height_correlated"}
    assert replaced["a"]["bsdf"] == {**expected, "distribution": "beckmann"}
    assert replaced["b"]["x"] == {**expected, "distribution": "ggx", "sampler": "cap"}
    assert replaced["c"] == scene["c"]
    assert scene["a"]["bsdf"]["type"] == "roughconductor"
    assert mi.load_dict(replaced["b"]) is not None
    assert specula.replace_roughconductors({"type": "diffuse"}).replaced == 0


@pytest.mark.parametrize(
    ("bsdf", "message"),
    [
        ({"sampler": "best"}, "no such sampler"),
        ({"masking": "none"}, "no such masking"),
        ({"energy": "all"}, "no such energy"),
        ({"distribution": "phong"}, "no such distribution"),
        ({"distribution": "beckmann", "sampler": "exact"}, "is for GGX"),
        ({"alpha": 0.1, "alpha_u": 0.1, "alpha_v": 0.2}, "give 'alpha', or"),
        ({"alpha_u": 0.1}, "both 'alpha_u' and 'alpha_v'"),
        ({"material": "Cu", "eta": 1.0, "k": 1.0}, "not both"),
        ({"type": "specula_dielectric", "int_ior": 1.5, "ext_ior": 1.5}, "differ"),
        ({"type": "specula_dielectric", "sampler": "exact"}, "no such sampler"),
        ({"type": "specula_multibounce", "distribution": "beckmann"}, "GGX only"),
    ],
    ids=str,
)
def test_errors_say_what_is_wrong(bsdf: Dict, message: str) -> None:
    with pytest.raises(Exception, match=message):
        mi.load_dict({"type": "specula_conductor", **bsdf})


@pytest.mark.parametrize(
    ("variant", "message"), [(None, "no Mitsuba variant is set"), ("x_polarized", "polarization")]
)
def test_registration_needs_a_usable_variant(
    variant: str | None, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mi, "variant", lambda: variant)
    with pytest.raises(RuntimeError, match=message):
        specula.register()


def test_without_mitsuba_the_error_says_how_to_install_it() -> None:
    code = (
        "import sys; sys.modules['mitsuba'] = None\n"
        "from specula_render import mitsuba\n"
        "assert mitsuba.replace_roughconductors({'type': 'roughconductor'}).replaced == 1\n"
        "mitsuba.register()\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert run.returncode == 1
    assert "ImportError" in run.stderr
    assert "pip install mitsuba" in run.stderr


def test_parameters_have_mitsubas_names_and_flags() -> None:
    for kind, theirs in (("conductor", "roughconductor"), ("dielectric", "roughdielectric")):
        for alpha in ({"alpha": 0.2}, {"alpha_u": 0.2, "alpha_v": 0.3}):
            ours = mi.traverse(mi.load_dict({"type": f"specula_{kind}", **alpha}))
            reference = mi.traverse(mi.load_dict({"type": theirs, **alpha}))
            assert set(ours.keys()) == set(reference.keys())
            assert all(ours.flags(key) == reference.flags(key) for key in reference.keys())
