//! `principled`: a closed surface.

use super::gtr1::Gtr1;
use super::opaque::{Opaque, Shares};
use super::terms::{distribution, hue, normal_reflectance, sheen_colour};
use super::{BsdfSample, PrincipledParameters, Transport};
use crate::fresnel::{Refraction, dielectric, refract};
use crate::math::{Real, Rgb, Vec3, warp};
use crate::ndf::{Masking, Ndf};
use crate::vndf::{Sampler, VisibleNormals, reflect};

/// Seen from one side; from inside only refraction and its reflection are left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Solid<T> {
    pub(super) opaque: Opaque<T>,
    /// Weight of refraction.
    pub(super) through: T,
}

impl<T: Real> Solid<T> {
    /// * `p`: shares in `[0, 1]`, `eta` not 1.
    #[inline]
    pub(super) fn new(p: &PrincipledParameters<T>) -> Self {
        let opaque = T::ONE - p.metallic;
        let front = |weight: T| T::select(p.outside, weight, T::ZERO);
        let through = opaque * p.spec_trans;
        let eta = T::select(p.outside, p.eta, T::ONE / p.eta);
        let opaque = Opaque {
            ggx: distribution(p.roughness, p.anisotropic),
            base: p.base_colour,
            tinted_f0: hue(p.base_colour) * normal_reflectance(eta),
            sheen: sheen_colour(p.base_colour, p.sheen_tint) * front(p.sheen * opaque),
            roughness: p.roughness,
            flatness: p.flatness,
            dielectric: T::select(p.outside, opaque * (T::ONE - p.spec_tint), through),
            tinted: front(opaque * p.spec_tint),
            metallic: front(p.metallic),
            diffuse: front(opaque * (T::ONE - p.spec_trans)),
            clearcoat: front(T::of(0.25) * p.clearcoat),
            gtr1: Gtr1::of_gloss(p.clearcoat_gloss),
            eta,
        };
        Self { opaque, through }
    }

    #[inline(always)]
    pub(super) fn base(&self) -> Rgb<T> {
        self.opaque.base
    }

    /// Colour of refraction.
    #[inline(always)]
    fn passing(&self) -> Rgb<T> {
        self.opaque.base.map(|c| c.sqrt()) * self.through
    }

    #[inline]
    fn shares(&self, wo: Vec3<T>) -> Shares<T> {
        self.opaque.shares(wo, self.passing().max_channel())
    }

    /// Probability of reflection at a facet, where there is refraction.
    #[inline(always)]
    fn reflection_share(&self, cos: T, bent: &Refraction<T>) -> T {
        let reflecting = self.opaque.fresnel(cos, bent).max_channel();
        let passing = self.passing().max_channel() * bent.transmittance;
        reflecting / (reflecting + passing).at_least(T::TINY)
    }

    /// Reflection where there is refraction, whose sampler takes all visible normals.
    #[inline]
    fn reflection(&self, shares: &Shares<T>, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let wm = (wo + wi).normalize_any();
        // A half vector of zero length is NaN here.
        let facing = wm.z > T::ZERO;
        if !facing {
            return (Rgb::BLACK, T::ZERO);
        }
        let cos = wo.dot(wm);
        let bent = dielectric(cos, self.opaque.eta);
        let norm = self.opaque.ggx.reflection_norm(Sampler::Cap, wo);
        let specular = shares.specular * self.reflection_share(cos, &bent);
        self.opaque
            .at_facet(*shares, (specular, norm), &bent, [wo, wi, wm])
    }

    #[inline]
    fn transmission(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
    ) -> (Rgb<T>, T) {
        let generalised = wo + wi * self.opaque.eta;
        let wm = (generalised * T::ONE.copysign(generalised.z)).normalize_any();
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        // Facets seen from behind do not scatter; a half vector of zero length is NaN here.
        let lit = cos_o > T::ZERO && cos_i < T::ZERO;
        if !lit {
            return (Rgb::BLACK, T::ZERO);
        }
        let bent = dielectric(cos_o, self.opaque.eta);
        let sum = cos_o + self.opaque.eta * cos_i;
        let jacobian = self.opaque.eta * self.opaque.eta * -cos_i / (sum * sum).at_least(T::TINY);
        let visible = self.opaque.ggx.d(wm) * cos_o * jacobian;
        let shadowed = self.opaque.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let scale = radiance_scale(self.opaque.eta, transport) * bent.transmittance;
        let p = shares.specular * (T::ONE - self.reflection_share(cos_o, &bent));
        (
            self.passing() * (scale * visible * shadowed),
            p * visible / self.opaque.ggx.projected_area(wo),
        )
    }

    #[inline]
    pub(super) fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        if self.through <= T::ZERO {
            return if wi.z > T::ZERO {
                self.opaque.eval_pdf(wo, wi)
            } else {
                (Rgb::BLACK, T::ZERO)
            };
        }
        let shares = self.shares(wo);
        if wi.z > T::ZERO {
            self.reflection(&shares, wo, wi)
        } else if wi.z < T::ZERO {
            self.transmission(&shares, wo, wi, transport)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    #[inline]
    pub(super) fn sample(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
    ) -> Option<BsdfSample<T>> {
        if self.through <= T::ZERO {
            return self.opaque.sample_alone(wo, u);
        }
        let shares = self.shares(wo);
        let direction = [u[1], u[2]];
        let before = shares.diffuse + shares.clearcoat;
        let wi = if u[0] < shares.diffuse {
            warp::cosine_hemisphere(direction)
        } else if u[0] < before {
            reflect(wo, self.opaque.gtr1.sample_wm(direction))
        } else {
            let wm = self.opaque.ggx.sample_wm(wo, direction);
            let cos = wo.dot(wm);
            let bent = dielectric(cos, self.opaque.eta);
            let rest = (u[0] - before) / shares.specular.at_least(T::TINY);
            if rest < self.reflection_share(cos, &bent) {
                reflect(wo, wm)
            } else {
                return self.transmitted(wo, wm, cos, &bent, (&shares, transport));
            }
        };
        if wi.z <= T::ZERO {
            return None;
        }
        let (f_cos, pdf) = self.reflection(&shares, wo, wi);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }

    /// Refraction at the facet `wm`, its weight in the cancelled form.
    #[inline]
    fn transmitted(
        &self,
        wo: Vec3<T>,
        wm: Vec3<T>,
        cos_o: T,
        bent: &Refraction<T>,
        (shares, transport): (&Shares<T>, Transport),
    ) -> Option<BsdfSample<T>> {
        let wi = refract(wo, wm, cos_o, bent.cos_t, self.opaque.eta);
        let p = shares.specular * (T::ONE - self.reflection_share(cos_o, bent));
        let sum = cos_o - self.opaque.eta * bent.cos_t;
        let jacobian =
            self.opaque.eta * self.opaque.eta * bent.cos_t / (sum * sum).at_least(T::TINY);
        let sigma = self.opaque.ggx.projected_area(wo);
        let pdf = p * self.opaque.ggx.d(wm) * cos_o * jacobian / sigma;
        let shadowed = sigma * self.opaque.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let scale = radiance_scale(self.opaque.eta, transport) * bent.transmittance;
        let weight = self.passing() * (scale * shadowed / p);
        if bent.transmittance > T::ZERO {
            BsdfSample::transmitted(wi, weight, pdf, self.opaque.eta)
        } else {
            None
        }
    }
}

/// Refraction compresses radiance.
#[inline(always)]
fn radiance_scale<T: Real>(eta: T, transport: Transport) -> T {
    match transport {
        Transport::Radiance => T::ONE / (eta * eta),
        Transport::Importance => T::ONE,
    }
}
