"""``specula_conductor``: rough metal, Mitsuba's ``roughconductor`` with Specula's samplers.

    f cos = F D(m) G2 / (4 wi.z),   pdf = D(m) / (4 N),   weight = F G2 N / wi.z

Without compensation the value is ``roughconductor``'s for the same parameters; the samplers differ
in ``N`` and so in variance. Energy (`energy`):

    turquin        f_ss (1 + F_0 L(wi) / E(wi))
    kulla_conty    f_ss + F_avg F_ms L(wi) L(wo) / (pi L_avg)
                   F_ms = F_avg E_avg / (1 - F_avg L_avg)

Source: `crates/specula-bsdf/src/bsdf/compensated.rs` and `energy/model.rs`; Turquin 2019; Kulla and
Conty 2017.
"""

from __future__ import annotations

from typing import Any

from .energy import Loss
from .fresnel import cosine_average, fresnel_conductor
from .parameters import ConductorIndex, Roughness, choice, differentiable, optional_texture
from .runtime import dr, mi

__all__ = ["Conductor"]


class Conductor:
    """The lobe behind ``specula_conductor``.

    Parameters
    ----------
    props : mitsuba.Properties
        ``material``, or ``eta`` and ``k``; ``alpha``, or ``alpha_u`` and ``alpha_v``;
        ``distribution`` (``ggx``, ``beckmann``); ``specular_reflectance``; ``sampler`` (``exact``,
        ``bounded``, ``cap``, ``heitz``); ``masking`` (``separable``, ``height_correlated``);
        ``energy`` (``none``, ``turquin``, ``kulla_conty``).

    Raises
    ------
    ValueError
        An unknown name, or a combination that has no meaning.

    Notes
    -----
    Samples carry no derivative themselves: the weight is ``f cos / pdf`` with the derivative of
    ``f cos``, so gradients stay right where the sampled ray passes an edge, and where Kulla and
    Conty's two lobes mix.
    """

    def __init__(self, props: Any) -> None:
        self.roughness = Roughness(props)
        self.index = ConductorIndex(props)
        self.reflectance = optional_texture(props, "specular_reflectance")
        masking = choice(props, "masking", ("separable", "height_correlated"))
        self.height_correlated = masking == "height_correlated"
        self.energy = choice(props, "energy", ("none", "turquin", "kulla_conty"))
        self.loss: Loss | None = None
        if self.energy != "none":
            roughness = self.roughness
            self.loss = Loss(roughness.distribution, self.height_correlated, roughness.isotropic)

    def components(self) -> list[int]:
        """Flags of each component: one, seen from the front."""
        flags = int(mi.BSDFFlags.GlossyReflection) | int(mi.BSDFFlags.FrontSide)
        return [flags | self.roughness.extra_flags]

    def traverse(self, callback: Any) -> None:
        """Report parameters under ``roughconductor``'s names."""
        if self.reflectance is not None:
            callback.put("specular_reflectance", self.reflectance, differentiable(False))
        self.roughness.traverse(callback)
        self.index.traverse(callback)

    def parameters_changed(self, keys: list[str]) -> None:
        """Nothing is derived from parameters."""

    def sample(
        self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True
    ) -> tuple[Any, Any]:
        """A reflection and its weight; `sample1` chooses between the lobes of ``kulla_conty``."""
        sampled = dr.zeros(mi.BSDFSample3f)
        active = mi.Mask(active) & (si.wi.z > 0)
        if not ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0):
            return sampled, mi.Spectrum(0)
        with dr.suspend_grad():
            wo = self._direction(si, sample1, sample2, active)
        value, pdf = self.eval_pdf(ctx, si, wo, active)
        valid = active & (pdf > 0)
        sampled.wo = wo
        sampled.pdf = pdf
        sampled.eta = mi.Float(1)
        sampled.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        sampled.sampled_component = mi.UInt32(0)
        return sampled, dr.select(valid, value * dr.rcp(_positive(dr.detach(pdf))), 0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """``f cos`` (spectrum, 1/sr)."""
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density of `sample`, 1/sr."""
        active = _above(ctx, si, wo, active)
        facets = self.roughness.at(si, active)
        m = dr.normalize(si.wi + wo)
        pdf = 0.25 * facets.d(m) / facets.norm(si.wi)
        if self.energy == "kulla_conty" and self.loss is not None:
            loss = self.loss.directional(facets, si.wi)
            colours = self._colours(si, facets, active)
            pdf = dr.lerp(pdf, wo.z * dr.inv_pi, _second_share(colours, loss))
        return dr.select(active, pdf, 0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`, which share most of their work."""
        active = _above(ctx, si, wo, active)
        wi = si.wi
        facets = self.roughness.at(si, active)
        m = dr.normalize(wi + wo)
        d = facets.d(m)
        facet = self._facet(si, active)
        value = facet(dr.dot(wi, m))
        value *= 0.25 * d * facets.g2_over_cos(wi, wo, self.height_correlated)
        pdf = 0.25 * d / facets.norm(wi)
        if self.loss is not None:
            loss = self.loss.directional(facets, wi)
            if self.energy == "turquin":
                value *= 1 + facet(mi.Float(1)) * (loss / dr.maximum(1 - loss, 1e-5))
            else:
                average, colour = self._colours(si, facets, active)
                cosine = wo.z * dr.inv_pi
                shape = loss * self.loss.directional(facets, wo) / self.loss.average(facets)
                value += colour * (shape * cosine)
                pdf = dr.lerp(pdf, cosine, _second_share((average, colour), loss))
        return dr.select(active, value, 0), dr.select(active, pdf, 0)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        return (
            f"SpeculaConductor[{self.roughness!r}, energy={self.energy},"
            f" height_correlated={self.height_correlated}]"
        )

    def _facet(self, si: Any, active: Any) -> Any:
        """The reflectance of a facet as a function of the cosine of incidence."""
        eta, k = self.index.at(si, active)
        tint = None if self.reflectance is None else self.reflectance.eval(si, active)

        def reflect(cosine: Any) -> Any:
            fresnel = fresnel_conductor(cosine, eta, k)
            return fresnel if tint is None else fresnel * tint

        return reflect

    def _colours(self, si: Any, facets: Any, active: Any) -> tuple[Any, Any]:
        """``F_avg`` and ``F_avg F_ms`` of Kulla and Conty."""
        average = cosine_average(self._facet(si, active))
        lost = self.loss.average(facets) if self.loss is not None else 0
        return average, dr.square(average) * (1 - lost) / dr.maximum(1 - average * lost, 1e-6)

    def _direction(self, si: Any, sample1: Any, sample2: Any, active: Any) -> Any:
        """A reflection, perhaps below the horizon (but for the exact sampler)."""
        facets = self.roughness.at(si, active)
        m = facets.half_vector(si.wi, sample2)
        wo = 2 * dr.dot(si.wi, m) * m - si.wi
        if self.energy == "kulla_conty" and self.loss is not None:
            loss = self.loss.directional(facets, si.wi)
            share = _second_share(self._colours(si, facets, active), loss)
            diffuse = mi.warp.square_to_cosine_hemisphere(sample2)
            wo = dr.select(sample1 < share, diffuse, wo)
        # Samplers are for views above the horizon: below, anything could come of them.
        return dr.select(active, wo, mi.Vector3f(0, 0, 1))


def _above(ctx: Any, si: Any, wo: Any, active: Any) -> Any:
    """Lanes where both directions lie above the horizon and reflection is asked for."""
    enabled = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
    return mi.Mask(active) & (si.wi.z > 0) & (wo.z > 0) & enabled


def _positive(pdf: Any) -> Any:
    """The density, or 1 where it is 0: derivatives of a masked quotient must be finite too."""
    return dr.select(pdf > 0, pdf, 1)


def _second_share(colours: tuple[Any, Any], loss: Any) -> Any:
    """Probability of sampling Kulla and Conty's second lobe: its share of the light."""
    average, colour = colours
    second = dr.max(colour) * loss
    first = dr.max(average) * (1 - loss)
    return dr.select(second > 0, second / dr.maximum(second + first, 1e-12), 0)
