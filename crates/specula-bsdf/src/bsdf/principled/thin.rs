//! `principledthin`: a sheet without thickness, the same from both sides.

use super::terms::{
    diffuse, distribution, hue, normal_reflectance, schlick, schlick_weight, schlick_weight_across,
    sheen_colour,
};
use super::{BsdfSample, PrincipledParameters};
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::Sampler;

/// The sheet; straight transmission is reflection, mirrored through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thin<T> {
    reflecting: Ggx<T>,
    /// Normals of transmission: alphas scaled by the index.
    passing: Ggx<T>,
    base: Rgb<T>,
    tinted_f0: Rgb<T>,
    /// Weight times colour.
    sheen: Rgb<T>,
    roughness: T,
    flatness: T,
    spec_trans: T,
    spec_tint: T,
    /// Weights of the two diffuse parts.
    diffuse_reflection: T,
    diffuse_transmission: T,
    eta: T,
}

/// Probabilities of the sampler's parts.
#[derive(Clone, Copy)]
struct Shares<T> {
    reflection: T,
    transmission: T,
    diffuse_reflection: T,
    diffuse_transmission: T,
}

/// The other side.
#[inline(always)]
fn mirrored<T: Real>(w: Vec3<T>) -> Vec3<T> {
    vec3(w.x, w.y, -w.z)
}

impl<T: Real> Thin<T> {
    /// * `p`: shares in `[0, 1]`, `diff_trans` in `[0, 2]`.
    #[inline]
    pub(super) fn new(p: &PrincipledParameters<T>) -> Self {
        let matte = T::ONE - p.spec_trans;
        let beyond = T::HALF * p.diff_trans;
        let scale = T::of(0.65) * p.eta - T::of(0.35);
        Self {
            reflecting: distribution(p.roughness, p.anisotropic),
            passing: distribution(scale * p.roughness, p.anisotropic),
            base: p.base_colour,
            tinted_f0: hue(p.base_colour) * normal_reflectance(p.eta),
            sheen: sheen_colour(p.base_colour, p.sheen_tint)
                * (p.sheen * matte * (T::ONE - beyond)),
            roughness: p.roughness,
            flatness: p.flatness,
            spec_trans: p.spec_trans,
            spec_tint: p.spec_tint,
            diffuse_reflection: matte * (T::ONE - beyond),
            diffuse_transmission: matte * beyond,
            eta: p.eta,
        }
    }

    #[inline(always)]
    pub(super) fn base(&self) -> Rgb<T> {
        self.base
    }

    /// Reflectance, tinted, and transmittance of a facet.
    #[inline(always)]
    fn fresnel(&self, cos: T) -> (Rgb<T>, T) {
        let bent = dielectric(cos, self.eta);
        let s = schlick_weight_across(cos, &bent, self.eta);
        let tinted = schlick(self.tinted_f0, s);
        let plain = bent.reflectance;
        (
            tinted.map(|t| plain + (t - plain) * self.spec_tint),
            bent.transmittance,
        )
    }

    #[inline]
    fn shares(&self, wo: Vec3<T>) -> Shares<T> {
        let (reflectance, transmittance) = self.fresnel(wo.z.abs());
        let base = self.base.max_channel();
        let reflection = self.spec_trans * reflectance.max_channel();
        let transmission = self.spec_trans * transmittance * base;
        let back = self.diffuse_reflection * base + T::of(0.1) * self.sheen.max_channel();
        let beyond = self.diffuse_transmission * base;
        let scale = T::ONE / (reflection + transmission + back + beyond).at_least(T::TINY);
        Shares {
            reflection: reflection * scale,
            transmission: transmission * scale,
            diffuse_reflection: back * scale,
            diffuse_transmission: beyond * scale,
        }
    }

    /// The value and the density, given the direction above the sheet and whether it was there.
    #[inline]
    fn evaluate(
        &self,
        shares: &Shares<T>,
        wo: Vec3<T>,
        up: Vec3<T>,
        reflects: bool,
    ) -> (Rgb<T>, T) {
        let wm = (wo + up).normalize_any();
        let cos_pdf = up.z * T::INV_PI;
        let facing = wm.z > T::ZERO;
        if up.z <= T::ZERO || !facing {
            return (Rgb::BLACK, T::ZERO);
        }
        let cos = wo.dot(wm);
        let (reflectance, transmittance) = self.fresnel(cos);
        let (ggx, colour, p) = if reflects {
            (&self.reflecting, reflectance, shares.reflection)
        } else {
            (
                &self.passing,
                self.base * transmittance,
                shares.transmission,
            )
        };
        let quarter = T::of(0.25) * ggx.d(wm);
        let shadowed = ggx.g2_over_cos(Masking::Separable, wo, up);
        // Mitsuba tests the facet against the direction beyond the sheet, too: where that sees the
        // facet's front, nothing passes.
        let seen = reflects || mirrored(up).dot(wm) < T::ZERO;
        let weight = T::select(seen, self.spec_trans, T::ZERO);
        let mut f_cos = colour * (weight * quarter * shadowed);
        let mut pdf = p * quarter / ggx.reflection_norm(Sampler::Bounded, wo);
        if reflects {
            let shape = diffuse(wo.z.abs(), up.z, cos, self.roughness, self.flatness);
            f_cos += self.base * (self.diffuse_reflection * shape * cos_pdf);
            f_cos += self.sheen * (schlick_weight(cos) * up.z);
            pdf += shares.diffuse_reflection * cos_pdf;
        } else {
            f_cos += self.base * (self.diffuse_transmission * cos_pdf);
            pdf += shares.diffuse_transmission * cos_pdf;
        }
        (f_cos, pdf)
    }

    #[inline]
    pub(super) fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let reflects = wi.z > T::ZERO;
        let up = if reflects { wi } else { mirrored(wi) };
        self.evaluate(&self.shares(wo), wo, up, reflects)
    }

    #[inline]
    pub(super) fn sample(&self, wo: Vec3<T>, u: [T; 3]) -> Option<BsdfSample<T>> {
        let shares = self.shares(wo);
        let direction = [u[1], u[2]];
        let specular = |ggx: &Ggx<T>| ggx.sample_reflection(Sampler::Bounded, wo, direction);
        let first = shares.reflection;
        let second = first + shares.diffuse_reflection;
        let third = second + shares.transmission;
        let (up, reflects) = if u[0] < first {
            (specular(&self.reflecting), true)
        } else if u[0] < second {
            (warp::cosine_hemisphere(direction), true)
        } else if u[0] < third {
            (specular(&self.passing), false)
        } else {
            (warp::cosine_hemisphere(direction), false)
        };
        let (f_cos, pdf) = self.evaluate(&shares, wo, up, reflects);
        if reflects {
            BsdfSample::reflected(up, f_cos / pdf, pdf)
        } else {
            BsdfSample::transmitted(mirrored(up), f_cos / pdf, pdf, T::ONE)
        }
    }
}
