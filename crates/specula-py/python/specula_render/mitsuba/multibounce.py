"""``specula_multibounce``: rough metal with all bounces between its facets, by random walks.

    eval     an unbiased estimate of the model's ``f cos``; one bounce is exact
    sample   a walk until it leaves, and its weight; or a direction of ``pdf``, and ``eval / pdf``
    pdf      (1 - q) p_1 + q cos / pi, close to the walks' and integrating to 1, for MIS

``p_1`` is the exact sampler's density, and ``q`` the light that meets more than one facet where
they reflect everything. The walk's own density has no closed form: a weight is that of the walk,
not ``eval / pdf``, and MIS stays unbiased because both strategies use the same ``pdf``
(``docs/decisions/mitsuba-walks.md``). ``sampling`` ``pdf`` is for what needs that quotient, as
Mitsuba's chi-square test does; its weights vary ten times as much.

    model              source                            mean             sample's weight
    specula            stratified bidirectional walks    Heitz et al.'s   product of reflectances
    heitz              Heitz et al. 2016                 Heitz et al.'s   product of reflectances
    bitterli           Bitterli and d'Eon 2022           Heitz et al.'s   product of reflectances
    wang               Wang et al. 2022, correlated      its own          product of reflectances
    wang-uncorrelated  Wang et al. 2022                  its own          product of reflectances
    cui                Cui et al. 2023                   Heitz et al.'s   makes up for when it left
    cui-bidirectional  Cui et al. 2023, from both ends   Heitz et al.'s   makes up for when it left

Names are the library's. Masking is height-correlated, but for ``wang-uncorrelated``.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

from .energy import Loss
from .fresnel import fresnel_conductor
from .parameters import ConductorIndex, Roughness, choice, optional_texture
from .runtime import dr, mi
from .walks import (
    bitterli2022,
    cui2023,
    cui2023_bidirectional,
    heitz2016,
    stratified_bidirectional,
    wang2022,
)
from .walks.facets import Facets, stream

__all__ = ["MODELS", "Multibounce"]


class _Model(NamedTuple):
    """An estimator and a sampler, as `walks` has them."""

    eval: Callable[..., Any]
    sample: Callable[..., tuple[Any, Any]]


#: Models by name, the default first.
MODELS = {
    "specula": _Model(stratified_bidirectional.eval, heitz2016.sample),
    "heitz": _Model(heitz2016.eval, heitz2016.sample),
    "bitterli": _Model(bitterli2022.eval, heitz2016.sample),
    "wang": _Model(wang2022.eval, wang2022.sample),
    "wang-uncorrelated": _Model(
        partial(wang2022.eval, correlated=False), partial(wang2022.sample, correlated=False)
    ),
    "cui": _Model(cui2023.eval, cui2023.sample),
    "cui-bidirectional": _Model(cui2023_bidirectional.eval, cui2023.sample),
}


class Multibounce:
    """The lobe behind ``specula_multibounce``.

    Parameters
    ----------
    props : mitsuba.Properties
        Those of ``specula_conductor`` without ``sampler``, ``masking`` and ``energy``; ``model``,
        one of `MODELS`; ``sampling`` (``walk``, ``pdf``).

    Raises
    ------
    ValueError
        Beckmann facets, which have no sampler for views from below; an unknown name.

    Notes
    -----
    Parameters can be changed but are not differentiable: a walk's length has no bound that reverse
    mode needs, and the weight of a walk is no ratio of `eval` and `pdf`. Evaluation is random, with
    numbers from a hash of the directions and the position: the same question gets the same answer.
    Rays that hit the same point again and again, as of a pinhole camera without jitter under a
    point light, would average nothing. Above alpha 5 all models but ``heitz`` and ``wang`` end
    walks that are still below.
    """

    def __init__(self, props: Any) -> None:
        self.roughness = Roughness(props, ("exact",))
        if self.roughness.distribution != "ggx":
            raise ValueError(f"{props.plugin_name()}: walks are for GGX only")
        self.model = choice(props, "model", MODELS)
        self.sampling = choice(props, "sampling", ("walk", "pdf"))
        self.index = ConductorIndex(props)
        self.reflectance = optional_texture(props, "specular_reflectance")
        self.loss = Loss("ggx", True, self.roughness.isotropic)

    def components(self) -> list[int]:
        """Flags of each component: one, seen from the front."""
        flags = int(mi.BSDFFlags.GlossyReflection) | int(mi.BSDFFlags.FrontSide)
        return [flags | self.roughness.extra_flags]

    def traverse(self, callback: Any) -> None:
        """Report parameters under ``roughconductor``'s names."""
        fixed = mi.ParamFlags.NonDifferentiable
        named = {"eta": self.index.eta, "k": self.index.k}
        if self.reflectance is not None:
            named["specular_reflectance"] = self.reflectance
        if self.roughness.isotropic:
            named["alpha"] = self.roughness.alpha_u
        else:
            named |= {"alpha_u": self.roughness.alpha_u, "alpha_v": self.roughness.alpha_v}
        for name, texture in named.items():
            callback.put(name, texture, fixed)

    def parameters_changed(self, keys: list[str]) -> None:
        """Nothing is derived from parameters."""

    def sample(
        self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True
    ) -> tuple[Any, Any]:
        """A direction and its weight; of a walk, `sample2` takes the first facet."""
        sampled = dr.zeros(mi.BSDFSample3f)
        active = mi.Mask(active) & (si.wi.z > 0)
        if not ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0):
            return sampled, mi.Spectrum(0)
        with dr.suspend_grad():
            if self.sampling == "pdf":
                wo = self._lobes_direction(si, sample1, sample2, active)
                value, density = self.eval_pdf(ctx, si, wo, active)
                weight = value / dr.select(density > 0, density, 1)
            else:
                facets = self._facets(si, active)
                rng = stream(sample1, sample2.x, sample2.y)
                walk = MODELS[self.model].sample
                wo, weight = walk(facets, si.wi, mi.Point2f(sample2), rng, active)
            active &= wo.z > 0
            wo = dr.select(active, wo, mi.Vector3f(0, 0, 1))
            sampled.wo = wo
            sampled.pdf = self.pdf(ctx, si, wo, active)
            sampled.eta = mi.Float(1)
            sampled.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            sampled.sampled_component = mi.UInt32(0)
            return sampled, dr.select(active & (sampled.pdf > 0), weight, 0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """An estimate of ``f cos`` (spectrum, 1/sr)."""
        enabled = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
        active = mi.Mask(active) & (si.wi.z > 0) & (wo.z > 0) & enabled
        with dr.suspend_grad():
            facets = self._facets(si, active)
            wi, p = si.wi, si.p
            rng = stream(wi.x, wi.y, wo.x, wo.y, p.x, p.y, p.z, si.uv.x, si.uv.y)
            value = MODELS[self.model].eval(facets, wi, wo, rng, active)
        return dr.select(active, value, 0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density for multiple importance sampling, 1/sr; integrates to 1."""
        enabled = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
        active = mi.Mask(active) & (si.wi.z > 0) & (wo.z > 0) & enabled
        with dr.suspend_grad():
            ggx = self.roughness.at(si, active)
            m = dr.normalize(si.wi + wo)
            once = 0.25 * ggx.d(m) / ggx.norm(si.wi)
            pdf = dr.lerp(once, wo.z * dr.inv_pi, self._share(ggx, si.wi))
            return dr.select(active, pdf, 0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        return f"SpeculaMultibounce[{self.roughness!r}, model={self.model}]"

    def _share(self, ggx: Any, wi: Any) -> Any:
        """``q``, the share of the cosine lobe in `pdf`."""
        return dr.maximum(self.loss.directional(ggx, wi), 1e-3)

    def _lobes_direction(self, si: Any, sample1: Any, sample2: Any, active: Any) -> Any:
        """A direction of `pdf`; `sample1` chooses between its lobes."""
        ggx = self.roughness.at(si, active)
        m = ggx.half_vector(si.wi, sample2)
        once = 2 * dr.dot(si.wi, m) * m - si.wi
        cosine = mi.warp.square_to_cosine_hemisphere(sample2)
        wo = dr.select(sample1 < self._share(ggx, si.wi), cosine, once)
        return dr.select(active, wo, mi.Vector3f(0, 0, 1))

    def _facets(self, si: Any, active: Any) -> Facets:
        eta, k = self.index.at(si, active)
        tint = mi.Spectrum(1)
        if self.reflectance is not None:
            tint = self.reflectance.eval(si, active)
        ggx = self.roughness.at(si, active)
        return Facets(ggx, lambda cosine: fresnel_conductor(cosine, eta, k) * tint)
