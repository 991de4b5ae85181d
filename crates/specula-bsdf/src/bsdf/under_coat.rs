//! Lambert under a dielectric coat: the formulas that [`CoatedDiffuse`](super::CoatedDiffuse) and
//! [`Plastic`](super::Plastic) share, for one element and, without branches, for batches.
//!
//! ```text
//! f = specular F G2 D / (4 |wo.z| |wi.z|)  +  T(wo) T(wi) base / pi
//! p = R(wo) / (R(wo) + T(wo) albedo)                  the probability of sampling the coat's reflection
//! ```
//!
//! `T`, the share of light that reaches the base, and `R`, the share that the coat reflects, are those of an
//! [`Entrance`]; `base` has the bounces between base and coat in it. A smooth coat has a Dirac delta of strength
//! `specular R` for the first part.

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::energy::interface_coat::{Entrance, Incident};
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Vec3, vec3, warp};
use crate::ndf::Masking;
use crate::vndf::{Sampler, VisibleNormals};

/// The base, and what light meets on its way to it.
#[derive(Clone, Copy)]
pub(crate) struct UnderCoat<T, I> {
    /// Index of the coat over that outside.
    pub(crate) eta: T,
    /// Factor on the coat's reflection.
    pub(crate) specular: Rgb<T>,
    pub(crate) albedo: Rgb<T>,
    /// The albedo with all bounces, before `T(wo) T(wi) / pi`.
    pub(crate) base: Rgb<T>,
    pub(crate) interface: I,
}

/// Under a coat of microfacets.
#[derive(Clone, Copy)]
pub(crate) struct UnderRough<T, N, I> {
    pub(crate) under: UnderCoat<T, I>,
    pub(crate) ndf: N,
    pub(crate) masking: Masking,
    pub(crate) sampler: Sampler,
}

/// Under a mirror.
#[derive(Clone, Copy)]
pub(crate) struct UnderSmooth<T, I>(pub(crate) UnderCoat<T, I>);

impl<T: Real, I: Entrance<T>> UnderCoat<T, I> {
    #[inline(always)]
    fn incident(&self, w: Vec3<T>) -> Incident<T> {
        self.interface.incident(w.z.abs())
    }

    /// Probability of sampling the coat's reflection.
    ///
    /// * `from`: of light from `wo`.
    #[inline(always)]
    fn coat_probability(&self, from: Incident<T>) -> T {
        let reflected = from.reflected * self.specular.max_channel();
        let diffuse = from.arriving * self.albedo.max_channel();
        reflected / (reflected + diffuse).at_least(T::TINY)
    }

    /// The base's part of `f |cos|`, and the density of its samples; above the horizon.
    ///
    /// * `p`: probability of sampling the coat instead.
    #[inline(always)]
    fn diffuse(&self, from: Incident<T>, p: T, wi: Vec3<T>) -> (Rgb<T>, T) {
        let arriving = self.incident(wi).arriving;
        let cosine = warp::cosine_hemisphere_pdf(wi);
        let f_cos = self.base * (from.arriving * arriving * cosine);
        (f_cos, (T::ONE - p) * cosine)
    }
}

/// Above the horizon the value and the density, else nothing.
#[inline(always)]
fn above<T: Real>(wi: Vec3<T>, (f_cos, pdf): (Rgb<T>, T)) -> (Rgb<T>, T) {
    // Selected at the end, so that batches have no branches.
    if wi.z > T::ZERO {
        (f_cos, pdf)
    } else {
        (Rgb::BLACK, T::ZERO)
    }
}

impl<T: Real, N: VisibleNormals<T>, I: Entrance<T>> UnderRough<T, N, I> {
    /// Value and density for `wi` above the horizon.
    #[inline(always)]
    fn eval_pdf_from(&self, (from, p): (Incident<T>, T), wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        let (diffuse, diffuse_pdf) = self.under.diffuse(from, p, wi);
        let wm = (wo + wi).normalize_any();
        let quarter = T::of(0.25) * self.ndf.d(wm);
        let fresnel = dielectric(wo.dot(wm), self.under.eta).reflectance;
        let shadowed = self.ndf.g2_over_cos(self.masking, wo, wi);
        let f_cos = diffuse + self.under.specular * (fresnel * quarter * shadowed);
        let pdf = diffuse_pdf + p * quarter / self.ndf.reflection_norm_by(self.sampler, wo);
        let is_seen = wm.z > T::ZERO;
        let pick = |seen, hidden| T::select(is_seen, seen, hidden);
        let f_cos = Rgb {
            r: pick(f_cos.r, diffuse.r),
            g: pick(f_cos.g, diffuse.g),
            b: pick(f_cos.b, diffuse.b),
        };
        (f_cos, pick(pdf, diffuse_pdf))
    }

    /// Value and density of one element.
    #[inline]
    pub(super) fn eval_pdf_alone(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        if wi.z > T::ZERO {
            let from = self.under.incident(wo);
            let p = self.under.coat_probability(from);
            self.eval_pdf_from((from, p), wo, wi)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    /// A sample of one element.
    #[inline]
    pub(super) fn sample_alone(&self, wo: Vec3<T>, u: [T; 3]) -> Option<BsdfSample<T>> {
        let from = self.under.incident(wo);
        let p = self.under.coat_probability(from);
        let direction = [u[1], u[2]];
        let wi = if u[0] < p {
            self.ndf.sample_reflection_by(self.sampler, wo, direction)
        } else {
            warp::cosine_hemisphere(direction)
        };
        if wi.z > T::ZERO {
            let (f_cos, pdf) = self.eval_pdf_from((from, p), wo, wi);
            BsdfSample::reflected(wi, f_cos / pdf, pdf)
        } else {
            None
        }
    }
}

impl<T: Real, I: Entrance<T>> UnderSmooth<T, I> {
    /// Probability of the mirror; 0 where it faces away.
    #[inline(always)]
    fn mirror_probability(&self, from: Incident<T>, wo: Vec3<T>) -> T {
        T::select(wo.z > T::ZERO, self.0.coat_probability(from), T::ZERO)
    }

    /// Value and density of one element.
    #[inline]
    pub(super) fn eval_pdf_alone(&self, wo: Vec3<T>, wi: Vec3<T>) -> (Rgb<T>, T) {
        if wi.z > T::ZERO {
            let from = self.0.incident(wo);
            self.0.diffuse(from, self.mirror_probability(from, wo), wi)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }

    /// A sample of one element.
    #[inline]
    pub(super) fn sample_alone(&self, wo: Vec3<T>, u: [T; 3]) -> Option<BsdfSample<T>> {
        let from = self.0.incident(wo);
        let p = self.mirror_probability(from, wo);
        if u[0] < p {
            Some(self.mirrored(from, p, wo))
        } else {
            self.sample_base((from, p), [u[1], u[2]])
        }
    }

    /// The reflection by the mirror.
    #[inline(always)]
    fn mirrored(&self, from: Incident<T>, p: T, wo: Vec3<T>) -> BsdfSample<T> {
        let weight = self.0.specular * (from.reflected / p);
        let wi = vec3(-wo.x, -wo.y, wo.z);
        BsdfSample::delta(wi, weight, p, Event::Reflection, T::ONE)
    }

    #[inline(always)]
    fn sample_base(&self, (from, p): (Incident<T>, T), u: [T; 2]) -> Option<BsdfSample<T>> {
        let wi = warp::cosine_hemisphere(u);
        let (f_cos, pdf) = self.0.diffuse(from, p, wi);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }
}

/// For batches: without branches.
impl<T: Real, N: VisibleNormals<T>, I: Entrance<T>> Bsdf<T> for UnderRough<T, N, I> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let from = self.under.incident(wo);
        let p = self.under.coat_probability(from);
        let direction = [u[1], u[2]];
        let coat = self.ndf.sample_reflection_by(self.sampler, wo, direction);
        let base = warp::cosine_hemisphere(direction);
        let is_coat = u[0] < p;
        let wi = vec3(
            T::select(is_coat, coat.x, base.x),
            T::select(is_coat, coat.y, base.y),
            T::select(is_coat, coat.z, base.z),
        );
        let (f_cos, pdf) = self.eval_pdf_from((from, p), wo, wi);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        let from = self.under.incident(wo);
        let p = self.under.coat_probability(from);
        above(wi, self.eval_pdf_from((from, p), wo, wi))
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.under.albedo
    }
}

/// For batches: without branches.
impl<T: Real, I: Entrance<T>> Bsdf<T> for UnderSmooth<T, I> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let from = self.0.incident(wo);
        let p = self.mirror_probability(from, wo);
        let mirrored = self.mirrored(from, p, wo);
        let diffuse = self.sample_base((from, p), [u[1], u[2]]);
        if u[0] < p { Some(mirrored) } else { diffuse }
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        let from = self.0.incident(wo);
        above(
            wi,
            self.0.diffuse(from, self.mirror_probability(from, wo), wi),
        )
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.0.albedo
    }
}
