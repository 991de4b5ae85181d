"""``specula_dielectric``: rough glass, Mitsuba's ``roughdielectric``, its branch better chosen.

A visible normal ``m`` is sampled, then the branch by what it contributes, not by Fresnel's term:

    r = F G2(wi, wr),  t = (1 - F) G2(wi, wt),  0 where below (above) the horizon
    p = r / (r + t),   weight = (r + t) / G1(wi)   on both branches

so that no sample is lost where light enters the denser medium. Values are ``roughdielectric``'s.

``energy`` ``kulla_conty`` adds a second lobe on both sides for what single scattering loses, with
``L_n``, ``L_f`` the losses seen from the side of the view and from beyond:

    reflection    f = f_ss + (1 - t) L_n(wi) L_n(wo) / (pi L_n,avg)
    transmission  f = f_ss + t L_n(wi) L_f(wo) / (pi L_f,avg)  [/ eta^2 for radiance]
    t = (1 - F_avg(eta)) min(L_n,avg, L_f,avg) / L_n,avg

Source: Walter et al. 2007, eqs. 20 and 21; Specula, ``docs/exact-reflection-sampling.md``
(*Refraction*); Kulla and Conty 2017, `crates/specula-bsdf/src/bsdf/compensated_dielectric.rs`.
Bounded and exact samplers know reflections only: here all normals are needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .energy import DielectricLoss
from .fresnel import dielectric_average
from .parameters import Roughness, choice, differentiable, optional_texture
from .runtime import dr, is_jit, mi

__all__ = ["Dielectric"]


@dataclass(frozen=True)
class _Branches:
    """Both directions off one facet, in the frame whose upper side holds the view."""

    #: Cosine of incidence, and the refracted one (negative; 0 at total reflection).
    cos_i: Any
    cos_t: Any
    #: What the branches contribute, G1(wi) included.
    reflected: Any
    refracted: Any
    #: Directions.
    wr: Any
    wt: Any

    @property
    def share(self) -> Any:
        """Probability of the reflection."""
        total = self.reflected + self.refracted
        return dr.select(total > 0, self.reflected / dr.maximum(total, 1e-30), 0)


@dataclass(frozen=True)
class _Second:
    """The second lobe as a view sees it."""

    #: ``L_n(wi)``: what single scattering loses, and the probability of sampling this lobe.
    loss: Any
    #: Probability of transmission.
    transmitted: Any
    #: Share of the lost light in each branch; 0 where the context excludes it.
    reflected_share: Any
    transmitted_share: Any
    #: ``L_n,avg`` and ``L_f,avg``.
    near: Any
    far: Any


class Dielectric:
    """The lobe behind ``specula_dielectric``.

    Parameters
    ----------
    props : mitsuba.Properties
        ``int_ior``, ``ext_ior`` (names or numbers, ``bk7`` and ``air``); ``alpha``, or ``alpha_u``
        and ``alpha_v``; ``distribution`` (``ggx``, ``beckmann``); ``specular_reflectance``;
        ``specular_transmittance``; ``sampler`` of GGX (``cap``, ``heitz``); ``energy`` (``none``,
        ``kulla_conty``).

    Raises
    ------
    ValueError
        Indices that are not positive or equal, or an unknown name.

    Notes
    -----
    Masking is separable, as Mitsuba's. Scalar variants do not report ``eta``:
    their numbers cannot be changed in place. GGX refracts off facets seen edge-on, ``m.z = 0``, to
    an edge that moves with ``eta``: the derivative by ``eta`` leaves its motion out, as path replay
    over ``roughdielectric`` does (6 % at alpha 0.4). Alphas have no such edge.
    """

    def __init__(self, props: Any) -> None:
        self.roughness = Roughness(props, ("cap", "heitz"))
        inside = float(mi.lookup_ior(props, "int_ior", "bk7"))
        outside = float(mi.lookup_ior(props, "ext_ior", "air"))
        if inside <= 0 or outside <= 0 or inside == outside:
            raise ValueError(
                f"{props.plugin_name()}: 'int_ior' and 'ext_ior' must be positive and differ"
            )
        self.eta = mi.Float(inside / outside)
        self.reflectance = optional_texture(props, "specular_reflectance")
        self.transmittance = optional_texture(props, "specular_transmittance")
        self.loss: DielectricLoss | None = None
        if choice(props, "energy", ("none", "kulla_conty")) == "kulla_conty":
            self.loss = DielectricLoss(self.roughness.distribution, self.roughness.isotropic)
        self.parameters_changed([])

    def components(self) -> list[int]:
        """Flags of reflection and transmission, seen from both sides."""
        sides = int(mi.BSDFFlags.FrontSide) | int(mi.BSDFFlags.BackSide)
        sides |= self.roughness.extra_flags
        through = int(mi.BSDFFlags.GlossyTransmission) | int(mi.BSDFFlags.NonSymmetric)
        return [int(mi.BSDFFlags.GlossyReflection) | sides, through | sides]

    def traverse(self, callback: Any) -> None:
        """Report parameters under ``roughdielectric``'s names."""
        if is_jit():
            callback.put("eta", self.eta, differentiable())
        self.roughness.traverse(callback)
        if self.reflectance is not None:
            callback.put("specular_reflectance", self.reflectance, differentiable(False))
        if self.transmittance is not None:
            callback.put("specular_transmittance", self.transmittance, differentiable(False))

    def parameters_changed(self, keys: list[str]) -> None:
        """Keep the index out of compiled kernels: another index is no other kernel."""
        if is_jit():
            dr.make_opaque(self.eta)

    def sample(
        self, ctx: Any, si: Any, sample1: Any, sample2: Any, active: Any = True
    ) -> tuple[Any, Any]:
        """A direction and its weight; `sample1` chooses the branch."""
        active = mi.Mask(active) & (si.wi.z != 0)
        with dr.suspend_grad():
            wi, eta = self.upper(si)
            facets = self.roughness.at(si, active)
            branches = self._branches(ctx, facets, wi, facets.half_vector(wi, sample2), eta)
            second = self._second(ctx, facets, wi, eta)
            is_second = mi.Mask(False)
            if second is not None:
                is_second = sample1 < second.loss
                sample1 = (sample1 - second.loss) / dr.maximum(1 - second.loss, 1e-7)
            is_reflected = (sample1 < branches.share) | (branches.refracted <= 0)
            wo = dr.select(is_reflected, branches.wr, branches.wt)
            # A facet that reflects totally, and downwards: nothing leaves.
            active &= (branches.reflected + branches.refracted > 0) | is_second
            if second is not None:
                through = sample1 * (1 - second.loss) + second.loss
                through = is_second & (through < second.loss * second.transmitted)
                up = mi.warp.square_to_cosine_hemisphere(sample2)
                up.z = dr.select(through, -up.z, up.z)
                wo = dr.select(is_second, up, wo)
                is_reflected = dr.select(is_second, ~through, is_reflected)
            wo.z = dr.mulsign(wo.z, si.wi.z)
        value, pdf = self.eval_pdf(ctx, si, wo, active)
        pdf = dr.select(active, pdf, 0)
        valid = pdf > 0
        sampled = dr.zeros(mi.BSDFSample3f)
        sampled.wo = wo
        sampled.pdf = pdf
        sampled.eta = dr.select(is_reflected, mi.Float(1), eta)
        kinds = mi.BSDFFlags.GlossyReflection, mi.BSDFFlags.GlossyTransmission
        sampled.sampled_type = dr.select(is_reflected, mi.UInt32(+kinds[0]), mi.UInt32(+kinds[1]))
        sampled.sampled_component = dr.select(is_reflected, mi.UInt32(0), mi.UInt32(1))
        detached = dr.detach(pdf)
        return sampled, dr.select(valid, value * dr.rcp(dr.select(valid, detached, 1)), 0)

    def eval(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """``f |cos|`` (spectrum, 1/sr), of radiance or importance as the context says."""
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density of `sample`, 1/sr."""
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`, which share their work."""
        wi, eta = self.upper(si)
        wo = mi.Vector3f(wo.x, wo.y, dr.mulsign(wo.z, si.wi.z))
        is_reflected = wo.z > 0
        half = wi + wo * dr.select(is_reflected, 1, eta)
        length2 = dr.squared_norm(half)
        m = half * dr.rsqrt(dr.maximum(length2, 1e-20))
        m = dr.mulsign(m, m.z)
        facing = (dr.dot(wi, m) > 0) & (dr.dot(wo, m) * wo.z > 0)
        active = mi.Mask(active) & (si.wi.z != 0) & (wo.z != 0)
        on_facet = facing & (length2 > 1e-20)

        facets = self.roughness.at(si, active)
        branches = self._branches(ctx, facets, wi, m, eta)
        jacobian = dr.square(eta) * dr.abs(branches.cos_t) / dr.maximum(
            dr.square(branches.cos_i + eta * branches.cos_t), 1e-20
        )
        # From the density of visible normals to that of directions.
        jacobian = dr.select(is_reflected, 0.25, branches.cos_i * jacobian)
        spread = facets.d(m) * jacobian
        contribution = dr.select(is_reflected, branches.reflected, branches.refracted)
        on_facet &= contribution > 0
        value = dr.select(on_facet, spread * contribution / wi.z, 0)
        chosen = dr.select(is_reflected, branches.share, 1 - branches.share)
        pdf = dr.select(on_facet, spread * chosen / facets.norm(wi), 0)
        second = self._second(ctx, facets, wi, eta)
        if second is not None and self.loss is not None:
            cosine = dr.abs(wo.z) * dr.inv_pi
            beyond = dr.select(is_reflected, eta, dr.rcp(eta))
            shape = self.loss.directional(facets, beyond, wo)
            shape /= dr.select(is_reflected, second.near, second.far)
            light = dr.select(is_reflected, second.reflected_share, second.transmitted_share)
            value += second.loss * shape * cosine * light
            share = dr.select(is_reflected, 1 - second.transmitted, second.transmitted)
            pdf = dr.lerp(pdf, share * cosine, second.loss)
        value = self.tint(ctx, si, is_reflected, eta, active) * value
        return dr.select(active, value, 0), dr.select(active, pdf, 0)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        energy = "none" if self.loss is None else "kulla_conty"
        return f"SpeculaDielectric[{self.roughness!r}, eta={self.eta}, energy={energy}]"

    def _second(self, ctx: Any, facets: Any, wi: Any, eta: Any) -> _Second | None:
        """The second lobe, ``None`` without; `wi` above the horizon, `eta` beyond it."""
        if self.loss is None:
            return None
        near, far = (self.loss.average(facets, e) for e in (eta, dr.rcp(eta)))
        transmitted = (1 - dielectric_average(eta)) * dr.minimum(near, far) / near
        reflects = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
        refracts = ctx.is_enabled(mi.BSDFFlags.GlossyTransmission, 1)
        chosen = transmitted if reflects and refracts else mi.Float(1.0 if refracts else 0.0)
        loss = self.loss.directional(facets, eta, wi)
        return _Second(
            loss,
            chosen,
            (1 - transmitted) if reflects else mi.Float(0),
            transmitted if refracts else mi.Float(0),
            near,
            far,
        )

    def upper(self, si: Any) -> tuple[Any, Any]:
        """The view mirrored above the horizon, and the index beyond relative to its side."""
        wi = mi.Vector3f(si.wi.x, si.wi.y, dr.maximum(dr.abs(si.wi.z), 1e-12))
        return wi, dr.select(si.wi.z > 0, self.eta, dr.rcp(self.eta))

    def _branches(self, ctx: Any, facets: Any, wi: Any, m: Any, eta: Any) -> _Branches:
        """Both directions off the facet `m`; a branch that the context excludes has no share."""
        cos_i = dr.dot(wi, m)
        fresnel, cos_t, _, eta_ti = mi.fresnel(cos_i, eta)
        wr = 2 * cos_i * m - wi
        wt = m * (cos_i * eta_ti + cos_t) - wi * eta_ti
        reflects = ctx.is_enabled(mi.BSDFFlags.GlossyReflection, 0)
        refracts = ctx.is_enabled(mi.BSDFFlags.GlossyTransmission, 1)
        g_i = facets.g1(wi)

        def contribution(share: Any, w: Any, possible: Any) -> Any:
            mirrored = mi.Vector3f(w.x, w.y, dr.maximum(dr.abs(w.z), 1e-12))
            return dr.select(possible, share * g_i * facets.g1(mirrored), 0)

        reflected = contribution(fresnel, wr, (wr.z > 0) & reflects)
        refracted = contribution(1 - fresnel, wt, (wt.z < 0) & (cos_t < 0) & refracts)
        return _Branches(cos_i, cos_t, reflected, refracted, wr, wt)

    def tint(self, ctx: Any, si: Any, is_reflected: Any, eta: Any, active: Any) -> Any:
        """Factors besides Fresnel's: textures, and the compression of radiance on refraction."""
        reflect, transmit = mi.Spectrum(1), mi.Spectrum(1)
        if self.reflectance is not None:
            reflect = self.reflectance.eval(si, active)
        if self.transmittance is not None:
            transmit = self.transmittance.eval(si, active)
        if ctx.mode == mi.TransportMode.Radiance:
            transmit *= dr.square(dr.rcp(eta))
        return dr.select(is_reflected, reflect, transmit)
