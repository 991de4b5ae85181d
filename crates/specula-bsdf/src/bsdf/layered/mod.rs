//! A coat with a medium over a base, by random walks between the two: lacquered metal, painted wood
//! with a cloudy varnish.
//!
//! Position-free transport between parallel interfaces (Guo, Hasan and Zhao 2018), as in pbrt-v4's
//! `LayeredBxDF` (Pharr, Jakob and Humphreys 2023, 14.3): light passes the coat or is reflected;
//! below, it crosses a slab of optical thickness `t` with the transmittance `exp(-t / |cos|)` or scatters in
//! it, meets base and coat in turn, and ends after a number of events. Each surface scatters singly
//! (Cook and Torrance), so what a rough one scatters twice is lost.
//!
//! Values are unbiased estimates. pbrt's value is not where its coat is rough: it weighs two ways of
//! connecting by densities of which one is taken the wrong way round. The walk here is that by which
//! pbrt samples directions.

mod base;
mod coat;
mod connect;
mod density;
mod medium;
mod walk;

pub use base::Base;
pub use medium::Medium;

use super::{Bsdf, BsdfSample, Event, Transport};
use crate::fresnel::dielectric;
use crate::math::{Real, Rgb, Stream, Vec3, vec3};
use crate::multibounce::seed;
use crate::ndf::{Ggx, Ndf};
use crate::vndf::Sampler;
use coat::Coat;

/// Events below the coat after which a walk ends whatever it carries.
const MOST_EVENTS: u32 = 1000;

/// A dielectric coat, a medium and a base.
///
/// Smooth on smooth, without scattering, it is a mirror in closed form, `k` counting bounces off the base:
///
/// ```text
/// R + T^2 sum_(k = 1)^(n / 2) F^k R^(k - 1) exp(-2 k t / |cos'|)
/// ```
///
/// with `n` of [`with_max_depth`](Self::with_max_depth).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layered<T> {
    coat: Coat<T>,
    base: Base<T>,
    medium: Medium<T>,
    /// The base's normals as the density sees them.
    blurred: Option<Ggx<T>>,
    max_depth: u32,
    walks: u32,
    sampler: Sampler,
}

impl<T: Real> Layered<T> {
    /// A coat without a medium, whose light is followed until it leaves.
    ///
    /// * `coat`: distribution of its normals; `None` for a smooth one.
    /// * `eta`: index of the coat over that outside, clamped to `[1, 3]`.
    #[inline]
    pub fn new(coat: Option<Ggx<T>>, eta: T, base: Base<T>) -> Self {
        let eta = eta.within(T::ONE, T::of(3.0));
        // With equal indices nothing is bent, however rough.
        let coat = coat.filter(|_| eta > T::of(1.001));
        let base = base.under(eta);
        Self {
            coat: Coat { ndf: coat, eta },
            blurred: density::blurred(&base, coat, eta),
            base,
            medium: Medium::NONE,
            max_depth: MOST_EVENTS,
            walks: 1,
            sampler: Sampler::default(),
        }
    }

    /// The same surfaces about another medium.
    #[inline]
    #[must_use]
    pub fn with_medium(self, medium: Medium<T>) -> Self {
        Self {
            medium: medium.clamped(),
            ..self
        }
    }

    /// The same material whose walks end after `max_depth` events below the coat's surface: bounces off
    /// coat and base, collisions in the medium, and leaving. 1000 at most.
    #[inline]
    #[must_use]
    pub fn with_max_depth(self, max_depth: u32) -> Self {
        Self {
            max_depth: max_depth.min(MOST_EVENTS),
            ..self
        }
    }

    /// The same material whose values are means of several walks, 1 to 1024.
    #[inline]
    #[must_use]
    pub fn with_walks(self, walks: u32) -> Self {
        Self {
            walks: walks.clamp(1, 1024),
            ..self
        }
    }

    /// The same material, its metal sampled by another sampler.
    #[inline]
    #[must_use]
    pub fn with_sampler(self, sampler: Sampler) -> Self {
        Self {
            base: self.base.with_sampler(sampler),
            sampler,
            ..self
        }
    }

    /// Whether all that leaves is mirrored.
    #[inline]
    fn is_mirror(&self) -> bool {
        self.base.is_mirror() && !self.coat.is_rough() && !self.medium.scatters()
    }

    /// Whether the base's lobe is less than half as wide as a rough coat's: then first bounces are
    /// sampled from the light, too.
    #[inline]
    fn is_base_narrow(&self) -> bool {
        let alpha = |ggx: Ggx<T>| ggx.alpha().x.at_least(ggx.alpha().y);
        let coat = self.coat.ndf.map_or(T::ZERO, alpha);
        let base = match self.base {
            Base::Mirror(_) => T::ZERO,
            Base::Metal(m) => alpha(m.ndf),
            Base::Diffuse(_) => return false,
        };
        T::TWO * base < coat
    }

    /// What leaves along `v` between two smooth surfaces, of light that starts upwards and of light
    /// that starts downwards, `F` not yet taken.
    ///
    /// ```text
    /// (up + F down) (1 + x + x^2 + ..),   x = F R exp(-2 t / |cos|)
    /// ```
    ///
    /// * `events`: how many are allowed, leaving included.
    fn echoes(&self, v: Vec3<T>, up: T, down: T, events: u32) -> Rgb<T> {
        let back = dielectric(v.z, T::ONE / self.coat.eta).reflectance;
        let through = Medium::transmittance(self.medium.thickness, v);
        self.base.reflectance(v.z).map(|fresnel| {
            let x = fresnel * back * through * through;
            up * series(x, events.div_ceil(2)) + fresnel * down * series(x, events / 2)
        })
    }

    /// Reflectance of smooth on smooth.
    fn mirrored(&self, wo: Vec3<T>) -> Rgb<T> {
        let coat = dielectric(wo.z.abs(), self.coat.eta);
        let below = self.coat.below(wo);
        let through = Medium::transmittance(self.medium.thickness, below);
        let (passed, back) = (coat.transmittance, coat.reflectance);
        self.base.reflectance(below.z).map(|fresnel| {
            let once = fresnel * through * through;
            back + passed * passed * once * series(once * back, self.max_depth / 2)
        })
    }
}

/// `1 + x + x^2 + ..`, of a number of terms.
///
/// * `x`: in `[0, 1]`.
#[inline]
fn series<T: Real>(x: T, terms: u32) -> T {
    let x = x.within(T::TINY, T::ONE - T::EPSILON);
    let cut = T::ONE - (T::of(f64::from(terms)) * x.ln()).exp();
    cut / (T::ONE - x)
}

impl<T: Real> Bsdf<T> for Layered<T> {
    #[inline]
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.eval_pdf(wo, wi, transport).0
    }

    #[inline]
    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        density::pdf(self, wo, wi)
    }

    #[inline]
    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        self.sample_random(wo, u, transport, &mut seed(wo, u))
    }

    #[inline]
    fn eval_pdf(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> (Rgb<T>, T) {
        self.eval_pdf_random(wo, wi, transport, &mut seed(wo, wi.to_array()))
    }

    #[inline]
    fn is_stochastic(&self) -> bool {
        !self.is_mirror()
    }

    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        _transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        if wi.z <= T::ZERO || self.is_mirror() {
            return (Rgb::BLACK, T::ZERO);
        }
        let mut sum = Rgb::BLACK;
        for _ in 0..self.walks {
            sum += walk::eval(self, wo, wi, stream);
        }
        let share = T::ONE / T::of(f64::from(self.walks));
        let f_cos = Rgb::splat(self.coat.reflection(wo, wi)) + sum * share;
        (f_cos, self.pdf(wo, wi))
    }

    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        _transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        let delta = |wi, weight| BsdfSample::delta(wi, weight, T::ONE, Event::Reflection, T::ONE);
        if self.is_mirror() {
            let mirrored = vec3(-wo.x, -wo.y, wo.z);
            return (wo.z > T::ZERO).then(|| delta(mirrored, self.mirrored(wo)));
        }
        let left = walk::sample(self, wo, u, stream)?;
        if left.wi.z <= T::ZERO {
            return None;
        }
        if left.specular {
            return Some(delta(left.wi, left.weight));
        }
        BsdfSample::reflected(left.wi, left.weight, self.pdf(wo, left.wi))
    }

    #[inline]
    fn is_specular(&self) -> bool {
        self.is_mirror()
    }

    #[inline]
    fn albedo(&self) -> Rgb<T> {
        self.base.reflectance(T::of(2.0 / 3.0))
    }
}
