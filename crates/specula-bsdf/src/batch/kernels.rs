//! The loops over elements.
//!
//! A loop vectorises only if it neither calls nor branches on what all elements share. So a lobe's
//! choices are matched outside the loops, with a constant in each arm; and two stages, each with a
//! loop of its own over a short chunk, need as many loops as there are samplers plus reflectances
//! instead of their product. Short loops are faster, too: the machine overlaps more iterations.

use super::columns::{self, LobeAt};
use super::lobes::{Family, InStages, Isotropic, Kernel};
use super::recast::convert;
use super::slices::{Colours, Directions, SampleOutcome, Samples};
use crate::bsdf::in_columns::InColumns;
use crate::bsdf::{Bsdf, Transport};
use crate::fresnel::Reflectance;
use crate::math::{Real, Vec3, vec3};
use crate::vndf::Sampler;

/// Elements between two stages, few enough to stay in the nearest cache.
const CHUNK: usize = 128;

// Whether there is a choice is a constant of the family's type: loops of a choice that it does not have are not compiled.

/// Runs `$body` with `$f` standing for the family, of type `F`, with a constant sampler.
macro_rules! per_sampler {
    ($family:expr, $f:ident => $body:expr) => {
        if F::HAS_SAMPLER {
            let family = $family;
            let choose = |sampler| family.with(|lobe| lobe.choose_sampler(sampler));
            match family.common().sampler() {
                Sampler::Cap => {
                    let $f = choose(Sampler::Cap);
                    $body
                }
                Sampler::Bounded => {
                    let $f = choose(Sampler::Bounded);
                    $body
                }
                Sampler::Exact if F::MAY_BE_ISOTROPIC && family.is_isotropic() => {
                    let $f = Isotropic(choose(Sampler::Exact));
                    $body
                }
                Sampler::Exact => {
                    let $f = choose(Sampler::Exact);
                    $body
                }
                Sampler::Heitz => {
                    let $f = choose(Sampler::Heitz);
                    $body
                }
            }
        } else {
            let $f = $family;
            $body
        }
    };
}

/// Runs `$body` with `$f` standing for the family, of type `F`, with a known kind of reflectance.
macro_rules! per_reflectance {
    ($family:expr, $f:ident => $body:expr) => {
        if F::HAS_REFLECTANCE {
            let family = $family;
            let choose = |reflectance| family.with(|lobe| lobe.choose_reflectance(reflectance));
            match family.common().reflectance() {
                Reflectance::Constant(r) => {
                    let $f = choose(Reflectance::Constant(r));
                    $body
                }
                Reflectance::Conductor(r) => {
                    let $f = choose(Reflectance::Conductor(r));
                    $body
                }
                Reflectance::Schlick(r) => {
                    let $f = choose(Reflectance::Schlick(r));
                    $body
                }
                Reflectance::F82Tint(r) => {
                    let $f = choose(Reflectance::F82Tint(r));
                    $body
                }
                Reflectance::Tinted(r) => {
                    let $f = choose(Reflectance::Tinted(r));
                    $body
                }
            }
        } else {
            let $f = $family;
            $body
        }
    };
}

pub(super) struct Eval<'a, T> {
    pub(super) wo: Directions<&'a [T]>,
    pub(super) wi: Directions<&'a [T]>,
    pub(super) transport: Transport,
    pub(super) f_cos: Colours<&'a mut [T]>,
}

impl<T: Real> Kernel for Eval<'_, T> {
    #[inline(always)]
    fn run<U: Real, F: Family<U>>(self, family: F) {
        // The sampler is any constant: eval does not depend on it.
        let family = family.with(|lobe| lobe.choose_sampler(Sampler::Cap));
        per_reflectance!(family, f => self.each(f));
    }

    #[inline(always)]
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        mut self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>,
    {
        for i in 0..self.f_cos.r.len() {
            let (wo, wi) = (self.wo.get_as(i), self.wi.get_as(i));
            self.f_cos
                .set_from(i, lobes.at(i).eval(wo, wi, self.transport));
        }
    }
}

impl<T: Real> Eval<'_, T> {
    #[inline(always)]
    fn each<U: Real, F: Family<U>>(self, family: F) {
        let n = self.f_cos.r.len();
        let family = family.range(0, n);
        let (wo, wi) = (self.wo.first(n), self.wi.first(n));
        let mut f_cos = self.f_cos.first(n);
        for i in 0..n {
            let lobe = family.at(i);
            let value = lobe.eval(wo.get_as(i), wi.get_as(i), self.transport);
            f_cos.set_from(i, value);
        }
    }
}

pub(super) struct Pdf<'a, T> {
    pub(super) wo: Directions<&'a [T]>,
    pub(super) wi: Directions<&'a [T]>,
    pub(super) pdf: &'a mut [T],
}

impl<T: Real> Kernel for Pdf<'_, T> {
    #[inline(always)]
    fn run<U: Real, F: Family<U>>(self, family: F) {
        per_sampler!(family, f => self.each(f));
    }

    #[inline(always)]
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>,
    {
        for (i, pdf) in self.pdf.iter_mut().enumerate() {
            *pdf = convert(lobes.at(i).pdf(self.wo.get_as(i), self.wi.get_as(i)));
        }
    }
}

impl<T: Real> Pdf<'_, T> {
    #[inline(always)]
    fn each<U: Real, F: Family<U>>(self, family: F) {
        let n = self.pdf.len();
        let family = family.range(0, n);
        let (wo, wi) = (self.wo.first(n), self.wi.first(n));
        for i in 0..n {
            let value = family.at(i).pdf(wo.get_as(i), wi.get_as(i));
            self.pdf[i] = convert(value);
        }
    }
}

pub(super) struct EvalPdf<'a, T> {
    pub(super) wo: Directions<&'a [T]>,
    pub(super) wi: Directions<&'a [T]>,
    pub(super) transport: Transport,
    pub(super) f_cos: Colours<&'a mut [T]>,
    pub(super) pdf: &'a mut [T],
}

impl<T: Real> Kernel for EvalPdf<'_, T> {
    #[inline(always)]
    fn run<U: Real, F: Family<U>>(self, family: F) {
        if F::Lobe::STAGED {
            self.in_stages(family);
        } else {
            per_sampler!(family, f => per_reflectance!(f, known => self.each(known)));
        }
    }

    #[inline(always)]
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>,
    {
        columns::eval_pdf(self, lobes);
    }
}

impl<T: Real> EvalPdf<'_, T> {
    #[inline(always)]
    fn each<U: Real, F: Family<U>>(self, family: F) {
        let n = self.pdf.len();
        let family = family.range(0, n);
        let (wo, wi) = (self.wo.first(n), self.wi.first(n));
        let mut f_cos = self.f_cos.first(n);
        for i in 0..n {
            let lobe = family.at(i);
            let (value, pdf) = lobe.eval_pdf(wo.get_as(i), wi.get_as(i), self.transport);
            f_cos.set_from(i, value);
            self.pdf[i] = convert(pdf);
        }
    }

    #[inline(always)]
    fn in_stages<U: Real, F: Family<U>>(mut self, family: F) {
        let n = self.pdf.len();
        let mut norms = [[U::ZERO; CHUNK]; 2];
        let [first, second] = &mut norms;
        let mut start = 0;
        while start < n {
            let end = n.min(start + CHUNK);
            // Slices whose common length is plain to see leave no checks in the loops.
            let count = end - start;
            let wo = self.wo.range(start, end).first(count);
            let wi = self.wi.range(start, end).first(count);
            let mut f_cos = self.f_cos.range(start, end).first(count);
            let pdf = &mut self.pdf[start..end][..count];
            let (first, second) = (&mut first[..count], &mut second[..count]);
            let family = family.range(start, end);
            per_sampler!(family, f => for i in 0..count {
                [first[i], second[i]] = f.at(i).eval_first(wo.get_as(i));
            });
            per_reflectance!(family, f => for i in 0..count {
                let first = [first[i], second[i]];
                let (value, density) = f.at(i).eval_second(wo.get_as(i), wi.get_as(i), first);
                f_cos.set_from(i, value);
                pdf[i] = convert(density);
            });
            start = end;
        }
    }
}

pub(super) struct Sample<'a, T> {
    pub(super) wo: Directions<&'a [T]>,
    pub(super) u: [&'a [T]; 3],
    pub(super) transport: Transport,
    pub(super) samples: Samples<&'a mut [T], &'a mut [SampleOutcome]>,
}

impl<T: Real> Kernel for Sample<'_, T> {
    #[inline(always)]
    fn run<U: Real, F: Family<U>>(self, family: F) {
        if F::Lobe::STAGED {
            self.in_stages(family);
        } else {
            per_sampler!(family, f => per_reflectance!(f, known => self.each(known)));
        }
    }

    #[inline(always)]
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>,
    {
        columns::sample(self, lobes);
    }
}

impl<T: Real> Sample<'_, T> {
    #[inline(always)]
    fn each<U: Real, F: Family<U>>(self, family: F) {
        let n = self.samples.pdf.len();
        let family = family.range(0, n);
        let (wo, u) = (self.wo.first(n), range(self.u, 0, n));
        let mut samples = self.samples.first(n);
        for i in 0..n {
            let lobe = family.at(i);
            let sample = lobe.sample(wo.get_as(i), triple(u, i), self.transport);
            samples.set_from(i, sample);
        }
    }

    #[inline(always)]
    fn in_stages<U: Real, F: Family<U>>(mut self, family: F) {
        let n = self.samples.pdf.len();
        let mut start = 0;
        while start < n {
            let end = n.min(start + CHUNK);
            let count = end - start;
            let wo = self.wo.range(start, end).first(count);
            let u = range(self.u, start, end);
            let mut samples = self.samples.range(start, end).first(count);
            let family = family.range(start, end);
            // The first stage leaves its results where the second puts its own.
            per_sampler!(family, f => for i in 0..count {
                let (wi, norm) = f.at(i).sample_first(wo.get_as(i), triple(u, i));
                samples.wi.set_from(i, wi);
                samples.weight.r[i] = convert(norm);
            });
            per_reflectance!(family, f => for i in 0..count {
                let wi = vec3(
                    convert(samples.wi.x[i]),
                    convert(samples.wi.y[i]),
                    convert(samples.wi.z[i]),
                );
                let first = (wi, convert(samples.weight.r[i]));
                samples.set_from(i, f.at(i).sample_second(wo.get_as(i), first));
            });
            start = end;
        }
    }
}

pub(super) struct SampleWi<'a, T> {
    pub(super) wo: Directions<&'a [T]>,
    pub(super) u: [&'a [T]; 3],
    pub(super) transport: Transport,
    pub(super) wi: Directions<&'a mut [T]>,
}

impl<T: Real> Kernel for SampleWi<'_, T> {
    #[inline(always)]
    fn run<U: Real, F: Family<U>>(self, family: F) {
        // No direction depends on the reflectance, and the weight is not asked for.
        let black = Reflectance::Constant(crate::Rgb::BLACK);
        let family = family.with(|lobe| lobe.choose_reflectance(black));
        per_sampler!(family, f => self.each(f));
    }

    #[inline(always)]
    fn run_in_columns<U, L, const N: usize, const P: usize, const Q: usize>(
        mut self,
        lobes: impl LobeAt<L>,
    ) where
        U: Real,
        L: InColumns<U, N, P, Q>,
    {
        for i in 0..self.wi.x.len() {
            let (wo, u) = (self.wo.get_as(i), triple(self.u, i));
            let sample = lobes.at(i).sample(wo, u, self.transport);
            self.wi.set_from(i, sample.map_or(Vec3::ZERO, |s| s.wi));
        }
    }
}

impl<T: Real> SampleWi<'_, T> {
    #[inline(always)]
    fn each<U: Real, F: Family<U>>(self, family: F) {
        let n = self.wi.x.len();
        let family = family.range(0, n);
        let (wo, u) = (self.wo.first(n), range(self.u, 0, n));
        let mut wi = self.wi.first(n);
        for i in 0..n {
            let lobe = family.at(i);
            let sample = lobe.sample(wo.get_as(i), triple(u, i), self.transport);
            wi.set_from(i, sample.map_or(Vec3::ZERO, |s| s.wi));
        }
    }
}

/// The three values at `i`.
#[inline(always)]
pub(super) fn triple<T: Real, U: Real>([a, b, c]: [&[T]; 3], i: usize) -> [U; 3] {
    [convert(a[i]), convert(b[i]), convert(c[i])]
}

#[inline(always)]
pub(super) fn range<T>([a, b, c]: [&[T]; 3], start: usize, end: usize) -> [&[T]; 3] {
    let n = end - start;
    [
        &a[start..end][..n],
        &b[start..end][..n],
        &c[start..end][..n],
    ]
}
