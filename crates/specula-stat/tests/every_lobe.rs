//! Every lobe of the library's table, with every proof. A lobe without an example here fails.
//!
//! * A lobe with a density: chi-square, normalisation, consistency, furnace, reciprocity, and the `f32` twin.
//! * A lobe whose values are estimates: samples against values, normalisation of the density, reciprocity, energy and
//!   the `f32` twin, all by means.
//! * A lobe of Dirac deltas: shares of its samples against their probabilities, reciprocity, energy, the `f32` twin.
//!
//! The other suites go through the parameters of each lobe.

mod common;
mod lobes;
mod walks;

use std::collections::BTreeSet;

use common::{ABOVE, BELOW, few_views, plan, prove_all, twins_from, views};
use lobes::{ALPHAS, ETA, Example, ROWS, examples, gold, row};
use specula_bsdf::bsdf::{Lobe, MultibounceConductor, SmoothDielectric};
use specula_bsdf::math::{Real, Stream};
use specula_bsdf::multibounce::MultibounceModel;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, BsdfSample, Rgb, Transport, Vec3};
use specula_stat::reciprocity::Domain;
use specula_stat::z_test::two_sided_p;
use specula_stat::{Check, Plan, Report, Rng, Subject, prove};

#[test]
fn no_lobe_is_without_an_example() {
    let proven: BTreeSet<&str> = examples::<f64>(ALPHAS)
        .iter()
        .map(|e| row(&e.lobe))
        .collect();
    let missing: Vec<_> = ROWS.iter().filter(|row| !proven.contains(*row)).collect();
    assert!(
        missing.is_empty(),
        "lobes without proof: {missing:?}. Add an example of each to `examples` in \
         crates/specula-stat/tests/lobes/mod.rs"
    );
}

/// The examples in both precisions, with their names.
fn cases(is_wanted: impl Fn(&Lobe<f64>) -> bool) -> Vec<(String, Example<f32>, Example<f64>)> {
    let pairs = examples::<f32>(ALPHAS)
        .into_iter()
        .zip(examples::<f64>(ALPHAS));
    let named = pairs
        .enumerate()
        .map(|(i, (single, double))| (format!("{} ({i})", row(&double.lobe)), single, double));
    named.filter(|(_, _, e)| is_wanted(&e.lobe)).collect()
}

fn is_specular(lobe: &Lobe<f64>) -> bool {
    Bsdf::<f64>::is_specular(lobe)
}

fn is_stochastic(lobe: &Lobe<f64>) -> bool {
    Bsdf::<f64>::is_stochastic(lobe)
}

/// Cosines of the views of an example.
fn cosines<T>(example: &Example<T>) -> Vec<f64> {
    let below = BELOW.into_iter().filter(|cosine| *cosine >= example.lowest);
    ABOVE.into_iter().chain(below).collect()
}

#[test]
fn lobes_with_a_density_are_proven() {
    let cases = cases(|lobe| !is_specular(lobe) && !is_stochastic(lobe));
    prove_all("every lobe", &cases, |(name, single, double)| {
        let subject = Subject::from_bsdf(&double.lobe, Transport::Radiance);
        let plan = Plan {
            eta: double.eta,
            reciprocity: double.reciprocity,
            relative_tolerance: 1e-8,
            samples: 30_000,
            cells: 200,
            ..plan((0.2, 0.2))
        };
        let views = if double.reciprocity == Domain::Everywhere {
            // Integrals of interfaces are dear; their own suites have the other views.
            few_views(&[0.7, -0.4])
        } else {
            few_views(&cosines(double))
        };
        let mut report = prove(name, &subject, &views, &plan);
        let radiance = Transport::Radiance;
        let lowest = double.lowest;
        report.absorb(twins_from(
            name,
            &single.lobe,
            &double.lobe,
            radiance,
            lowest,
        ));
        report
    });
}

#[test]
fn lobes_whose_values_are_estimates_are_proven() {
    let cases = cases(is_stochastic);
    prove_all("every walk", &cases, |(name, single, double)| {
        walks::prove_means(name, &single.lobe, &double.lobe, double.eta)
    });
}

#[test]
fn lobes_of_deltas_are_proven() {
    let cases = cases(is_specular);
    prove_all("every delta", &cases, |(name, single, double)| {
        deltas(name, &single.lobe, &double.lobe, &views(&cosines(double)))
    });
}

/// Samples of a view.
const SAMPLES: u32 = 20_000;

/// Proofs of a lobe that is nothing but Dirac deltas.
fn deltas(
    name: &str,
    single: &impl Bsdf<f32>,
    double: &impl Bsdf<f64>,
    views: &[Vec3<f64>],
) -> Report {
    let mut report = Report::new(name);
    let mut rng = Rng::from_name(name);
    let importance = Transport::Importance;
    for &wo in views {
        // Directions with their weights, probabilities and how often they are sampled.
        let mut directions: Vec<(Vec3<f64>, Rgb<f64>, f64, u32)> = Vec::new();
        let mut faults = Vec::new();
        for _ in 0..SAMPLES {
            let u = rng.triple();
            let sample = double.sample(wo, u, importance);
            #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
            let twin = single.sample(wo.cast(), u.map(|u| u as f32), importance);
            let Some(s) = sample else { continue };
            if let Some(twin) = twin.filter(|twin| twin.event == s.event) {
                let apart = (twin.wi.cast() - s.wi).length()
                    + (twin.weight.cast() - s.weight).map(f64::abs).max_channel();
                if apart > 1e-4 {
                    faults.push(format!("f32 {twin:?} is not f64 {s:?}"));
                }
            }
            let value = double.eval(wo, s.wi, importance);
            if !s.specular || !value.is_black() || double.pdf(wo, s.wi) != 0.0 {
                faults.push(format!("{s:?} is not of a Dirac delta alone"));
            }
            match directions.iter_mut().find(|d| d.0 == s.wi) {
                Some(same) => same.3 += 1,
                None => directions.push((s.wi, s.weight, s.pdf, 1)),
            }
        }
        let mut energy = 0.0;
        for (wi, weight, probability, count) in directions {
            let reflected = weight * probability;
            energy += reflected.max_channel();
            let share = f64::from(count) / f64::from(SAMPLES);
            let variance = probability * (1.0 - probability) / f64::from(SAMPLES);
            let off = (share - probability) / variance.max(1e-18).sqrt();
            if two_sided_p(off) < 1e-6 {
                faults.push(format!(
                    "{wi:?} is sampled with {share}, not with {probability}"
                ));
            }
            // From the other end.
            let back = (0..1000).find_map(|_| {
                let s = double.sample(wi, rng.triple(), importance)?;
                ((s.wi - wo).length() < 1e-9).then_some(s.weight * s.pdf)
            });
            let apart = back.map(|back| (back - reflected).map(f64::abs).max_channel());
            if apart.is_none_or(|apart| apart > 1e-9) {
                faults.push(format!("{reflected:?} to {wi:?}, but {back:?} back"));
            }
        }
        if energy > 1.0 + 1e-9 {
            faults.push(format!("{energy} of the light leaves"));
        }
        report.checks.push(Check {
            name: format!("deltas, wo {wo:?}"),
            is_pass: faults.is_empty(),
            p_value: None,
            detail: faults.first().cloned().unwrap_or_default(),
        });
    }
    report
}

/// A metal with all its bounces, spoiled.
#[derive(Clone, Copy)]
struct Spoiled<T> {
    metal: MultibounceConductor<T>,
    weight: f64,
    pdf: f64,
    /// Factor of values for light farther than 45 degrees from the normal: not reciprocal.
    steep: f64,
}

impl<T: Real> Spoiled<T> {
    fn of([weight, pdf, steep]: [f64; 3]) -> Self {
        let ggx = Ggx::new(Alpha::clamped(T::of(ALPHAS.0), T::of(ALPHAS.1)));
        Self {
            metal: MultibounceConductor::new(ggx, gold(), MultibounceModel::default()),
            weight,
            pdf,
            steep,
        }
    }
}

impl<T: Real> Bsdf<T> for Spoiled<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.metal.eval(wo, wi, transport)
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.metal.pdf(wo, wi) * T::of(self.pdf)
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        self.metal.sample(wo, u, transport)
    }

    fn eval_pdf_random(
        &self,
        wo: Vec3<T>,
        wi: Vec3<T>,
        transport: Transport,
        stream: &mut Stream,
    ) -> (Rgb<T>, T) {
        let (f_cos, pdf) = self.metal.eval_pdf_random(wo, wi, transport, stream);
        let factor = if wi.z < T::of(0.7) { self.steep } else { 1.0 };
        (f_cos * T::of(factor), pdf * T::of(self.pdf))
    }

    fn sample_random(
        &self,
        wo: Vec3<T>,
        u: [T; 3],
        transport: Transport,
        stream: &mut Stream,
    ) -> Option<BsdfSample<T>> {
        let sample = self.metal.sample_random(wo, u, transport, stream)?;
        Some(BsdfSample {
            weight: sample.weight * T::of(self.weight),
            ..sample
        })
    }

    fn albedo(&self) -> Rgb<T> {
        self.metal.albedo()
    }
}

/// Each proof by means turns red where its fault is planted, and none without.
#[test]
fn faults_of_walks_are_caught() {
    let report = |single: [f64; 3], double: [f64; 3]| {
        let single = Spoiled::<f32>::of(single);
        walks::prove_means("spoiled", &single, &Spoiled::<f64>::of(double), 1.0)
    };
    let right = [1.0; 3];
    let unspoiled = report(right, right);
    assert!(unspoiled.is_pass(), "{unspoiled}");
    let (heavy, dense, steep) = ([1.2, 1.0, 1.0], [1.0, 1.01, 1.0], [1.0, 1.0, 1.2]);
    for (names, single, double) in [
        (&["samples follow values", "energy"][..], heavy, heavy),
        (&["integral of pdf"], dense, dense),
        (&["reciprocity"], steep, steep),
        (&["f32 samples"], heavy, right),
        (&["f32 values"], dense, right),
        (&["f32 values"], steep, right),
    ] {
        let report = report(single, double);
        for name in names {
            assert!(
                report.failures().any(|c| c.name.starts_with(name)),
                "'{name}' did not catch it: {report}"
            );
        }
    }
}

/// Glass whose probabilities and weights are spoiled.
struct SpoiledGlass<T> {
    glass: SmoothDielectric<T>,
    weight: f64,
    pdf: f64,
}

impl<T: Real> SpoiledGlass<T> {
    fn of([weight, pdf]: [f64; 2]) -> Self {
        let glass = SmoothDielectric::new(T::of(ETA));
        Self { glass, weight, pdf }
    }
}

impl<T: Real> Bsdf<T> for SpoiledGlass<T> {
    fn eval(&self, wo: Vec3<T>, wi: Vec3<T>, transport: Transport) -> Rgb<T> {
        self.glass.eval(wo, wi, transport)
    }

    fn pdf(&self, wo: Vec3<T>, wi: Vec3<T>) -> T {
        self.glass.pdf(wo, wi)
    }

    fn sample(&self, wo: Vec3<T>, u: [T; 3], transport: Transport) -> Option<BsdfSample<T>> {
        let sample = self.glass.sample(wo, u, transport)?;
        Some(BsdfSample {
            weight: sample.weight * T::of(self.weight),
            pdf: sample.pdf * T::of(self.pdf),
            ..sample
        })
    }

    fn albedo(&self) -> Rgb<T> {
        self.glass.albedo()
    }
}

#[test]
fn faults_of_deltas_are_caught() {
    let report = |single: [f64; 2], double: [f64; 2]| {
        let single = SpoiledGlass::<f32>::of(single);
        deltas(
            "glass",
            &single,
            &SpoiledGlass::<f64>::of(double),
            &views(&[0.3]),
        )
    };
    let right = report([1.0; 2], [1.0; 2]);
    assert!(right.is_pass(), "{right}");
    for (fault, report) in [
        ("is sampled with", report([0.9, 1.1], [0.9, 1.1])),
        ("of the light leaves", report([1.01, 1.0], [1.01, 1.0])),
        ("is not f64", report([1.01, 1.0], [1.0; 2])),
    ] {
        assert!(
            report.failures().any(|c| c.detail.contains(fault)),
            "'{fault}' is not said: {report}"
        );
    }
}
