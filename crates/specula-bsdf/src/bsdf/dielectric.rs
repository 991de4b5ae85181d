//! A rough dielectric interface: reflection and refraction (Walter et al. 2007).

use super::{Bsdf, BsdfSample, Event, Tints, Transport};
use crate::fresnel::{Refraction, dielectric, refract};
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::{Sampler, reflect};

/// Single scattering at a rough interface between two dielectrics.
///
/// ```text
/// reflection:    f = F G2 D / (4 |wo.z| |wi.z|),                       wm ~ wo + wi
/// transmission:  f = (1 - F) G2 D |wo.wm| |wi.wm| e^2 / (|wo.z| |wi.z| (wo.wm + e wi.wm)^2)
///                    [/ e^2 for radiance],                             wm ~ +-(wo + e wi)
/// ```
///
/// with `e` the index beyond the interface over that on the side of `wo`.
///
/// A visible normal is drawn first (by caps; refraction needs all of them), then the branch by what
/// it carries: with `r = F G2(wo, wr)` and `t = (1 - F) G2(wo, wt)` at the two directions of the
/// facet, 0 where one lies on the wrong side of the surface, reflection has the probability
/// `r / (r + t)` and both weigh `(r + t) / G1(wo)`. Where only one direction is valid it is taken:
/// nothing is rejected for light that enters the denser medium, and from inside only what is totally
/// reflected downwards (`docs/exact-reflection-sampling.md`).
///
/// With [`Sampler::Bounded`] and [`Sampler::Exact`] the branch is drawn before the normal, with the
/// macroscopic reflectance as its probability, so that they can serve the reflections; the weights
/// then carry `F(wm)` over that probability, which costs more variance than it saves (test
/// `drawing_the_branch_before_the_normal_costs_variance`): caps are the default.
///
/// Departure: transmission uses the `G2` of reflection, as pbrt-v4 does, not the Beta function of
/// Smith's model for opposite sides (Heitz et al. 2016), which an energy compensation brings back.
///
/// Indices within 1e-3 of each other are taken as equal: light passes straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric<T, N = Ggx<T>> {
    pub(crate) ndf: N,
    pub(crate) eta: T,
    pub(crate) two_sided: bool,
    pub(crate) sampler: Sampler,
    pub(crate) masking: Masking,
    pub(crate) tints: Tints<T>,
}

impl<T: Real, N: Ndf<T>> RoughDielectric<T, N> {
    /// An interface with both sides: `wo.z < 0` views it from inside.
    ///
    /// * `eta`: index inside over index outside, above 0.
    #[inline(always)]
    pub fn new(ndf: N, eta: T) -> Self {
        Self {
            two_sided: true,
            ..Self::facing(ndf, eta)
        }
    }

    /// An interface as seen from the geometric side of `wo`: `wo.z < 0` is a backfacing shading
    /// normal, handled in the density.
    ///
    /// * `eta`: index beyond the interface over the index on the side of `wo`.
    #[inline(always)]
    pub fn facing(ndf: N, eta: T) -> Self {
        Self {
            ndf,
            eta,
            two_sided: false,
            sampler: Sampler::Cap,
            masking: Masking::default(),
            tints: Tints::WHITE,
        }
    }

    /// The same interface, drawn by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// The same interface with another masking.
    #[inline(always)]
    #[must_use]
    pub fn with_masking(self, masking: Masking) -> Self {
        Self { masking, ..self }
    }

    /// The same surface with factors on its two branches.
    #[inline(always)]
    #[must_use]
    pub fn with_tints(self, tints: Tints<T>) -> Self {
        Self { tints, ..self }
    }

    #[inline(always)]
    fn is_index_matched(&self) -> bool {
        (self.eta - T::ONE).abs() < T::of(1e-3)
    }

    /// The side that `wo` views: the factor that turns z, and the relative index.
    #[inline(always)]
    fn side(&self, wo: Vec3<T>) -> (T, T) {
        if self.two_sided && wo.z < T::ZERO {
            (-T::ONE, T::ONE / self.eta)
        } else {
            (T::ONE, self.eta)
        }
    }

    /// Probability of reflection where the branch is drawn before the normal.
    #[inline(always)]
    fn branch_probability(&self, wo: Vec3<T>, eta: T) -> T {
        let macroscopic = dielectric(wo.z.abs(), eta).reflectance;
        Real::clamp(macroscopic, T::of(0.1), T::of(0.9))
    }

    /// Whether the branch is drawn before the normal.
    #[inline(always)]
    fn is_branch_first(&self) -> bool {
        matches!(self.sampler, Sampler::Bounded | Sampler::Exact)
    }

    /// Eval and pdf for `wo` on its own side.
    #[inline(always)]
    fn evaluate(&self, wo: Vec3<T>, wi: Vec3<T>, eta: T, transport: Transport) -> (T, T) {
        if wi.z == T::ZERO {
            return (T::ZERO, T::ZERO);
        }
        let reflects = wi.z > T::ZERO;
        let generalised = if reflects { wo + wi } else { wo + wi * eta };
        let upright = T::ONE.copysign(generalised.z);
        let wm = (generalised * upright).normalize();
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        // Facets seen from behind do not scatter; a half vector of zero length is NaN here.
        let lit = cos_o > T::ZERO && T::select(reflects, cos_i, -cos_i) > T::ZERO;
        if !lit {
            return (T::ZERO, T::ZERO);
        }
        let bent = dielectric(cos_o, eta);
        let d = self.ndf.d(wm);
        let g2 = self.ndf.g2_over_cos(self.masking, wo, wi);
        let branch_first = self.is_branch_first();
        if reflects {
            let norm = self.ndf.reflection_norm(self.sampler, wo);
            let carried = bent.reflectance * g2;
            let chosen = if branch_first {
                self.branch_probability(wo, eta)
            } else {
                share(carried, self.carried(wo, wm, bent, eta)[1])
            };
            let quarter = T::of(0.25) * d;
            (quarter * carried, chosen * quarter / norm)
        } else {
            let sum = cos_o + eta * cos_i;
            let jacobian = eta * eta * cos_i.abs() / Real::max(sum * sum, T::TINY);
            let scale = match transport {
                Transport::Radiance => T::ONE / (eta * eta),
                Transport::Importance => T::ONE,
            };
            let carried = bent.transmittance * g2;
            let chosen = if branch_first {
                T::ONE - self.branch_probability(wo, eta)
            } else {
                share(carried, self.carried(wo, wm, bent, eta)[0])
            };
            let visible = d * cos_o * jacobian;
            (
                carried * visible * scale,
                chosen * visible / self.ndf.projected_area(wo),
            )
        }
    }

    /// A draw for `wo` on its own side.
    #[inline(always)]
    fn draw(&self, wo: Vec3<T>, u: [T; 3], eta: T, transport: Transport) -> Option<BsdfSample<T>> {
        let direction = [u[1], u[2]];
        if self.is_branch_first() {
            let p = self.branch_probability(wo, eta);
            if u[0] < p {
                let wi = self.ndf.sample_reflection(self.sampler, wo, direction);
                let wm = (wo + wi).normalize();
                let fresnel = dielectric(wo.dot(wm), eta).reflectance;
                let norm = self.ndf.reflection_norm(self.sampler, wo);
                let weight = norm * self.ndf.g2_over_cos(self.masking, wo, wi) * fresnel / p;
                let pdf = p * self.ndf.d(wm) / (T::of(4.0) * norm);
                return BsdfSample::reflected(wi, Rgb::splat(weight), pdf);
            }
            let wm = self.ndf.sample_wm(wo, direction);
            return self.transmit(wo, wm, eta, transport, T::ONE - p);
        }
        let wm = self.ndf.sample_wm(wo, direction);
        let bent = dielectric(wo.dot(wm), eta);
        let [reflected, transmitted] = self.carried(wo, wm, bent, eta);
        let reflection = share(reflected, transmitted);
        if u[0] < reflection {
            let wi = reflect(wo, wm);
            let norm = self.ndf.projected_area(wo);
            let weight = norm * (reflected + transmitted);
            let pdf = reflection * self.ndf.d(wm) / (T::of(4.0) * norm);
            BsdfSample::reflected(wi, Rgb::splat(weight), pdf)
        } else {
            self.transmit(wo, wm, eta, transport, share(transmitted, reflected))
        }
    }

    /// `F G2(wo, wr) / |wo.z|` and `(1 - F) G2(wo, wt) / |wo.z|` of the two directions that the facet
    /// `wm` sends light to; 0 for one on the wrong side of the surface.
    #[inline(always)]
    fn carried(&self, wo: Vec3<T>, wm: Vec3<T>, bent: Refraction<T>, eta: T) -> [T; 2] {
        let wr = reflect(wo, wm);
        let wt = refract(wo, wm, wo.dot(wm), bent.cos_t, eta);
        let g2 = |wi| self.ndf.g2_over_cos(self.masking, wo, wi);
        [
            T::select(wr.z > T::ZERO, bent.reflectance * g2(wr), T::ZERO),
            T::select(wt.z < T::ZERO, bent.transmittance * g2(wt), T::ZERO),
        ]
    }

    /// Refraction through the facet `wm`, chosen with probability `p`.
    #[inline(always)]
    fn transmit(
        &self,
        wo: Vec3<T>,
        wm: Vec3<T>,
        eta: T,
        transport: Transport,
        p: T,
    ) -> Option<BsdfSample<T>> {
        let cos_o = wo.dot(wm);
        let bent = dielectric(cos_o, eta);
        let wi = refract(wo, wm, cos_o, bent.cos_t, eta);
        let passed = T::select(p > T::ZERO, bent.transmittance / p, T::ZERO);
        let sum = cos_o - eta * bent.cos_t;
        let jacobian = eta * eta * bent.cos_t / Real::max(sum * sum, T::TINY);
        let sigma = self.ndf.projected_area(wo);
        let pdf = p * self.ndf.d(wm) * cos_o * jacobian / sigma;
        let scale = match transport {
            Transport::Radiance => T::ONE / (eta * eta),
            Transport::Importance => T::ONE,
        };
        let weight = passed * scale * sigma * self.ndf.g2_over_cos(self.masking, wo, wi);
        if passed > T::ZERO {
            BsdfSample::transmitted(wi, Rgb::splat(weight), pdf, eta)
        } else {
            None
        }
    }
}

/// `one / (one + other)`; 0 where both vanish.
#[inline(always)]
fn share<T: Real>(one: T, other: T) -> T {
    let sum = one + other;
    T::select(sum > T::ZERO, one / sum, T::ZERO)
}

impl<T: Real, N: Ndf<T>> Bsdf<T> for RoughDielectric<T, N> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline(always)]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        if self.is_index_matched() {
            return Some(BsdfSample::delta(
                -wo,
                self.tints.transmission,
                T::ONE,
                Event::Transmission,
                T::ONE,
            ));
        }
        let (turn, eta) = self.side(wo);
        let upright = |w: Vec3<T>| vec3(w.x, w.y, w.z * turn);
        let sample = self.draw(upright(wo), u, eta, transport)?;
        Some(BsdfSample {
            wi: upright(sample.wi),
            weight: sample.weight * self.tints.on(sample.event),
            ..sample
        })
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        if self.is_index_matched() {
            return (Rgb::BLACK, T::ZERO);
        }
        let (turn, eta) = self.side(wo);
        let upright = |w: Vec3<T>| vec3(w.x, w.y, w.z * turn);
        let wi = upright(wi);
        let (f_cos, pdf) = self.evaluate(upright(wo), wi, eta, transport);
        (self.tints.on_side(wi.z > T::ZERO) * f_cos, pdf)
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        self.is_index_matched()
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        Rgb::WHITE
    }
}
