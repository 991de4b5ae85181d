"""``specula_multibounce_dielectric``: rough glass with all bounces on both sides, by random walks.

    eval     an unbiased estimate of all light, connected to the direction at every facet
    sample   a walk until it leaves on either side; it loses nothing, so its weight is 1
    pdf      (1 - s) p_1 + s |cos| / (2 pi), close to the walks' and integrating to 1, for MIS

``p_1`` is the density of directions after the first facet, over the sphere.

Each side has its own frame, turned so that up leads out. With ``tau = -ln C1`` the depth on one
side, the other's is ``-ln(1 - exp(-tau))``. Facets reflect with probability ``F``, or refract:

    F D / (4 sigma(-d)),   (1 - F) D |d.m| eta^2 |w.m| / (sigma(-d) (|d.m| + eta w.m)^2)

Source: Heitz et al. 2016; `interface.rs` and `mis_pdf.rs` of `crates/specula-bsdf/src/multibounce`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from . import sampling
from .dielectric import Dielectric
from .runtime import dr, mi
from .walk import MAX_BOUNCES, Facets, advance, stream, uniform2

__all__ = ["MultibounceDielectric"]


@dataclass(frozen=True)
class _At:
    """A facet that a flight meets."""

    #: Direction of the flight, in the frame of its side.
    d: Any
    tau: Any
    #: Index beyond over that of this side.
    eta: Any
    #: Whether this side is not that of the view.
    is_beyond: Any


class MultibounceDielectric:
    """The lobe behind ``specula_multibounce_dielectric``.

    Parameters
    ----------
    props : mitsuba.Properties
        Those of ``specula_dielectric`` without ``sampler`` and ``energy``.

    Raises
    ------
    ValueError
        Beckmann facets, which have no sampler for views from below; wrong indices.

    Notes
    -----
    Parameters can be changed but are not differentiable, and evaluation is random, as with
    ``specula_multibounce``.
    """

    def __init__(self, props: Any) -> None:
        for name in ("sampler", "energy"):
            if name in props:
                raise ValueError(f"{props.plugin_name()}: walks have no '{name}'")
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
            start = _At(-wi, advance(facets, -wi, mi.Float(0), rng), eta, mi.Mask(False))
            first = _bounce(facets, start, sample1, sample2, rng)
            at = _walk(facets, first, rng, active)
            is_reflected = at.is_beyond ^ True
            wo = mi.Vector3f(at.d)
            wo.z = dr.select(is_reflected, wo.z, -wo.z)
            wo.z = dr.mulsign(wo.z, si.wi.z)
            active &= (at.tau < 0) & (wo.z != 0)
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
            start = _At(-wi, advance(facets, -wi, mi.Float(0), rng), eta, mi.Mask(False))
            value = _connections(facets, start, wo, rng, active)
            tint = self.single.tint(ctx, si, is_reflected, eta, active)
            return dr.select(active, tint * value, 0)

    def pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
        """Density for multiple importance sampling, 1/sr."""
        with dr.suspend_grad():
            wi, eta = self.single.upper(si)
            wo = mi.Vector3f(wo.x, wo.y, dr.mulsign(wo.z, si.wi.z))
            active = mi.Mask(active) & (si.wi.z != 0) & (wo.z != 0) & _enabled(ctx, wo.z > 0)
            facets = self._facets(si, active)
            at = _At(-wi, mi.Float(0), eta, mi.Mask(False))
            # The first flight may go on downwards on either side: both branches reach everywhere.
            first = _phase(facets, at, wo, mi.Mask(True)) + _phase(facets, at, wo, mi.Mask(False))
            a4 = dr.square(facets.ggx.alpha_u * facets.ggx.alpha_v)
            share = dr.maximum(0.8 * a4 / (a4 + 0.15), 0.002)
            pdf = dr.lerp(first, dr.abs(wo.z) * (0.5 * dr.inv_pi), share)
            return dr.select(active, pdf, 0)

    def eval_pdf(self, ctx: Any, si: Any, wo: Any, active: Any = True) -> tuple[Any, Any]:
        """`eval` and `pdf`."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)

    def to_string(self) -> str:
        """For Mitsuba's logs."""
        return f"SpeculaMultibounceDielectric[{self.single.roughness!r}, eta={self.single.eta}]"

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


def _depth_beyond(tau: Any) -> Any:
    """The depth as the other side sees it; a ray at the top is infinitely deep there."""
    share = dr.select(tau < 1e-3, tau * (1 - 0.5 * tau), 1 - dr.exp(-tau))
    return dr.maximum(-dr.log(dr.maximum(share, 1e-30)), 0)


def _turned(w: Any) -> Any:
    return mi.Vector3f(w.x, w.y, -w.z)


def _bounce(facets: Facets, at: _At, u: Any, u2: Any, rng: Any) -> _At:
    """The flight after a facet, and the depth of what it meets next: below 0 where it leaves."""
    ggx = facets.ggx
    m = dr.normalize(sampling.cap_half_vector(ggx.alpha_u, ggx.alpha_v, -at.d, u2))
    cosine = -dr.dot(at.d, m)
    fresnel, cos_t, _, eta_ti = mi.fresnel(cosine, at.eta)
    crosses = u >= fresnel
    bent = _turned(m * (cosine * eta_ti + cos_t) + at.d * eta_ti)
    d = dr.normalize(dr.select(crosses, bent, at.d + 2 * cosine * m))
    tau = dr.select(crosses, _depth_beyond(at.tau), at.tau)
    eta = dr.select(crosses, dr.rcp(at.eta), at.eta)
    return _At(d, advance(facets, d, tau, rng), eta, at.is_beyond ^ crosses)


def _phase(facets: Facets, at: _At, w: Any, reflects: Any) -> Any:
    """Density of the directions after a facet towards `w`, by one branch."""
    half = w * dr.select(reflects, 1, at.eta) - at.d
    length2 = dr.squared_norm(half)
    m = half * dr.rsqrt(dr.maximum(length2, 1e-20))
    m = dr.mulsign(m, m.z)
    cos_d, cos_w = -dr.dot(at.d, m), dr.dot(w, m)
    lit = (length2 > 1e-12) & (cos_d > 0) & (dr.select(reflects, cos_w, -cos_w) > 0)
    fresnel = mi.fresnel(cos_d, at.eta)[0]
    jacobian = dr.square(at.eta) * dr.abs(cos_w) * cos_d
    jacobian /= dr.maximum(dr.square(cos_d + at.eta * cos_w), 1e-12)
    branch = dr.select(reflects, 0.25 * fresnel, (1 - fresnel) * jacobian)
    return dr.select(lit, branch * facets.ggx.d(m) / facets.facing(at.d), 0)


def _connection(facets: Facets, at: _At, wo: Any) -> Any:
    """`_phase` times the probability of leaving along `wo`, in the view's frame."""
    w = mi.Vector3f(wo.x, wo.y, dr.select(at.is_beyond, -wo.z, wo.z))
    depth = dr.select(w.z > 0, at.tau, _depth_beyond(at.tau))
    rate = facets.ggx.lambda_cos(w) / dr.maximum(dr.abs(w.z), 1e-12)
    return _phase(facets, at, w, w.z > 0) * dr.exp(-depth * rate)


def _walk(facets: Facets, at: _At, rng: Any, active: Any) -> _At:
    """The state in which a walk leaves; its depth is not below 0 where it does not."""

    def body(d: Any, tau: Any, eta: Any, beyond: Any, bounces: Any, rng: Any) -> tuple[Any, ...]:
        u = rng.next_float32()
        after = _bounce(facets, _At(d, tau, eta, beyond), u, uniform2(rng), rng)
        return after.d, after.tau, after.eta, after.is_beyond, bounces + 1, rng

    state = dr.while_loop(
        (at.d, at.tau, at.eta, at.is_beyond, mi.UInt32(1), rng),
        lambda d, tau, eta, beyond, bounces, rng: active & (tau >= 0) & (bounces < MAX_BOUNCES),
        body,
        labels=("d", "tau", "eta", "beyond", "bounces", "rng"),
    )
    return _At(*state[:4])


def _connections(facets: Facets, at: _At, wo: Any, rng: Any, active: Any) -> Any:
    """The estimate of all light that leaves along `wo`."""

    def body(
        d: Any, tau: Any, eta: Any, beyond: Any, total: Any, bounces: Any, rng: Any
    ) -> tuple[Any, ...]:
        here = _At(d, tau, eta, beyond)
        total = total + _connection(facets, here, wo)
        u = rng.next_float32()
        after = _bounce(facets, here, u, uniform2(rng), rng)
        return after.d, after.tau, after.eta, after.is_beyond, total, bounces + 1, rng

    state = dr.while_loop(
        (at.d, at.tau, at.eta, at.is_beyond, mi.Float(0), mi.UInt32(0), rng),
        lambda d, tau, eta, beyond, total, bounces, rng: (
            active & (tau >= 0) & (bounces < MAX_BOUNCES)
        ),
        body,
        labels=("d", "tau", "eta", "beyond", "total", "bounces", "rng"),
    )
    return state[4]
