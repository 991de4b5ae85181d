//! `principled`: a closed surface.

use super::gtr1::Gtr1;
use super::terms::{
    diffuse, distribution, hue, normal_reflectance, schlick, schlick_weight_across, sheen_colour,
};
use super::{BsdfSample, PrincipledParameters, Transport};
use crate::fresnel::{Refraction, dielectric, refract};
use crate::math::{Real, Rgb, Vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::{Sampler, VisibleNormals, reflect};

/// Seen from one side; from inside only refraction and its reflection are left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Solid<T> {
    ggx: Ggx<T>,
    base: Rgb<T>,
    /// `F0` of the tinted part of the dielectric reflection.
    tinted_f0: Rgb<T>,
    /// Weight times colour.
    sheen: Rgb<T>,
    roughness: T,
    flatness: T,
    /// Weights of the parts of the Fresnel term.
    dielectric: T,
    tinted: T,
    metallic: T,
    /// Weight of the diffuse part.
    diffuse: T,
    /// Weight of refraction.
    through: T,
    /// A quarter of the parameter.
    clearcoat: T,
    gtr1: Gtr1<T>,
    /// Index beyond over that on the side of `wo`.
    eta: T,
}

/// Probabilities of the sampler's parts.
#[derive(Clone, Copy)]
struct Shares<T> {
    diffuse: T,
    clearcoat: T,
    specular: T,
}

impl<T: Real> Solid<T> {
    /// * `p`: shares in `[0, 1]`, `eta` not 1.
    #[inline]
    pub(super) fn new(p: &PrincipledParameters<T>) -> Self {
        let opaque = T::ONE - p.metallic;
        let front = |weight: T| T::select(p.outside, weight, T::ZERO);
        let through = opaque * p.spec_trans;
        let eta = T::select(p.outside, p.eta, T::ONE / p.eta);
        Self {
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
            through,
            clearcoat: front(T::of(0.25) * p.clearcoat),
            gtr1: Gtr1::of_gloss(p.clearcoat_gloss),
            eta,
        }
    }

    #[inline(always)]
    pub(super) fn base(&self) -> Rgb<T> {
        self.base
    }

    /// Refraction samples all visible normals; without it the bounded cap does.
    #[inline(always)]
    fn sampler(&self) -> Sampler {
        if self.through > T::ZERO {
            Sampler::Cap
        } else {
            Sampler::Bounded
        }
    }

    /// The Fresnel term of the main reflection.
    #[inline(always)]
    fn fresnel(&self, cos: T, bent: &Refraction<T>) -> Rgb<T> {
        let s = schlick_weight_across(cos, bent, self.eta);
        Rgb::splat(self.dielectric * bent.reflectance)
            + schlick(self.base, s) * self.metallic
            + schlick(self.tinted_f0, s) * self.tinted
    }

    /// The clear coat's Fresnel term times its weight.
    #[inline(always)]
    fn coat_fresnel(&self, cos: T, bent: &Refraction<T>) -> T {
        let s = schlick_weight_across(cos, bent, self.eta);
        self.clearcoat * (T::of(0.04) + T::of(0.96) * s)
    }

    /// Colour of refraction.
    #[inline(always)]
    fn passing(&self) -> Rgb<T> {
        self.base.map(|c| c.sqrt()) * self.through
    }

    #[inline]
    fn shares(&self, wo: Vec3<T>) -> Shares<T> {
        let cos = wo.z.abs();
        let bent = dielectric(cos, self.eta);
        let passing = self.passing().max_channel() * bent.transmittance;
        let reflecting = self.fresnel(cos, &bent).max_channel();
        let specular = reflecting + passing;
        let diffuse =
            self.diffuse * self.base.max_channel() + T::of(0.1) * self.sheen.max_channel();
        // Without the factor 1 / (4 cos cos) the coat's light falls with the square of the cosine.
        let clearcoat = T::of(4.0) * self.coat_fresnel(cos, &bent) * cos * cos;
        let scale = T::ONE / (specular + diffuse + clearcoat).at_least(T::TINY);
        Shares {
            diffuse: diffuse * scale,
            clearcoat: clearcoat * scale,
            specular: specular * scale,
        }
    }

    /// Probability of reflection at a facet.
    #[inline(always)]
    fn reflection_share(&self, cos: T, bent: &Refraction<T>) -> T {
        if self.through > T::ZERO {
            let reflecting = self.fresnel(cos, bent).max_channel();
            let passing = self.passing().max_channel() * bent.transmittance;
            reflecting / (reflecting + passing).at_least(T::TINY)
        } else {
            T::ONE
        }
    }

    #[inline]
    fn reflection(&self, shares: &Shares<T>, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let wm = (wo + wi).normalize_any();
        // A half vector of zero length is NaN here.
        let facing = wm.z > T::ZERO;
        if !facing {
            return (Rgb::BLACK, T::ZERO);
        }
        let cos = wo.dot(wm);
        let bent = dielectric(cos, self.eta);
        let quarter = T::of(0.25) * self.ggx.d(wm);
        let shadowed = self.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let mut f_cos = self.fresnel(cos, &bent) * (quarter * shadowed);
        let norm = self.ggx.reflection_norm(self.sampler(), wo);
        let mut pdf = shares.specular * self.reflection_share(cos, &bent) * quarter / norm;
        if self.diffuse > T::ZERO {
            let shape = diffuse(wo.z.abs(), wi.z, cos, self.roughness, self.flatness);
            f_cos += self.base * (self.diffuse * shape * wi.z * T::INV_PI);
        }
        f_cos += self.sheen * (super::terms::schlick_weight(cos) * wi.z);
        pdf += shares.diffuse * wi.z * T::INV_PI;
        if self.clearcoat > T::ZERO {
            let d = self.gtr1.d(wm);
            let coat = self.coat_fresnel(cos, &bent) * d * Gtr1::masking(wo, wi) * wi.z;
            f_cos += Rgb::splat(coat);
            pdf += shares.clearcoat * d * wm.z / (T::of(4.0) * cos);
        }
        (f_cos, pdf)
    }

    #[inline]
    fn transmission(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
    ) -> (Rgb<T>, T) {
        let generalised = wo + wi * self.eta;
        let wm = (generalised * T::ONE.copysign(generalised.z)).normalize_any();
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        // Facets seen from behind do not scatter; a half vector of zero length is NaN here.
        let lit = cos_o > T::ZERO && cos_i < T::ZERO;
        if !lit {
            return (Rgb::BLACK, T::ZERO);
        }
        let bent = dielectric(cos_o, self.eta);
        let sum = cos_o + self.eta * cos_i;
        let jacobian = self.eta * self.eta * -cos_i / (sum * sum).at_least(T::TINY);
        let visible = self.ggx.d(wm) * cos_o * jacobian;
        let shadowed = self.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let scale = radiance_scale(self.eta, transport) * bent.transmittance;
        let p = shares.specular * (T::ONE - self.reflection_share(cos_o, &bent));
        (
            self.passing() * (scale * visible * shadowed),
            p * visible / self.ggx.projected_area(wo),
        )
    }

    #[inline]
    pub(super) fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        let shares = self.shares(wo);
        if wi.z > T::ZERO {
            self.reflection(&shares, wo, wi)
        } else if wi.z < T::ZERO && self.through > T::ZERO {
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
        let shares = self.shares(wo);
        let direction = [u[1], u[2]];
        let before = shares.diffuse + shares.clearcoat;
        let wi = if u[0] < shares.diffuse {
            warp::cosine_hemisphere(direction)
        } else if u[0] < before {
            reflect(wo, self.gtr1.sample_wm(direction))
        } else if self.through > T::ZERO {
            let wm = self.ggx.sample_wm(wo, direction);
            let cos = wo.dot(wm);
            let bent = dielectric(cos, self.eta);
            let rest = (u[0] - before) / shares.specular.at_least(T::TINY);
            if rest < self.reflection_share(cos, &bent) {
                reflect(wo, wm)
            } else {
                return self.transmitted(wo, wm, cos, &bent, (&shares, transport));
            }
        } else {
            self.ggx.sample_reflection(self.sampler(), wo, direction)
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
        let wi = refract(wo, wm, cos_o, bent.cos_t, self.eta);
        let p = shares.specular * (T::ONE - self.reflection_share(cos_o, bent));
        let sum = cos_o - self.eta * bent.cos_t;
        let jacobian = self.eta * self.eta * bent.cos_t / (sum * sum).at_least(T::TINY);
        let sigma = self.ggx.projected_area(wo);
        let pdf = p * self.ggx.d(wm) * cos_o * jacobian / sigma;
        let shadowed = sigma * self.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let scale = radiance_scale(self.eta, transport) * bent.transmittance;
        let weight = self.passing() * (scale * shadowed / p);
        if bent.transmittance > T::ZERO {
            BsdfSample::transmitted(wi, weight, pdf, self.eta)
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
