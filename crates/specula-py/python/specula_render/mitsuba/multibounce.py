"""``specula_multibounce``: rough metal with all bounces between its facets, by random walks.

    eval     F D G2 / (4 wi.z), one bounce in closed form, + an unbiased estimate of all others
    sample   a walk until it leaves; its weight is the product of the facets' reflectances
    pdf      (1 - q) p_1 + q cos / pi, close to the walks' and integrating to 1, for MIS

``p_1`` is the exact sampler's density, and ``q`` the light that meets more than one facet where
they reflect everything. The walk's own density has no closed form: a weight is that of the walk,
not ``eval / pdf``, and MIS stays unbiased because both strategies use the same ``pdf``.

Source: Heitz et al. 2016 (`walk`); masking is height-correlated, as the model has it.
"""

from __future__ import annotations

from typing import Any

from .energy import Loss
from .fresnel import fresnel_conductor
from .parameters import ConductorIndex, Roughness, optional_texture
from .runtime import dr, mi
from .walk import MAX_BOUNCES, Facets, advance, stream, uniform2

__all__ = ["Multibounce"]


class Multibounce:
    """The lobe behind ``specula_multibounce``.

    Parameters
    ----------
    props : mitsuba.Properties
        Those of ``specula_conductor`` without ``sampler``, ``masking`` and ``energy``.

    Raises
    ------
    ValueError
        Beckmann facets, which have no sampler for views from below.

    Notes
    -----
    Parameters can be changed but are not differentiable: a walk's length has no bound that reverse
    mode needs, and the weight of a walk is no ratio of `eval` and `pdf`. Evaluation is random, with
    numbers from a hash of the directions and the position: the same question gets the same answer.
    Rays that hit the same point again and again, as of a pinhole camera without jitter under a
    point light, would average nothing.
    """

    def __init__(self, props: Any) -> None:
        self.roughness = Roughness(props, ("exact",))
        if self.roughness.distribution != "ggx":
            raise ValueError(f"{props.plugin_name()}: walks are for GGX only")
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
        """Where a walk leaves, and its reflectances' product; `sample2` takes the first facet."""
        sampled = dr.zeros(mi.BSDFSample3f)
        active = mi.Mask(active) & (si.wi.z > 0)
        if not ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0):
            return sampled, mi.Spectrum(0)
        with dr.suspend_grad():
            facets = self._facets(si, active)
            rng = stream(sample1, sample2.x, sample2.y)
            wo, weight = _leave(facets, si.wi, sample2, rng, active)
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
            m = dr.normalize(wi + wo)
            single = facets.reflectance(dr.dot(wi, m))
            single *= 0.25 * facets.ggx.d(m) * facets.ggx.g2_over_cos(wi, wo, True)
            rng = stream(wi.x, wi.y, wo.x, wo.y, p.x, p.y, p.z, si.uv.x, si.uv.y)
            value = single + _connections(facets, wi, wo, rng, active)
        return dr.select(active, value, 0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density for multiple importance sampling, 1/sr; integrates to 1."""
        enabled = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
        active = mi.Mask(active) & (si.wi.z > 0) & (wo.z > 0) & enabled
        with dr.suspend_grad():
            ggx = self.roughness.at(si, active)
            m = dr.normalize(si.wi + wo)
            once = 0.25 * ggx.d(m) / ggx.norm(si.wi)
            share = dr.maximum(self.loss.directional(ggx, si.wi), 1e-3)
            return dr.select(active, dr.lerp(once, wo.z * dr.inv_pi, share), 0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        return f"SpeculaMultibounce[{self.roughness!r}]"

    def _facets(self, si: Any, active: Any) -> Facets:
        eta, k = self.index.at(si, active)
        tint = mi.Spectrum(1)
        if self.reflectance is not None:
            tint = self.reflectance.eval(si, active)
        ggx = self.roughness.at(si, active)
        return Facets(ggx, lambda cosine: fresnel_conductor(cosine, eta, k) * tint)


def _first(facets: Facets, wi: Any, u: Any, rng: Any) -> tuple[Any, Any, Any]:
    """Direction, depth and weight after the first facet."""
    d = -wi
    tau = advance(facets, d, mi.Float(0), rng)
    d, weight = facets.bounce(d, u)
    return d, advance(facets, d, tau, rng), weight


def _leave(facets: Facets, wi: Any, u: Any, rng: Any, active: Any) -> tuple[Any, Any]:
    """The direction in which a walk leaves, and its weight; 0 for one that does not."""
    d, tau, weight = _first(facets, wi, u, rng)

    def body(d: Any, tau: Any, weight: Any, bounces: Any, rng: Any) -> tuple[Any, ...]:
        d, fresnel = facets.bounce(d, uniform2(rng))
        tau = advance(facets, d, tau, rng)
        return d, tau, weight * fresnel, bounces + 1, rng

    d, tau, weight, _, _ = dr.while_loop(
        (d, tau, mi.Spectrum(weight), mi.UInt32(1), rng),
        lambda d, tau, weight, bounces, rng: active & (tau >= 0) & (bounces < MAX_BOUNCES),
        body,
        labels=("d", "tau", "weight", "bounces", "rng"),
    )
    return d, dr.select(tau < 0, weight, 0)


def _connections(facets: Facets, wi: Any, wo: Any, rng: Any, active: Any) -> Any:
    """The estimate of all light that leaves along `wo` after two bounces or more."""
    d, tau, weight = _first(facets, wi, uniform2(rng), rng)
    leaving = facets.rate(wo)

    def body(
        d: Any, tau: Any, weight: Any, total: Any, bounces: Any, rng: Any
    ) -> tuple[Any, ...]:
        total = total + weight * facets.phase(d, wo) * dr.exp(-tau * leaving)
        d, fresnel = facets.bounce(d, uniform2(rng))
        tau = advance(facets, d, tau, rng)
        return d, tau, weight * fresnel, total, bounces + 1, rng

    state = dr.while_loop(
        (d, tau, mi.Spectrum(weight), mi.Spectrum(0), mi.UInt32(1), rng),
        lambda d, tau, weight, total, bounces, rng: (
            active & (tau >= 0) & (bounces < MAX_BOUNCES)
        ),
        body,
        labels=("d", "tau", "weight", "total", "bounces", "rng"),
    )
    return state[3]
