//! What every `principled` has: reflection, diffuse and specular, sheen and clear coat. For one element and, without
//! branches, for batches.

use super::super::BsdfSample;
use super::gtr1::Gtr1;
use super::terms::{diffuse, schlick, schlick_weight, schlick_weight_across};
use crate::alpha::Alpha;
use crate::fresnel::{Refraction, dielectric};
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::{Sampler, reflect};

/// The material without its refraction, seen from one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Opaque<T> {
    pub(super) ggx: Ggx<T>,
    pub(super) base: Rgb<T>,
    /// `F0` of the tinted part of the dielectric reflection.
    pub(super) tinted_f0: Rgb<T>,
    /// Weight times colour.
    pub(super) sheen: Rgb<T>,
    pub(super) roughness: T,
    pub(super) flatness: T,
    /// Weights of the parts of the Fresnel term.
    pub(super) dielectric: T,
    pub(super) tinted: T,
    pub(super) metallic: T,
    /// Weight of the diffuse part.
    pub(super) diffuse: T,
    /// A quarter of the parameter.
    pub(super) clearcoat: T,
    pub(super) gtr1: Gtr1<T>,
    /// Index beyond over that on the side of `wo`.
    pub(super) eta: T,
}

/// Probabilities of the sampler's parts.
#[derive(Clone, Copy)]
pub(super) struct Shares<T> {
    pub(super) diffuse: T,
    pub(super) clearcoat: T,
    pub(super) specular: T,
}

/// How many numbers an [`Opaque`] is.
pub(super) const COLUMNS: usize = 21;

impl<T: Real> Opaque<T> {
    #[inline(always)]
    pub(super) fn columns(&self) -> [T; COLUMNS] {
        let (Alpha { x, y }, base, f0, sheen) =
            (self.ggx.alpha(), self.base, self.tinted_f0, self.sheen);
        let Gtr1 { alpha2, log } = self.gtr1;
        [
            x,
            y,
            base.r,
            base.g,
            base.b,
            f0.r,
            f0.g,
            f0.b,
            sheen.r,
            sheen.g,
            sheen.b,
            self.roughness,
            self.flatness,
            self.dielectric,
            self.tinted,
            self.metallic,
            self.diffuse,
            self.clearcoat,
            alpha2,
            log,
            self.eta,
        ]
    }

    #[inline(always)]
    pub(super) fn of_columns(columns: [T; COLUMNS]) -> Self {
        let [
            x,
            y,
            base_r,
            base_g,
            base_b,
            f0_r,
            f0_g,
            f0_b,
            sheen_r,
            sheen_g,
            sheen_b,
            roughness,
            flatness,
            dielectric,
            tinted,
            metallic,
            diffuse,
            clearcoat,
            alpha2,
            log,
            eta,
        ] = columns;
        Self {
            ggx: Ggx::new(Alpha { x, y }),
            base: Rgb {
                r: base_r,
                g: base_g,
                b: base_b,
            },
            tinted_f0: Rgb {
                r: f0_r,
                g: f0_g,
                b: f0_b,
            },
            sheen: Rgb {
                r: sheen_r,
                g: sheen_g,
                b: sheen_b,
            },
            roughness,
            flatness,
            dielectric,
            tinted,
            metallic,
            diffuse,
            clearcoat,
            gtr1: Gtr1 { alpha2, log },
            eta,
        }
    }

    /// The Fresnel term of the main reflection.
    #[inline(always)]
    pub(super) fn fresnel(&self, cos: T, bent: &Refraction<T>) -> Rgb<T> {
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

    /// * `passing`: light that is refracted, before the Fresnel term.
    #[inline(always)]
    pub(super) fn shares(&self, wo: Vec3<T>, passing: T) -> Shares<T> {
        let cos = wo.z.abs();
        let bent = dielectric(cos, self.eta);
        let reflecting = self.fresnel(cos, &bent).max_channel();
        let specular = reflecting + passing * bent.transmittance;
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

    /// `f |cos|` and density above the horizon, at a facet that is seen.
    ///
    /// * `specular`: probability of a main reflection at this facet.
    /// * `norm`: of the sampler of main reflections.
    #[inline(always)]
    pub(super) fn at_facet(
        &self,
        shares: Shares<T>,
        (specular, norm): (T, T),
        bent: &Refraction<T>,
        [wo, wi, wm]: [Vec3<T>; 3],
    ) -> (Rgb<T>, T) {
        let cos = wo.dot(wm);
        let quarter = T::of(0.25) * self.ggx.d(wm);
        let shadowed = self.ggx.g2_over_cos(Masking::Separable, wo, wi);
        let main = self.fresnel(cos, bent) * (quarter * shadowed);
        let shape = diffuse(wo.z.abs(), wi.z, cos, self.roughness, self.flatness);
        let base = self.base * (self.diffuse * shape * wi.z * T::INV_PI);
        let sheen = self.sheen * (schlick_weight(cos) * wi.z);
        let d = self.gtr1.d(wm);
        let coat = self.coat_fresnel(cos, bent) * d * Gtr1::masking(wo, wi) * wi.z;
        let coat_pdf = shares.clearcoat * d * wm.z / (T::of(4.0) * cos);
        let is_coated = self.clearcoat > T::ZERO;
        let pdf = specular * quarter / norm + shares.diffuse * wi.z * T::INV_PI;
        (
            main + base + sheen + Rgb::splat(T::select(is_coated, coat, T::ZERO)),
            pdf + T::select(is_coated, coat_pdf, T::ZERO),
        )
    }

    /// A direction, perhaps below the horizon, where nothing is refracted.
    #[inline(always)]
    pub(super) fn sample_wi(&self, wo: Vec3<T>, u: [T; 3]) -> Vec3<T> {
        let shares = self.shares(wo, T::ZERO);
        let direction = [u[1], u[2]];
        let base = warp::cosine_hemisphere(direction);
        let coat = reflect(wo, self.gtr1.sample_wm(direction));
        let main = self.ggx.sample_reflection(Sampler::Bounded, wo, direction);
        let is_base = u[0] < shares.diffuse;
        let is_coat = u[0] < shares.diffuse + shares.clearcoat;
        let pick = |base, coat, main| T::select(is_base, base, T::select(is_coat, coat, main));
        vec3(
            pick(base.x, coat.x, main.x),
            pick(base.y, coat.y, main.y),
            pick(base.z, coat.z, main.z),
        )
    }

    /// `f |cos|` and density where nothing is refracted.
    #[inline(always)]
    pub(super) fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let shares = self.shares(wo, T::ZERO);
        let wm = (wo + wi).normalize_any();
        let bent = dielectric(wo.dot(wm), self.eta);
        let norm = self.ggx.reflection_norm(Sampler::Bounded, wo);
        let (f_cos, pdf) = self.at_facet(shares, (shares.specular, norm), &bent, [wo, wi, wm]);
        // A half vector of zero length is NaN here.
        if wi.z > T::ZERO && wm.z > T::ZERO {
            (f_cos, pdf)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    /// One sample where nothing is refracted.
    #[inline]
    pub(super) fn sample_alone(&self, wo: Vec3<T>, u: [T; 3]) -> Option<BsdfSample<T>> {
        let shares = self.shares(wo, T::ZERO);
        let direction = [u[1], u[2]];
        let wi = if u[0] < shares.diffuse {
            warp::cosine_hemisphere(direction)
        } else if u[0] < shares.diffuse + shares.clearcoat {
            reflect(wo, self.gtr1.sample_wm(direction))
        } else {
            self.ggx.sample_reflection(Sampler::Bounded, wo, direction)
        };
        if wi.z > T::ZERO {
            let (f_cos, pdf) = self.eval_pdf(wo, wi);
            BsdfSample::reflected(wi, f_cos / pdf, pdf)
        } else {
            None
        }
    }
}
