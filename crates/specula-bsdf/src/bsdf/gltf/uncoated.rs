//! What every glTF material has: metal, and a dielectric layer over a diffuse base. For one element and, without branches,
//! for batches.

use super::super::principled::terms::schlick_weight;
use super::albedo::LookedUp;
use crate::alpha::Alpha;
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::Sampler;

/// A material without coat, sheen and transmission.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Uncoated<T> {
    pub(super) base: Rgb<T>,
    pub(super) ggx: Ggx<T>,
    /// Of the dielectric layer.
    pub(super) f0: Rgb<T>,
    pub(super) specular: T,
    pub(super) metallic: T,
    /// Weight of the diffuse base under the layer.
    pub(super) diffuse: T,
}

/// Probabilities of the sampler's parts.
#[derive(Clone, Copy)]
pub(super) struct BaseShares<T> {
    pub(super) specular: T,
    pub(super) diffuse: T,
}

/// What becomes of light at a facet.
#[derive(Clone, Copy)]
pub(super) struct FacetLight<T> {
    /// Reflectance, metal and dielectric.
    pub(super) reflectance: Rgb<T>,
    /// What the layer leaves to its base.
    pub(super) left: T,
}

impl<T: Real> Uncoated<T> {
    /// The dielectric layer's Fresnel term, with its weight.
    #[inline(always)]
    fn layer(&self, s: T) -> Rgb<T> {
        self.f0.map(|f0| self.specular * (f0 + (T::ONE - f0) * s))
    }

    /// The layer's largest reflectances at normal and at grazing incidence.
    #[inline(always)]
    pub(super) fn ends(&self) -> [T; 2] {
        [self.specular * self.f0.max_channel(), self.specular]
    }

    /// Factor of the metal's reflectance.
    ///
    /// * `ratio`: lost energy over that which is not; 0 where nothing is given back.
    #[inline(always)]
    fn gain(&self, ratio: T) -> Rgb<T> {
        self.base.map(|b| T::ONE + b * ratio)
    }

    /// * `s`: Schlick's weight.
    /// * `gain`: factor of the metal's reflectance.
    #[inline(always)]
    pub(super) fn fresnel(&self, s: T, gain: Rgb<T>) -> FacetLight<T> {
        let layer = self.layer(s);
        let metal = self.base.map(|b| b + (T::ONE - b) * s);
        FacetLight {
            reflectance: metal * gain * self.metallic + layer * (T::ONE - self.metallic),
            left: T::ONE - layer.max_channel(),
        }
    }

    /// What is left to the base at the mean surface, with its largest channel: facets pass light where the mean surface
    /// reflects all of it.
    #[inline(always)]
    pub(super) fn left_to_base(&self, mean: FacetLight<T>) -> T {
        mean.left.at_least(T::of(0.1)) * self.base.max_channel()
    }

    /// `f |cos|` and density above the horizon, at a facet that is seen.
    ///
    /// * `limit`: of the diffuse base.
    #[inline(always)]
    pub(super) fn at_facet(
        &self,
        facet: FacetLight<T>,
        shares: BaseShares<T>,
        limit: T,
        [wo, wi, wm]: [Vec3<T>; 3],
    ) -> (Rgb<T>, T) {
        let cosine = wi.z * T::INV_PI;
        let quarter = T::of(0.25) * self.ggx.d(wm);
        let norm = self.ggx.reflection_norm(Sampler::Bounded, wo);
        let pdf = shares.specular * quarter / norm + shares.diffuse * cosine;
        let shadowed = self.ggx.g2_over_cos(Masking::HeightCorrelated, wo, wi);
        let specular = facet.reflectance * (quarter * shadowed);
        let diffuse = self.base * (self.diffuse * facet.left * limit * cosine);
        (specular + diffuse, pdf)
    }
}

/// How many numbers a [`Material`] is.
pub(super) const COLUMNS: usize = 12;

/// An uncoated material, and whether its metal gives back what its facets lose by scattering once.
#[derive(Clone, Copy)]
pub(super) struct Material<T> {
    pub(super) of: Uncoated<T>,
    pub(super) compensated: bool,
}

impl<T: Real> Material<T> {
    #[inline(always)]
    pub(super) fn columns(&self) -> [T; COLUMNS] {
        let Uncoated {
            base,
            ggx,
            f0,
            specular,
            metallic,
            diffuse,
        } = self.of;
        let Alpha { x, y } = ggx.alpha();
        let compensated = T::select(self.compensated, T::ONE, T::ZERO);
        [
            base.r,
            base.g,
            base.b,
            x,
            y,
            f0.r,
            f0.g,
            f0.b,
            specular,
            metallic,
            diffuse,
            compensated,
        ]
    }

    #[inline(always)]
    pub(super) fn of_columns(columns: [T; COLUMNS]) -> Self {
        let [
            base_r,
            base_g,
            base_b,
            x,
            y,
            f0_r,
            f0_g,
            f0_b,
            specular,
            metallic,
            diffuse,
            compensated,
        ] = columns;
        let rgb = |r, g, b| Rgb { r, g, b };
        Self {
            of: Uncoated {
                base: rgb(base_r, base_g, base_b),
                ggx: Ggx::new(Alpha { x, y }),
                f0: rgb(f0_r, f0_g, f0_b),
                specular,
                metallic,
                diffuse,
            },
            compensated: compensated > T::ZERO,
        }
    }

    /// Factor of the metal's reflectance, seen from a direction.
    #[inline(always)]
    pub(super) fn gain(&self, wo: LookedUp<T>) -> Rgb<T> {
        let ratio = wo.lost / (T::ONE - wo.lost).at_least(T::of(1e-5));
        self.of.gain(T::select(self.compensated, ratio, T::ZERO))
    }

    #[inline(always)]
    fn shares(&self, wo: Vec3<T>, gain: Rgb<T>) -> BaseShares<T> {
        let mean = self.of.fresnel(schlick_weight(wo.z.abs()), gain);
        let diffuse = self.of.left_to_base(mean) * self.of.diffuse;
        let specular = mean.reflectance.max_channel();
        let scale = T::ONE / (diffuse + specular).at_least(T::TINY);
        BaseShares {
            specular: specular * scale,
            diffuse: diffuse * scale,
        }
    }

    /// A direction, perhaps below the horizon.
    #[inline(always)]
    pub(super) fn sample_wi(&self, of_wo: LookedUp<T>, wo: Vec3<T>, u: [T; 3]) -> Vec3<T> {
        let shares = self.shares(wo, self.gain(of_wo));
        let direction = [u[1], u[2]];
        let reflected = self
            .of
            .ggx
            .sample_reflection(Sampler::Bounded, wo, direction);
        let scattered = warp::cosine_hemisphere(direction);
        let is_specular = u[0] < shares.specular;
        vec3(
            T::select(is_specular, reflected.x, scattered.x),
            T::select(is_specular, reflected.y, scattered.y),
            T::select(is_specular, reflected.z, scattered.z),
        )
    }

    /// `f |cos|` and density.
    #[inline(always)]
    pub(super) fn eval_pdf(
        &self,
        [of_wo, of_wi]: [LookedUp<T>; 2],
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> (Rgb<T>, T) {
        let gain = self.gain(of_wo);
        let shares = self.shares(wo, gain);
        let wm = (wo + wi).normalize_any();
        let facet = self.of.fresnel(schlick_weight(wo.dot(wm)), gain);
        let ends = self.of.ends();
        let limit = of_wo.limit(ends, wo) * of_wi.limit(ends, wi);
        let (f_cos, pdf) = self.of.at_facet(facet, shares, limit, [wo, wi, wm]);
        // A half vector of zero length is NaN here.
        let is_seen = wi.z > T::ZERO && wm.z > T::ZERO;
        if is_seen {
            (f_cos, pdf)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }
}
