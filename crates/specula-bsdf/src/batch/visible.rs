//! Reflections off visible GGX normals, and their densities, without a lobe.

use super::alphas::{AlphaAt, AlphaSlices, Alphas, IsotropicAlpha, OneAlpha};
use super::level::{Arithmetic, Level, Task};
use super::recast::{Recast, convert};
use super::slices::{Directions, LengthMismatch, check};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3, vec3};
use crate::ndf::Ggx;
use crate::vndf::{self, Sampler, exact};

const WO: [&str; 3] = ["wo.x", "wo.y", "wo.z"];
const WI: [&str; 3] = ["wi.x", "wi.y", "wi.z"];

impl Level {
    /// Directions reflected off visible GGX normals; `(0, 0, 0)` where rejected.
    ///
    /// * `wo: (n, 3) T`, `u: (n, 2) T` in `[0, 1)` `-> wi: (n, 3) T`
    /// * `alphas`: one alpha, or `(n,) T` twice.
    ///
    /// # Errors
    /// Where a slice is not as long as `wi.x`; nothing is written then.
    pub fn sample_reflection<T: Real>(
        self,
        sampler: Sampler,
        alpha_values: Alphas<T>,
        wo: Directions<&[T]>,
        u: [&[T]; 2],
        wi: Directions<&mut [T]>,
    ) -> Result<(), LengthMismatch> {
        let n = wi.x.len();
        check(n, wi.lengths(WI))?;
        check(n, wo.lengths(WO))?;
        check(n, ["u[0]", "u[1]"].into_iter().zip(u.map(<[T]>::len)))?;
        alpha_values.check(n)?;
        self.run(Reflections {
            sampler,
            alpha_values,
            wo,
            u,
            wi,
        });
        Ok(())
    }

    /// Densities of [`sample_reflection`](Level::sample_reflection) in 1/sr; 0 where `wi.z <= 0`.
    ///
    /// * `wo: (n, 3) T`, `wi: (n, 3) T -> pdf: (n,) T`
    /// * `alphas`: one alpha, or `(n,) T` twice.
    ///
    /// # Errors
    /// Where a slice is not as long as `pdf`; nothing is written then.
    pub fn reflection_pdf<T: Real>(
        self,
        sampler: Sampler,
        alpha_values: Alphas<T>,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        let n = pdf.len();
        check(n, wo.lengths(WO).into_iter().chain(wi.lengths(WI)))?;
        alpha_values.check(n)?;
        self.run(Densities {
            sampler,
            alpha_values,
            wo,
            wi,
            pdf,
        });
        Ok(())
    }
}

struct Reflections<'a, T> {
    sampler: Sampler,
    alpha_values: Alphas<'a, T>,
    wo: Directions<&'a [T]>,
    u: [&'a [T]; 2],
    wi: Directions<&'a mut [T]>,
}

impl<T: Real> Task for Reflections<'_, T> {
    #[inline(always)]
    fn run<A: Arithmetic>(self) {
        let n = self.wi.x.len();
        let is_exact = self.sampler == Sampler::Exact;
        match self.alpha_values {
            Alphas::Same(Alpha { x, y }) if x == y && is_exact => {
                self.exact::<A::Of<T>, false>(IsotropicAlpha(convert(x)));
            }
            Alphas::Same(alpha) if is_exact => {
                self.exact::<A::Of<T>, true>(OneAlpha(alpha.recast()));
            }
            Alphas::Same(alpha) => self.with::<A::Of<T>>(OneAlpha(alpha.recast())),
            Alphas::PerElement { alpha_x, alpha_y } => {
                let alphas = AlphaSlices::first(alpha_x, alpha_y, n);
                if is_exact && alphas.all_unequal() {
                    self.exact::<A::Of<T>, true>(alphas);
                } else {
                    self.with::<A::Of<T>>(alphas);
                }
            }
        }
    }
}

impl<T: Real> Reflections<'_, T> {
    #[inline(always)]
    fn with<U: Real>(self, alpha_values: impl AlphaAt<U>) {
        // A constant sampler in each arm, so that the loop does not branch on it.
        match self.sampler {
            Sampler::Heitz => self.sampled_by(Sampler::Heitz, alpha_values),
            Sampler::Cap => self.sampled_by(Sampler::Cap, alpha_values),
            Sampler::Bounded => self.sampled_by(Sampler::Bounded, alpha_values),
            Sampler::Exact => self.sampled_by(Sampler::Exact, alpha_values),
        }
    }

    /// Exact reflections. Where all views lie above the horizon, the loop is spared the sampler that serves views below, and
    /// the choice between equal alphas and `UNEQUAL` ones. Without blends (SSE2, NEON) neither leaves a vector loop.
    #[inline(always)]
    fn exact<U: Real, const UNEQUAL: bool>(self, alpha_values: impl AlphaAt<U>) {
        let above = self.wo.z.iter().fold(true, |all, &z| all & (z > T::TINY));
        if !above {
            return self.sampled_by(Sampler::Exact, alpha_values);
        }
        let n = self.wi.x.len();
        let [u0, u1] = self.u;
        let (wo, u0, u1) = (self.wo.first(n), &u0[..n], &u1[..n]);
        let mut wi = self.wi.first(n);
        for i in 0..n {
            let u = [convert(u0[i]), convert(u1[i])];
            let wo: Vec3<U> = wo.get_as(i);
            // Known to be above.
            let wo = vec3(wo.x, wo.y, wo.z.at_least(U::TINY));
            let alpha = alpha_values.at(i);
            let sampled = if UNEQUAL {
                exact::sample_along_chords(alpha, wo, u)
            } else {
                exact::sample_direction(alpha, wo, u)
            };
            let above = sampled.z > U::ZERO;
            wi.set_from(i, if above { sampled } else { Vec3::ZERO });
        }
    }

    #[inline(always)]
    fn sampled_by<U: Real>(self, sampler: Sampler, alpha_values: impl AlphaAt<U>) {
        let n = self.wi.x.len();
        let [u0, u1] = self.u;
        let (wo, u0, u1) = (self.wo.first(n), &u0[..n], &u1[..n]);
        let mut wi = self.wi.first(n);
        for i in 0..n {
            let ndf = Ggx::new(alpha_values.at(i));
            let u = [convert(u0[i]), convert(u1[i])];
            let sampled = ndf.sample_reflection(sampler, wo.get_as(i), u);
            let above = sampled.z > U::ZERO;
            wi.set_from(i, if above { sampled } else { Vec3::ZERO });
        }
    }
}

struct Densities<'a, T> {
    sampler: Sampler,
    alpha_values: Alphas<'a, T>,
    wo: Directions<&'a [T]>,
    wi: Directions<&'a [T]>,
    pdf: &'a mut [T],
}

impl<T: Real> Task for Densities<'_, T> {
    #[inline(always)]
    fn run<A: Arithmetic>(self) {
        let n = self.pdf.len();
        match self.alpha_values {
            Alphas::Same(Alpha { x, y }) if x == y && self.sampler == Sampler::Exact => {
                self.sampled_by::<A::Of<T>>(Sampler::Exact, IsotropicAlpha(convert(x)));
            }
            Alphas::Same(alpha) => self.with::<A::Of<T>>(OneAlpha(alpha.recast())),
            Alphas::PerElement { alpha_x, alpha_y } => {
                self.with::<A::Of<T>>(AlphaSlices::first(alpha_x, alpha_y, n));
            }
        }
    }
}

impl<T: Real> Densities<'_, T> {
    #[inline(always)]
    fn with<U: Real>(self, alpha_values: impl AlphaAt<U>) {
        match self.sampler {
            Sampler::Heitz | Sampler::Cap => self.sampled_by(Sampler::Cap, alpha_values),
            Sampler::Bounded => self.sampled_by(Sampler::Bounded, alpha_values),
            Sampler::Exact => self.sampled_by(Sampler::Exact, alpha_values),
        }
    }

    #[inline(always)]
    fn sampled_by<U: Real>(self, sampler: Sampler, alpha_values: impl AlphaAt<U>) {
        let n = self.pdf.len();
        let (wo, wi) = (self.wo.first(n), self.wi.first(n));
        let pdf = &mut self.pdf[..n];
        for (i, pdf) in pdf.iter_mut().enumerate() {
            let (alpha, wo, wi) = (alpha_values.at(i), wo.get_as(i), wi.get_as(i));
            let density: U = match sampler {
                Sampler::Heitz | Sampler::Cap => vndf::cap::reflection_pdf(alpha, wo, wi),
                Sampler::Bounded => vndf::bounded::reflection_pdf(alpha, wo, wi),
                Sampler::Exact => vndf::exact::reflection_pdf(alpha, wo, wi),
            };
            *pdf = convert(density);
        }
    }
}
