//! A rough dielectric interface: reflection and refraction (Walter et al. 2007).

use super::{Bsdf, BsdfSample, Event, Tints, Transport};
use crate::alpha::Alpha;
use crate::fresnel::{dielectric, refract, refraction};
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::{Ggx, Masking};
use crate::vndf::{Sampler, VisibleNormals, reflect};

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
/// A visible normal is sampled first (by caps; refraction needs all of them), then the branch by what
/// it carries: with `r = F G2(wo, wr)` and `t = (1 - F) G2(wo, wt)` at the two directions of the
/// facet, 0 where one lies on the wrong side of the surface, reflection has the probability
/// `r / (r + t)` and both weigh `(r + t) / G1(wo)`. Where only one direction is valid it is taken:
/// nothing is rejected for light that enters the denser medium, and from inside only what is totally
/// reflected downwards (`docs/exact-reflection-sampling.md`).
///
/// With [`Sampler::Bounded`] and [`Sampler::Exact`] the branch is sampled before the normal, with the
/// macroscopic reflectance as its probability, so that they can serve the reflections; the weights
/// then carry `F(wm)` over that probability, which costs more variance than it saves (test
/// `drawing_the_branch_before_the_normal_costs_variance`): caps are the default.
///
/// Departure: transmission uses the `G2` of reflection, as pbrt-v4 does, not the Beta function of
/// Smith's model for opposite sides (Heitz et al. 2016), which an energy compensation makes up for.
///
/// Indices within [`INDEX_MATCHED`](Self::INDEX_MATCHED) of each other are taken as equal: light passes straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric<T, N = Ggx<T>> {
    pub(crate) ndf: N,
    pub(crate) eta: T,
    pub(crate) two_sided: bool,
    pub(crate) sampler: Sampler,
    pub(crate) masking: Masking,
    pub(crate) tints: Tints<T>,
}

impl<T: Real, N: VisibleNormals<T>> RoughDielectric<T, N> {
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

    /// Its alphas.
    #[inline(always)]
    pub fn alpha(&self) -> Alpha<T> {
        self.ndf.alpha()
    }

    /// The index of refraction that it was made with.
    #[inline(always)]
    pub fn eta(&self) -> T {
        self.eta
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
        (self.eta - T::ONE).abs() < T::of(RoughDielectric::<T>::INDEX_MATCHED)
    }

    /// The interface as `wo` meets it.
    #[inline(always)]
    fn side(&self, wo: Vec3<T>) -> Side<T> {
        let inside = self.two_sided && wo.z < T::ZERO;
        let inverse = T::ONE / self.eta;
        Side {
            inside,
            turn: T::select(inside, -T::ONE, T::ONE),
            eta: T::select(inside, inverse, self.eta),
            inverse: T::select(inside, self.eta, inverse),
        }
    }

    /// `far^2` of the Jacobian of refraction, and the same for what the path carries (`near^2` for
    /// radiance, which is divided by `e^2`). With `h = near wo + far wi` of [`half`](Self::half) and
    /// `e = far / near`:
    ///
    /// ```text
    /// dwm/dwi = e^2 |wi.wm| / (wo.wm + e wi.wm)^2 = far^2 |wi.wm| / |h|^2
    /// ```
    ///
    /// for the sum is `(wo + e wi) . wm`, the length of `wo + e wi`: its terms, of opposite signs,
    /// cancel, but a length does not.
    ///
    /// Source: Walter et al. 2007, eq. 17.
    #[inline(always)]
    fn stretches(&self, side: Side<T>, transport: Transport) -> (T, T) {
        let eta2 = self.eta * self.eta;
        let near2 = T::select(side.inside, eta2, T::ONE);
        let far2 = T::select(side.inside, T::ONE, eta2);
        // For radiance divided by e^2 = far^2 / near^2.
        let carried = match transport {
            Transport::Radiance => near2,
            Transport::Importance => far2,
        };
        (far2, carried)
    }

    /// A vector along the normal of the facet that sends `wo` to `wi`: `wo + wi`, or `wo + e wi`
    /// times a factor.
    ///
    /// Near the mirrored and the straight direction its x and y cancel, and narrow distributions ask
    /// for them to be right to a share of themselves. So products are not rounded; and from inside,
    /// where `e = 1/eta` is rounded, `eta wo + wi` takes the place of `wo + e wi`.
    #[inline(always)]
    fn half(&self, side: Side<T>, wo: Vec3<T>, wi: Vec3<T>, reflects: bool) -> Vec3<T> {
        let factor = T::select(reflects, T::ONE, self.eta);
        let sum = |o, i| {
            let (one, other) = (T::select(side.inside, i, o), T::select(side.inside, o, i));
            other.mad_exact_product(factor, one)
        };
        let half = vec3(sum(wo.x, wi.x), sum(wo.y, wi.y), sum(wo.z, wi.z));
        half * T::ONE.copysign(half.z)
    }

    /// Probability of reflection where the branch is sampled before the normal.
    #[inline(always)]
    fn branch_probability(&self, wo: Vec3<T>, eta: T) -> T {
        let macroscopic = dielectric(wo.z.abs(), eta).reflectance;
        macroscopic.within(T::of(0.1), T::of(0.9))
    }

    /// Whether the branch is sampled before the normal.
    #[inline(always)]
    fn is_branch_first(&self) -> bool {
        matches!(self.sampler, Sampler::Bounded | Sampler::Exact)
    }

    /// What happens between `wo`, on its own side, and `wi`. Free of branches, so that batches are.
    #[inline(always)]
    fn scatter(&self, wo: Vec3<T>, wi: Vec3<T>, side: Side<T>, transport: Transport) -> Scatter<T> {
        let reflects = wi.z > T::ZERO;
        let half = self.half(side, wo, wi, reflects);
        let squared = half.length_squared();
        let inverse_squared = T::ONE / squared;
        let inverse = inverse_squared.sqrt();
        let wm = half * inverse;
        let (cos_o, cos_i) = (wo.dot(wm), wi.dot(wm));
        // Facets seen from behind do not scatter; a half vector of zero length is NaN here.
        let lit = cos_o > T::ZERO && T::select(reflects, cos_i, -cos_i) > T::ZERO;
        // The refracted cosine of Snell's law cancels at the critical angle; here it is known.
        let sin2_o = (T::ONE - cos_o) * (T::ONE + cos_o);
        let snell = T::ONE - sin2_o * (side.inverse * side.inverse);
        let bent = refraction(cos_o, T::select(reflects, snell, cos_i * cos_i), side.eta);

        // The facet's other direction, which shares its samples.
        let along = T::select(reflects, side.inverse * cos_o - bent.cos_t, T::TWO * cos_o);
        let back = T::select(reflects, side.inverse, T::ONE);
        let other = wm * along - wo * back;
        let is_other_valid = T::select(reflects, -other.z, other.z) > T::ZERO;
        let (r, t) = (bent.reflectance, bent.transmittance);
        let rest = T::select(is_other_valid, T::select(reflects, t, r), T::ZERO);
        let here = Carried::new(self, T::select(reflects, r, t), wo, wi);
        let there = Carried::new(self, rest, wo, other);

        let sigma = self.ndf.projected_area(wo);
        let (chosen, norm) = if self.is_branch_first() {
            let p = self.branch_probability(wo, side.eta);
            let reflected = self.ndf.reflection_norm_by(self.sampler, wo);
            (
                T::select(reflects, p, T::ONE - p),
                T::select(reflects, reflected, sigma),
            )
        } else {
            (here.share(there), sigma)
        };
        let (far2, carried2) = self.stretches(side, transport);
        let d = self.ndf.d_along(half, squared);
        let bend = cos_o * cos_i.abs() * inverse_squared;
        let quarter = T::of(0.25);
        let scattered = lit && wi.z != T::ZERO;
        Scatter {
            value: T::select(scattered, here.value(), T::ZERO),
            chosen: T::select(scattered, chosen, T::ZERO),
            norm,
            density: d * T::select(reflects, quarter, far2 * bend),
            carried: d * T::select(reflects, quarter, carried2 * bend),
        }
    }

    /// Samples for `wo` on its own side: the normal, then the branch.
    #[inline(always)]
    fn sample_normal_first(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        side: Side<T>,
        transport: Transport,
    ) -> Option<BsdfSample<T>> {
        let wm = self.ndf.sample_wm(wo, [u[1], u[2]]);
        let cos_o = wo.dot(wm).at_least(T::ZERO);
        let sin2_o = (T::ONE - cos_o) * (T::ONE + cos_o);
        let cos2_t = T::ONE - sin2_o * (side.inverse * side.inverse);
        let bent = refraction(cos_o, cos2_t, side.eta);
        let wr = reflect(wo, wm);
        let wt = wm * (side.inverse * cos_o - bent.cos_t) - wo * side.inverse;
        let up = T::select(wr.z > T::ZERO, bent.reflectance, T::ZERO);
        let down = T::select(wt.z < T::ZERO, bent.transmittance, T::ZERO);
        let reflected = Carried::new(self, up, wo, wr);
        let transmitted = Carried::new(self, down, wo, wt);

        let (all_top, all_bottom) = reflected.plus(transmitted);
        let shares = T::ONE / all_top.at_least(T::TINY);
        let reflection = reflected.top * transmitted.bottom * shares;
        let reflects = u[0] < reflection;
        let transmission = transmitted.top * reflected.bottom * shares;
        // The half vector of the direction as it was rounded, as `eval` will see it.
        let (wi, half, squared, jacobian, scale) = if reflects {
            let half = self.half(side, wo, wr, true);
            let jacobian = (reflection, T::of(4.0));
            (wr, half, half.length_squared(), jacobian, T::ONE)
        } else {
            let half = self.half(side, wo, wt, false);
            let squared = half.length_squared();
            let (far2, _) = self.stretches(side, transport);
            let bend = transmission * far2 * wo.dot(half) * wt.dot(half).abs();
            let scale = match transport {
                Transport::Radiance => side.inverse * side.inverse,
                Transport::Importance => T::ONE,
            };
            (wt, half, squared, (bend, squared * squared), scale)
        };
        let sigma = self.ndf.projected_area(wo);
        let (top, bottom) = jacobian;
        let d = self.ndf.d_along(half, squared);
        let pdf = d * top / (sigma * bottom).at_least(T::TINY);
        let weight = sigma * all_top / all_bottom.at_least(T::TINY);
        self.scattered(wi, weight * scale, pdf, reflects, side)
    }

    /// Samples for `wo` on its own side: the branch, then the normal.
    #[inline(always)]
    fn sample_branch_first(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        side: Side<T>,
        transport: Transport,
    ) -> Option<BsdfSample<T>> {
        let direction = [u[1], u[2]];
        let reflects = u[0] < self.branch_probability(wo, side.eta);
        let wi = if reflects {
            self.ndf.sample_reflection_by(self.sampler, wo, direction)
        } else {
            let wm = self.ndf.sample_wm(wo, direction);
            let bent = dielectric(wo.dot(wm), side.eta);
            if bent.transmittance <= T::ZERO {
                return None;
            }
            refract(wo, wm, wo.dot(wm), bent.cos_t, side.eta)
        };
        let s = self.scatter(wo, wi, side, transport);
        let weight = s.value * s.norm * (s.carried / (s.density * s.chosen));
        self.scattered(wi, weight, s.pdf(), reflects, side)
    }

    /// Samples one branch alone, by all visible normals. The weight is of that branch: for walks
    /// that follow reflection and refraction one by one.
    #[inline(always)]
    pub(crate) fn sample_branch(
        &self,
        wo: Vec3<T>,
        u: [T; 2],
        reflects: bool,
        transport: Transport,
    ) -> Option<BsdfSample<T>> {
        let side = self.side(wo);
        let wo = vec3(wo.x, wo.y, wo.z * side.turn);
        let wm = self.ndf.sample_wm(wo, u);
        let cos_o = wo.dot(wm).at_least(T::ZERO);
        let bent = dielectric(cos_o, side.eta);
        let (wi, fresnel) = if reflects {
            (reflect(wo, wm), bent.reflectance)
        } else {
            let wt = wm * (side.inverse * cos_o - bent.cos_t) - wo * side.inverse;
            (wt, bent.transmittance)
        };
        let half = self.half(side, wo, wi, reflects);
        let squared = half.length_squared();
        let (far2, carried2) = self.stretches(side, transport);
        let bend = wo.dot(half) * wi.dot(half).abs() / (squared * squared);
        let sigma = self.ndf.projected_area(wo);
        let d = self.ndf.d_along(half, squared);
        let pdf = d * T::select(reflects, T::of(0.25), far2 * bend) / sigma;
        let scale = T::select(reflects, T::ONE, carried2 / far2);
        let weight = Carried::new(self, fresnel, wo, wi).value() * sigma;
        self.scattered(wi, weight * scale, pdf, reflects, side)
    }

    /// `f |cos|` and the density of [`sample_branch`](Self::sample_branch) for the branch of `wi`.
    #[inline(always)]
    pub(crate) fn eval_branch(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (T, T) {
        let side = self.side(wo);
        let upright = |w: Vec3<T>| vec3(w.x, w.y, w.z * side.turn);
        let s = self.scatter(upright(wo), upright(wi), side, transport);
        let pdf = T::select(s.value > T::ZERO, s.density / s.norm, T::ZERO);
        (s.f_cos(), pdf)
    }

    /// The sample of one of the branches, on the side where `wo` is; `None` on the wrong side, or
    /// where the density is not positive and finite.
    #[inline(always)]
    fn scattered(
        &self,
        wi: Vec3<T>,
        weight: T,
        pdf: T,
        reflects: bool,
        side: Side<T>,
    ) -> Option<BsdfSample<T>> {
        let height = T::select(reflects, wi.z, -wi.z);
        (height > T::ZERO && pdf > T::ZERO && pdf <= T::MAX).then_some(BsdfSample {
            wi: vec3(wi.x, wi.y, wi.z * side.turn),
            weight: self.tints.on_side(reflects) * weight,
            pdf,
            event: if reflects {
                Event::Reflection
            } else {
                Event::Transmission
            },
            specular: false,
            eta: T::select(reflects, T::ONE, side.eta),
        })
    }
}

impl<T: Real> RoughDielectric<T> {
    /// Distance of the index from 1 below which nothing bends.
    pub const INDEX_MATCHED: f64 = 1e-3;

    /// The same interface, sampled by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }
}

/// The interface as a view meets it.
#[derive(Clone, Copy)]
struct Side<T> {
    /// Whether the view is from inside an interface with both sides.
    inside: bool,
    /// Factor of z that turns the view above the horizon.
    turn: T,
    /// Index beyond over the index on the side of the view.
    eta: T,
    /// `1 / eta`.
    inverse: T,
}

/// `F G2 / |wo.z|` or `(1 - F) G2 / |wo.z|` of one of a facet's directions, as numerator and
/// denominator.
#[derive(Clone, Copy)]
struct Carried<T> {
    top: T,
    bottom: T,
}

impl<T: Real> Carried<T> {
    #[inline(always)]
    fn new<N: VisibleNormals<T>>(
        lobe: &RoughDielectric<T, N>,
        fresnel: T,
        wo: Vec3<T>,
        wi: Vec3<T>,
    ) -> Self {
        let (top, bottom) = lobe.ndf.g2_over_cos_quotient(lobe.masking, wo, wi);
        Self {
            top: fresnel * top,
            bottom,
        }
    }

    #[inline(always)]
    fn value(self) -> T {
        T::select(self.bottom > T::ZERO, self.top / self.bottom, T::ZERO)
    }

    /// The sum, as numerator and denominator.
    #[inline(always)]
    fn plus(self, other: Self) -> (T, T) {
        let top = self.top * other.bottom + other.top * self.bottom;
        (top, self.bottom * other.bottom)
    }

    /// `self / (self + other)`; 0 where both vanish.
    #[inline(always)]
    fn share(self, other: Self) -> T {
        let sum = self.plus(other).0;
        T::select(sum > T::ZERO, self.top * other.bottom / sum, T::ZERO)
    }
}

/// What happens between two directions.
#[derive(Clone, Copy)]
struct Scatter<T> {
    /// `F G2 / |wo.z|`, or `(1 - F) G2 / |wo.z|`.
    value: T,
    /// Probability of the branch.
    chosen: T,
    /// `N` of the density of directions `D jacobian |wo.wm| / N`.
    norm: T,
    /// `D jacobian |wo.wm|`.
    density: T,
    /// The same, for what the path carries.
    carried: T,
}

impl<T: Real> Scatter<T> {
    #[inline(always)]
    fn pdf(&self) -> T {
        let pdf = self.chosen * self.density / self.norm;
        T::select(self.chosen > T::ZERO, pdf, T::ZERO)
    }

    #[inline(always)]
    fn f_cos(&self) -> T {
        let f_cos = self.value * self.carried;
        T::select(self.value > T::ZERO, f_cos, T::ZERO)
    }
}

impl<T: Real, N: VisibleNormals<T>> Bsdf<T> for RoughDielectric<T, N> {
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
        let side = self.side(wo);
        let upright = vec3(wo.x, wo.y, wo.z * side.turn);
        if self.is_branch_first() {
            self.sample_branch_first(upright, u, side, transport)
        } else {
            self.sample_normal_first(upright, u, side, transport)
        }
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        if self.is_index_matched() {
            return (Rgb::BLACK, T::ZERO);
        }
        let side = self.side(wo);
        let upright = |w: Vec3<T>| vec3(w.x, w.y, w.z * side.turn);
        let wi = upright(wi);
        let s = self.scatter(upright(wo), wi, side, transport);
        (self.tints.on_side(wi.z > T::ZERO) * s.f_cos(), s.pdf())
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
