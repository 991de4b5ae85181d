//! A dielectric coat over metal: lacquered brass, clear-coated rims.
//!
//! Directions are bent at the coat's mean surface, the metal reflects them there, and the bounces
//! between metal and coat are summed as a geometric series:
//!
//! ```text
//! f cos = f_coat cos + T(wo) T(wi) (f_metal cos)(wo', wi') / (1 - F (R(wo) + R(wi)) / 2)  dwi'/dwi
//! dwi'/dwi = |wi.z| / (eta^2 |wi'.z|)
//! ```
//!
//! with `R = 1 - T` the coat's Fresnel reflectance and `F` the metal's under the coat. For a smooth
//! coat over smooth metal this is exact, `R + T^2 F / (1 - F R)`. It is reciprocal. A rough coat
//! blurs the metal below it: twice refracted slopes add variance, `a'^2 = a^2 + (1 - 1/eta)^2
//! a_coat^2 / 2` (the first-order statistics of Belcour 2018).
//!
//! Free of noise, and a vector in batches. Known limits, against [`Layered`](super::Layered), which
//! walks between the layers and is what the renderer takes: metal reflections beyond the critical
//! angle end there, so that metal of alpha 0.2 to 0.5 under a smooth coat is 7 to 20 % too dark; the
//! coat's facets lose nothing on the way through, so that a near mirror under a coat of alpha 0.14 is 5 to
//! 16 % too bright; the coat does not absorb.

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::alpha::Alpha;
use crate::fresnel::{Reflectance, Refraction, dielectric};
use crate::math::{Real, Rgb, Vec3, vec3};
use crate::ndf::{Ggx, Masking, Ndf};
use crate::vndf::Sampler;

/// Metal under a dielectric coat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedConductor<T> {
    pub(crate) coat: Option<Ggx<T>>,
    pub(crate) eta: T,
    pub(crate) metal: Option<Ggx<T>>,
    pub(crate) reflectance: Reflectance<T>,
    pub(crate) sampler: Sampler,
}

impl<T: Real> CoatedConductor<T> {
    /// * `coat`, `metal`: distributions of normals; `None` for smooth surfaces.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    /// * `reflectance`: of the metal against vacuum; an index is made relative to the coat's.
    #[inline]
    pub fn new(
        coat: Option<Ggx<T>>,
        eta: T,
        metal: Option<Ggx<T>>,
        reflectance: Reflectance<T>,
    ) -> Self {
        let eta = Real::clamp(eta, T::ONE, T::of(3.0));
        Self {
            coat,
            eta,
            metal: blurred(metal, coat, eta),
            reflectance: reflectance.under(eta),
            sampler: Sampler::default(),
        }
    }

    /// The same material, sampled by another sampler.
    #[inline(always)]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }

    /// The direction below the coat. A view from behind (a backfacing shading normal) enters as its
    /// mirror image does, so that the lobe is continuous there.
    #[inline(always)]
    fn below(&self, w: Vec3<T>) -> Vec3<T> {
        let inverse = T::ONE / self.eta;
        let (x, y) = (w.x * inverse, w.y * inverse);
        vec3(x, y, (T::ONE - x * x - y * y).safe_sqrt())
    }

    /// The direction above the coat; `None` for a direction downwards or beyond the critical angle.
    #[inline(always)]
    fn above(&self, w: Vec3<T>) -> Option<Vec3<T>> {
        let (x, y) = (w.x * self.eta, w.y * self.eta);
        let z2 = T::ONE - x * x - y * y;
        (w.z > T::ZERO && z2 > T::ZERO).then(|| vec3(x, y, z2.sqrt()))
    }

    /// What the coat's mean surface reflects and lets through from `w`.
    #[inline(always)]
    fn at_coat(&self, w: Vec3<T>) -> Refraction<T> {
        dielectric(w.z.abs(), self.eta)
    }

    /// Probability of drawing the coat's reflection; 0 for a mirror that faces away.
    #[inline(always)]
    fn coat_probability(&self, coat: Refraction<T>, wo: Vec3<T>) -> T {
        let metal = self.reflectance.eval(self.below(wo).z).max_channel();
        let visible = self.coat.is_some() || wo.z > T::ZERO;
        let below = coat.transmittance * metal;
        let share = coat.reflectance / Real::max(coat.reflectance + below, T::TINY);
        T::select(visible, share, T::ZERO)
    }

    /// Transmission both ways with the series of bounces, times the metal's reflectance.
    #[inline(always)]
    fn through(&self, coat_o: Refraction<T>, coat_i: Refraction<T>, metal: Rgb<T>) -> Rgb<T> {
        let passed = coat_o.transmittance * coat_i.transmittance;
        let back = T::HALF * (coat_o.reflectance + coat_i.reflectance);
        metal.map(|f| passed * f / Real::max(T::ONE - f * back, T::EPSILON))
    }

    /// A sampled direction, `(0, 0, 0)` where there is none, where both surfaces are rough.
    #[inline(always)]
    pub(crate) fn draw(&self, coat: Ggx<T>, metal: Ggx<T>, wo: Vec3<T>, u: [T; 3]) -> Vec3<T> {
        let direction = [u[1], u[2]];
        if u[0] < self.coat_probability(self.at_coat(wo), wo) {
            coat.sample_reflection(self.sampler, wo, direction)
        } else {
            let below = metal.sample_reflection(self.sampler, self.below(wo), direction);
            self.above(below).unwrap_or(Vec3::ZERO)
        }
    }

    /// `N` of the coat's and of the metal's reflections, whose densities are `D / (4 N)`; 1 where
    /// smooth.
    #[inline(always)]
    pub(crate) fn norms(&self, wo: Vec3<T>) -> [T; 2] {
        let norm = |ggx: Option<Ggx<T>>, w: Vec3<T>| match ggx {
            Some(ggx) => ggx.reflection_norm(self.sampler, w),
            None => T::ONE,
        };
        [norm(self.coat, wo), norm(self.metal, self.below(wo))]
    }

    /// What a sampled direction weighs, given [`norms`](Self::norms).
    #[inline(always)]
    pub(crate) fn weigh(
        &self,
        metal: Ggx<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        norms: [T; 2],
    ) -> Option<BsdfSample<T>> {
        let (f_cos, pdf) = self.evaluate(metal, wo, wi, norms);
        BsdfSample::reflected(wi, f_cos / pdf, pdf)
    }

    /// `f |cos|` and its density, given [`norms`](Self::norms). Free of branches, so that batches are.
    #[inline(always)]
    pub(crate) fn evaluate(
        &self,
        metal: Ggx<T>,
        wo: Vec3<T>,
        wi: Vec3<T>,
        norms: [T; 2],
    ) -> (Rgb<T>, T) {
        let masking = Masking::HeightCorrelated;
        let coat_o = self.at_coat(wo);
        let p = self.coat_probability(coat_o, wo);

        let (below_o, below_i) = (self.below(wo), self.below(wi));
        let bend = wi.z / (self.eta * self.eta * below_i.z);
        let (d, cos) = facet(metal, below_o, below_i);
        let quarter = T::of(0.25) * d * bend;
        let passed = self.through(coat_o, self.at_coat(wi), self.reflectance.eval(cos));
        let mut f_cos = passed * (quarter * metal.g2_over_cos(masking, below_o, below_i));
        let mut pdf = (T::ONE - p) * quarter / norms[1];

        if let Some(coat) = self.coat {
            let (d, cos) = facet(coat, wo, wi);
            let quarter = T::of(0.25) * d;
            let fresnel = dielectric(cos, self.eta).reflectance;
            f_cos += Rgb::splat(fresnel * quarter * coat.g2_over_cos(masking, wo, wi));
            pdf += p * quarter / norms[0];
        }
        if wi.z > T::ZERO {
            (f_cos, pdf)
        } else {
            (Rgb::BLACK, T::ZERO)
        }
    }
}

/// `D` of the facet that reflects `wo` into `wi`, 0 below the horizon, and its cosine with both:
/// half the length of `wo + wi`.
#[inline(always)]
fn facet<T: Real>(ggx: Ggx<T>, wo: Vec3<T>, wi: Vec3<T>) -> (T, T) {
    let half = wo + wi;
    let squared = half.length_squared();
    (ggx.d_along(half, squared), T::HALF * squared.sqrt())
}

/// The metal's normals as blurred by a rough coat.
pub(super) fn blurred<T: Real>(
    metal: Option<Ggx<T>>,
    coat: Option<Ggx<T>>,
    eta: T,
) -> Option<Ggx<T>> {
    let Some(coat) = coat else { return metal };
    let bend = T::ONE - T::ONE / eta;
    let width = |metal: T, coat: T| (metal * metal + T::HALF * bend * bend * coat * coat).sqrt();
    let own = metal.map_or((T::ZERO, T::ZERO), |m| (m.alpha().x, m.alpha().y));
    let least = T::of(Alpha::<T>::SPECULAR_BELOW);
    let x = Real::max(width(own.0, coat.alpha().x), least);
    let y = Real::max(width(own.1, coat.alpha().y), least);
    Some(Ggx::new(Alpha::clamped(x, y)))
}

impl<T: Real> Bsdf<T> for CoatedConductor<T> {
    #[inline(always)]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline(always)]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.eval_pdf(wo, wi, Transport::Radiance).1
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], _transport: Transport) -> Option<BsdfSample<T>> {
        let coat = self.at_coat(wo);
        let mirrored = vec3(-wo.x, -wo.y, wo.z);
        let delta = |weight, p| {
            let reflection = Event::Reflection;
            (wo.z > T::ZERO).then(|| BsdfSample::delta(mirrored, weight, p, reflection, T::ONE))
        };
        let Some(metal) = self.metal else {
            let fresnel = self.reflectance.eval(self.below(wo).z);
            let metal = self.through(coat, coat, fresnel);
            return delta(Rgb::splat(coat.reflectance) + metal, T::ONE);
        };
        let p = self.coat_probability(coat, wo);
        let direction = [u[1], u[2]];
        let wi = if u[0] < p {
            match self.coat {
                Some(ggx) => ggx.sample_reflection(self.sampler, wo, direction),
                None => return delta(Rgb::splat(coat.reflectance / p), p),
            }
        } else {
            self.above(metal.sample_reflection(self.sampler, self.below(wo), direction))?
        };
        self.weigh(metal, wo, wi, self.norms(wo))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, _transport: Transport) -> (Rgb<T>, T) {
        let Some(metal) = self.metal else {
            return (Rgb::BLACK, T::ZERO);
        };
        if wi.z <= T::ZERO {
            return (Rgb::BLACK, T::ZERO);
        }
        self.evaluate(metal, wo, wi, self.norms(wo))
    }

    #[inline(always)]
    fn is_specular(&self) -> bool {
        self.metal.is_none()
    }

    #[inline(always)]
    fn albedo(&self) -> Rgb<T> {
        self.reflectance.eval(T::of(2.0 / 3.0))
    }
}
