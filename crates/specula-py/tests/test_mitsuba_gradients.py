"""Plugins for Mitsuba 3: derivatives against differences."""

from __future__ import annotations

from typing import Any

import pytest

from test_mitsuba_tools import (  # noqa: F401
    SAMPLERS,
    Dict,
    dr,
    mi,
    numbers,
    rgb,
    scene_of,
    surface,
    unit,
)

ALUMINIUM: Dict = {"type": "specula_conductor", "eta": 1.2, "k": 7.0, "specular_reflectance": 0.9}
BY_ALPHA: list[Dict] = [
    *({**ALUMINIUM, "sampler": sampler} for sampler in SAMPLERS),
    {**ALUMINIUM, "distribution": "beckmann"},
    {**ALUMINIUM, "energy": "turquin"},
    {**ALUMINIUM, "energy": "kulla_conty"},
    {"type": "specula_dielectric"},
]
GRADIENTS: list[tuple[Dict, str, float]] = [
    *((bsdf | {"alpha": 0.4}, "alpha.value", 0.02) for bsdf in BY_ALPHA),
    (ALUMINIUM | {"alpha_u": 0.2, "alpha_v": 0.5}, "alpha_v.value", 0.02),
    (ALUMINIUM | {"alpha": 0.4}, "k.value", 0.2),
    (ALUMINIUM | {"alpha": 0.4, "eta": 2.0}, "eta.value", 0.2),
    (ALUMINIUM | {"alpha": 0.4, "energy": "kulla_conty"}, "specular_reflectance.value", 0.05),
    # Narrow: what refracts off facets seen edge-on moves an edge (see `Dielectric`).
    ({"type": "specula_dielectric", "alpha": 0.15}, "eta", 0.02),
]


@pytest.mark.parametrize(("bsdf", "key", "step"), GRADIENTS, ids=str)
def test_derivatives_equal_differences(bsdf: Dict, key: str, step: float) -> None:
    """Of light that grows to one side, through the sampler, at an oblique view."""
    n = 400_000
    plugin, ctx = mi.load_dict(bsdf), mi.BSDFContext()
    parameters = mi.traverse(plugin)
    start = parameters[key][0]
    si, random = surface(unit((0.6, 0.1, 0.5)), n), numbers(n, 12)

    def light(value: Any) -> Any:
        parameters[key] = value
        parameters.update()
        sampled, weight = plugin.sample(ctx, si, *random)
        return dr.mean(weight.x * dr.square(dr.square(0.5 - 0.5 * sampled.wo.x)))

    parameter = mi.Float(start)
    dr.enable_grad(parameter)
    dr.backward(light(parameter))
    derivative = dr.grad(parameter)[0]
    ends = [light(mi.Float(start + sign * step))[0] for sign in (-1, 1)]
    difference = (ends[1] - ends[0]) / (2 * step)
    assert abs(difference) > 0.002
    assert derivative == pytest.approx(difference, rel=0.04)


@pytest.mark.parametrize("integrator", ["path", "prb"])
def test_derivative_of_a_render_equals_differences(integrator: str) -> None:
    scene = mi.load_dict(scene_of({"type": "specula_conductor", "alpha": 0.5}, 16))
    parameters = mi.traverse(scene)
    key = next(k for k in parameters.keys() if k.endswith("alpha.value"))
    tracer = mi.load_dict({"type": integrator, "max_depth": 3})

    def mean(value: Any, seed: int) -> Any:
        parameters[key] = value
        parameters.update()
        return dr.mean(mi.render(scene, parameters, integrator=tracer, seed=seed, spp=512).array)

    width = mi.Float(0.5)
    dr.enable_grad(width)
    dr.backward(mean(width, 1))
    ends = [mean(mi.Float(0.5 + h), 1)[0] for h in (-0.05, 0.05)]
    assert dr.grad(width)[0] == pytest.approx((ends[1] - ends[0]) / 0.1, rel=0.06)
