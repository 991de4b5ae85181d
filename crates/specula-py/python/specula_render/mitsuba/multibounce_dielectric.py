"""``specula_multibounce_dielectric``: rough glass with all bounces on both sides, by random walks.

    eval     an unbiased estimate of all light
    sample   a walk until it leaves on either side; it loses nothing, so its weight is 1
    pdf      (1 - s) p_1 + s |cos| / (2 pi), close to the walks' and integrating to 1, for MIS

``p_1`` is the density of directions after the first facet, over the sphere. ``model`` ``specula``
is stratified walks from the better end (`walks.stratified_interface`), ``heitz`` Heitz et al. 2016;
both have the same mean. The other models treat metals only.

Source: `mis_pdf.rs` of `crates/specula-bsdf/src/multibounce`.
"""

from __future__ import annotations

from typing import Any

from .dielectric import Dielectric
from .parameters import choice
from .runtime import dr, mi
from .walks import heitz2016, interface, stratified_interface
from .walks.facets import Facets, stream

__all__ = ["MODELS", "MultibounceDielectric"]

#: Estimators by name, the default first.
MODELS = {"specula": stratified_interface.eval, "heitz": heitz2016.eval_interface}


class MultibounceDielectric:
    """The lobe behind ``specula_multibounce_dielectric``.

    Parameters
    ----------
    props : mitsuba.Properties
        Those of ``specula_dielectric`` without ``sampler`` and ``energy``; ``model``, one of
        `MODELS`.

    Raises
    ------
    ValueError
        Beckmann facets, which have no sampler for views from below; wrong indices; an unknown model.

    Notes
    -----
    Parameters can be changed but are not differentiable, and evaluation is random, as with
    ``specula_multibounce``.
    """

    def __init__(self, props: Any) -> None:
        for name in ("sampler", "energy"):
            if name in props:
                raise ValueError(f"{props.plugin_name()}: walks have no '{name}'")
        self.model = choice(props, "model", MODELS)
        self.single = Dielectric(props)
        if self.single.roughness.distribution != "ggx":
            raise ValueError(f"{props.plugin_name()}: walks are for GGX only")

    def components(self) -> list[int]:
        """Flags of reflection and transmission, seen from both sides."""
        return self.single.components()

    def traverse(self, callback: Any) -> None:
        """Report parameters under ``roughdielectric``'s names."""
        self.single.traverse(_Fixed(callback))

    def parameters_changed(self, keys: list[str]) -> None:
        """Keep the index out of compiled kernels."""
        self.single.parameters_changed(keys)

    def sample(
        self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True
    ) -> tuple[Any, Any]:
        """Where a walk leaves; `sample1` and `sample2` take the first facet."""
        sampled = dr.zeros(mi.BSDFSample3f)
        active = mi.Mask(active) & (si.wi.z != 0)
        with dr.suspend_grad():
            wi, eta = self.single.upper(si)
            facets = self._facets(si, active)
            rng = stream(sample1, sample2.x, sample2.y)
            u2 = mi.Point2f(sample2)
            wo, has_left = heitz2016.sample_interface(
                facets, eta, wi, mi.Float(sample1), u2, rng, active
            )
            is_reflected = wo.z > 0
            wo.z = dr.mulsign(wo.z, si.wi.z)
            active &= has_left & (wo.z != 0)
            wo = dr.select(active, wo, mi.Vector3f(0, 0, 1))
            pdf = self.pdf(ctx, si, wo, active)
            sampled.wo = wo
            sampled.pdf = pdf
            sampled.eta = dr.select(is_reflected, mi.Float(1), eta)
            kinds = mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.GlossyTransmission
            sampled.sampled_type = dr.select(
                is_reflected, mi.UInt32(+kinds[0]), mi.UInt32(+kinds[1])
            )
            sampled.sampled_component = dr.select(is_reflected, mi.UInt32(0), mi.UInt32(1))
            weight = self.single.tint(ctx, si, is_reflected, eta, active)
            active &= (pdf > 0) & _enabled(ctx, is_reflected)
            return sampled, dr.select(active, weight, 0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """An estimate of ``f |cos|`` (spectrum, 1/sr)."""
        with dr.suspend_grad():
            wi, eta = self.single.upper(si)
            wo = mi.Vector3f(wo.x, wo.y, dr.mulsign(wo.z, si.wi.z))
            is_reflected = wo.z > 0
            active = mi.Mask(active) & (si.wi.z != 0) & (wo.z != 0) & _enabled(ctx, is_reflected)
            facets, p = self._facets(si, active), si.p
            rng = stream(wi.x, wi.y, si.wi.z, wo.x, wo.y, p.x, p.y, p.z, si.uv.x, si.uv.y)
            value = MODELS[self.model](facets, eta, wi, wo, rng, active)
            tint = self.single.tint(ctx, si, is_reflected, eta, active)
            return dr.select(active, tint * value, 0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density for multiple importance sampling, 1/sr."""
        with dr.suspend_grad():
            wi, eta = self.single.upper(si)
            wo = mi.Vector3f(wo.x, wo.y, dr.mulsign(wo.z, si.wi.z))
            active = mi.Mask(active) & (si.wi.z != 0) & (wo.z != 0) & _enabled(ctx, wo.z > 0)
            facets = self._facets(si, active)
            # The first flight may go on downwards on either side: both branches reach everywhere.
            first = interface.phase(facets, -wi, eta, wo, mi.Mask(True))
            first += interface.phase(facets, -wi, eta, wo, mi.Mask(False))
            a4 = dr.square(facets.ggx.alpha_u * facets.ggx.alpha_v)
            share = dr.maximum(0.8 * a4 / (a4 + 0.15), 0.002)
            pdf = dr.lerp(first, dr.abs(wo.z) * (0.5 * dr.inv_pi), share)
            return dr.select(active, pdf, 0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        return (
            f"SpeculaMultibounceDielectric[{self.single.roughness!r}, eta={self.single.eta},"
            f" model={self.model}]"
        )

    def _facets(self, si: Any, active: Any) -> Facets:
        return Facets(self.single.roughness.at(si, active), None)


class _Fixed:
    """A traversal whose parameters are not differentiable."""

    def __init__(self, callback: Any) -> None:
        self._callback = callback

    def put(self, name: str, value: Any, flags: Any) -> None:
        self._callback.put(name, value, mi.ParamFlags.NonDifferentiable)


def _enabled(ctx: Any, is_reflected: Any) -> Any:
    reflects = mi.Mask(ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0))
    refracts = mi.Mask(ctx.is_enabled(mi.BSDFFlags.GlossyTransmission, 1))
    return dr.select(is_reflected, reflects, refracts)
