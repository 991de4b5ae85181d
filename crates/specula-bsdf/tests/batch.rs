//! The batch functions are the scalar ones, element by element, at every level.
#![allow(
    clippy::print_stdout,
    reason = "tests say what they skipped and measured"
)]

mod batch_common;

use std::collections::BTreeSet;

use batch_common::Elements;
use batch_common::outcome::{batch, levels, scalar};
use specula_bsdf::batch::{
    Alphas, Any, Colours, Directions, Each, LengthMismatch, Level, Lobes, PerElement,
    PerElementMetal, SampleOutcome, Samples,
};
use specula_bsdf::fresnel::{Reflectance, Schlick};
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Bsdf, Real, Transport, Vec3};

/// Not a multiple of any vector's length, and more than a chunk of two.
const N: usize = 421;

const ALPHAS: [[f32; 2]; 4] = [[0.3, 0.3], [0.1, 0.8], [1e-3, 1e-3], [4.0, 0.5]];

macro_rules! batches_of_lobes {
    ($($(#[$doc:meta])* $name:ident: $lobe:ty, $sides:ident, $batch:ident, $shader:literal;)*) => {
        [$((stringify!($name), stringify!($batch))),*]
    };
}

#[test]
fn every_lobe_with_batches_is_compared() {
    // What `table_lookups_are_exact` compares.
    let mut compared = BTreeSet::from(["Compensated"]);
    macro_rules! each {
        ($name:literal, $lobe:expr) => {{
            let _ = $lobe;
            compared.insert($name);
        }};
    }
    for_every_lobe!(f32, ALPHAS[0], each);
    for (lobe, batch) in specula_bsdf::lobe_table!(batches_of_lobes) {
        assert!(
            !["closed", "delta"].contains(&batch) || compared.contains(lobe),
            "the table of lobes says that {lobe} has `{batch}` batches: compare them in `for_every_lobe` of \
             tests/batch_common/mod.rs"
        );
    }
}

#[test]
fn the_baseline_is_the_scalar_code_bit_for_bit() {
    let elements = Elements::<f32>::new(N, 1);
    let awkward = Elements::<f32>::new(N, 14).with_nan();
    let horizon = Elements::near_the_horizon(2003, 17);
    for alpha in ALPHAS {
        macro_rules! each {
            ($name:literal, $lobe:expr) => {{
                let lobe = $lobe;
                let expected = scalar(&lobe, &elements);
                let got = batch(Level::Baseline, &lobe, &elements);
                assert!(expected == got, "{}, {alpha:?}: {lobe:?}", $name);
                // As text, in which NaN is NaN.
                let expected = format!("{:?}", scalar(&lobe, &awkward));
                let got = format!("{:?}", batch(Level::Baseline, &lobe, &awkward));
                assert!(expected == got, "{}, {alpha:?}, NaN: {lobe:?}", $name);
                let expected = scalar(&lobe, &horizon);
                let got = batch(Level::Baseline, &lobe, &horizon);
                assert!(expected == got, "{}, {alpha:?}, horizon: {lobe:?}", $name);
                for level in levels() {
                    let got = batch(level, &lobe, &horizon);
                    let name = $name;
                    assert!(got.is_sane(), "{name}, {alpha:?}, {level}: {lobe:?}");
                }
            }};
        }
        for_every_lobe!(f32, alpha, each);
    }
    let lobe = batch_common::lambert();
    let got = batch(Level::best(), &Any(lobe), &elements);
    assert_eq!(got, scalar(&lobe, &elements));
}

/// Two lobes stand for all, for the sake of the time that compiling takes.
#[test]
fn so_it_is_in_f64() {
    let elements = Elements::<f64>::new(N, 2);
    for alpha in ALPHAS {
        for sampler in batch_common::SAMPLERS {
            let lobe = batch_common::metal(alpha, batch_common::gold()).with_sampler(sampler);
            let got = batch(Level::Baseline, &lobe, &elements);
            assert!(got == scalar(&lobe, &elements), "{lobe:?}");
        }
        let lobe = batch_common::glass(alpha, 1.5);
        let got = batch(Level::Baseline, &lobe, &elements);
        assert!(got == scalar(&lobe, &elements), "{lobe:?}");
    }
}

/// Lobes that look up tables are plain loops, or look up rows of them: exact at every level.
fn table_lookups_are_exact<T: Real>(seed: u64) {
    let elements = Elements::<T>::new(N, seed);
    for alpha in ALPHAS {
        let lobes = batch_common::MODELS.map(|model| batch_common::compensated::<T>(alpha, model));
        let glass = batch_common::compensated_glass::<T>(alpha);
        let coat = batch_common::lossy_coat::<T>(Some(alpha));
        let (plastic, smooth_plastic) = (
            batch_common::plastic::<T>(alpha),
            batch_common::smooth_plastic::<T>(),
        );
        let expected = lobes.map(|lobe| scalar(&lobe, &elements));
        let expected_glass = scalar(&glass, &elements);
        let expected_coat = scalar(&coat, &elements);
        let expected_plastic = [plastic, smooth_plastic].map(|lobe| scalar(&lobe, &elements));
        let gltfs = batch_common::gltfs::<T>(alpha);
        let expected_gltfs = gltfs.map(|lobe| scalar(&lobe, &elements));
        let principleds = batch_common::principleds::<T>(alpha);
        let expected_principleds = principleds.map(|lobe| scalar(&lobe, &elements));
        for level in levels() {
            for (lobe, expected) in lobes.iter().zip(&expected) {
                assert!(
                    batch(level, lobe, &elements) == *expected,
                    "{level}: {lobe:?}"
                );
            }
            assert!(
                batch(level, &glass, &elements) == expected_glass,
                "{level}: {glass:?}"
            );
            assert!(
                batch(level, &coat, &elements) == expected_coat,
                "{level}: {coat:?}"
            );
            for (lobe, expected) in gltfs.iter().zip(&expected_gltfs) {
                assert!(
                    batch(level, lobe, &elements) == *expected,
                    "{level}: {lobe:?}"
                );
            }
            for (lobe, expected) in principleds.iter().zip(&expected_principleds) {
                assert!(
                    batch(level, lobe, &elements) == *expected,
                    "{level}: {lobe:?}"
                );
            }
            for (lobe, expected) in [plastic, smooth_plastic].iter().zip(&expected_plastic) {
                assert!(
                    batch(level, lobe, &elements) == *expected,
                    "{level}: {lobe:?}"
                );
            }
        }
    }
}

#[test]
fn lobes_with_tables_are_the_scalar_code_at_every_level() {
    table_lookups_are_exact::<f32>(9);
}

#[test]
fn so_they_are_in_f64() {
    table_lookups_are_exact::<f64>(10);
}

#[test]
fn vector_levels_agree_with_each_other_bit_for_bit() {
    let levels = levels();
    let [.., a, b] = &levels[..] else { return };
    if *a == Level::Baseline {
        return;
    }
    let elements = Elements::<f32>::new(N, 3);
    for alpha in ALPHAS {
        macro_rules! each {
            ($name:literal, $lobe:expr) => {{
                let lobe = $lobe;
                let (a, b) = (batch(*a, &lobe, &elements), batch(*b, &lobe, &elements));
                assert!(a == b, "{}, {alpha:?}: {lobe:?}", $name);
            }};
        }
        for_every_lobe!(f32, alpha, each);
    }
}

#[test]
fn an_element_does_not_depend_on_its_place_or_its_neighbours() {
    let whole = Elements::<f32>::new(300, 4);
    let lobe = batch_common::metal::<f32>([0.1, 0.8], batch_common::gold());
    let glass = batch_common::glass::<f32>([0.1, 0.8], 1.5);
    for level in levels() {
        let expected = (batch(level, &lobe, &whole), batch(level, &glass, &whole));
        for (start, n) in [
            (0, 0),
            (3, 1),
            (5, 7),
            (17, 16),
            (31, 33),
            (1, 129),
            (40, 257),
        ] {
            let cut = |v: &[f32]| v[start..start + n].to_vec();
            let vectors = |d: &Directions<Vec<f32>>| Directions {
                x: cut(&d.x),
                y: cut(&d.y),
                z: cut(&d.z),
            };
            let part = Elements {
                wo: vectors(&whole.wo),
                wi: vectors(&whole.wi),
                u: whole.u.each_ref().map(|u| cut(u)),
            };
            let metal = batch(level, &lobe, &part);
            assert_eq!(metal.f_cos.g, cut(&expected.0.f_cos.g), "{level} {n}");
            assert_eq!(metal.samples.pdf, cut(&expected.0.samples.pdf));
            assert_eq!(metal.samples.wi, vectors(&expected.0.samples.wi));
            let glass = batch(level, &glass, &part);
            assert_eq!(glass.pdf, cut(&expected.1.pdf), "{level} {n}");
            assert_eq!(glass.samples.weight.b, cut(&expected.1.samples.weight.b));
        }
    }
}

#[test]
fn per_element_alphas_are_one_lobe_each() {
    let elements = Elements::<f32>::new(N, 5);
    #[allow(clippy::cast_precision_loss, reason = "a small index")]
    let alphas = |scale: f32| (0..N).map(move |i| scale * (1.0 + i as f32));
    let alpha_x: Vec<f32> = alphas(1e-3).collect();
    let alpha_y: Vec<f32> = alphas(2e-3).collect();
    for sampler in batch_common::SAMPLERS {
        let metal =
            batch_common::metal::<f32>([0.5, 0.5], batch_common::gold()).with_sampler(sampler);
        let glass = batch_common::glass::<f32>([0.5, 0.5], 1.5).with_sampler(sampler);
        let textured = PerElement {
            lobe: metal,
            alpha_x: &alpha_x[..],
            alpha_y: &alpha_y[..],
        };
        let textured_glass = PerElement {
            lobe: glass,
            alpha_x: &alpha_x[..],
            alpha_y: &alpha_y[..],
        };
        for level in levels() {
            let many = batch(level, &textured, &elements);
            let panes = batch(level, &textured_glass, &elements);
            for i in (0..N).step_by(17) {
                let alpha = [alpha_x[i], alpha_y[i]];
                let one = batch_common::metal::<f32>(alpha, batch_common::gold());
                let one = batch(level, &one.with_sampler(sampler), &elements);
                assert_eq!(many.both.0.r[i], one.both.0.r[i], "{level} {sampler} {i}");
                assert_eq!(many.pdf[i], one.pdf[i], "{level} {sampler} {i}");
                assert_eq!(many.samples.wi.x[i], one.samples.wi.x[i]);
                assert_eq!(many.samples.weight.g[i], one.samples.weight.g[i]);
                let one = batch_common::glass::<f32>(alpha, 1.5).with_sampler(sampler);
                let one = batch(level, &one, &elements);
                assert_eq!(panes.samples.wi.z[i], one.samples.wi.z[i]);
                assert_eq!(panes.f_cos.r[i], one.f_cos.r[i]);
            }
        }
    }
}

/// Any of the lobes between each other, and those alone of which `common` says so, or does not.
fn own_lobes<L>(kinds: &[L], is_common: impl Fn(&L) -> bool)
where
    L: Bsdf<f32> + Copy + core::fmt::Debug,
    for<'a> Each<'a, L>: Lobes<f32>,
{
    let elements = Elements::<f32>::new(N, 19);
    let (common, rare): (Vec<L>, Vec<L>) = kinds.iter().partition(|lobe| is_common(lobe));
    for (name, of) in [("any", kinds), ("common", &common[..]), ("rare", &rare[..])] {
        let lobes: Vec<_> = (0..N).map(|i| of[i * 11 % of.len()]).collect();
        for level in levels() {
            let got = batch(level, &Each(&lobes), &elements);
            for (i, lobe) in lobes.iter().enumerate() {
                let one = scalar(lobe, &elements.only(i));
                assert_eq!(got.at(i), one, "{name}, {level}, {i}: {lobe:?}");
            }
        }
        let mut pdf = vec![0.0; N];
        let (wo, wi) = (elements.wo.as_slices(), elements.wi.as_slices());
        let short = Each(&lobes[1..]);
        let error = Level::best()
            .pdf(&short, wo, wi, &mut pdf)
            .expect_err("one lobe too few");
        assert_eq!((error.name, error.found), ("lobes", N - 1));
    }
}

#[test]
fn own_lobes_are_one_lobe_each() {
    let gltfs: Vec<_> = (ALPHAS.into_iter().flat_map(batch_common::gltfs::<f32>)).collect();
    own_lobes(&gltfs, |lobe| !lobe.transmits());
    let all = ALPHAS
        .into_iter()
        .flat_map(batch_common::principleds::<f32>);
    own_lobes(&all.collect::<Vec<_>>(), |lobe| !lobe.transmits());
}

#[test]
fn per_element_colours_are_one_lobe_each() {
    let elements = Elements::<f32>::new(N, 12);
    let ramp = |low: f32, step: f32| -> Vec<f32> {
        #[allow(clippy::cast_precision_loss, reason = "a small index")]
        (0..N).map(|i| low + step * i as f32).collect()
    };
    let (alpha_x, alpha_y) = (ramp(1e-3, 1e-3), ramp(2e-3, 2e-3));
    // Beyond 1 at the end, which is clamped; and one that is no number.
    let mut f0 = Colours {
        r: ramp(0.0, 0.003),
        g: ramp(0.5, 1e-3),
        b: ramp(0.9, -2e-3),
    };
    f0.g[7] = f32::NAN;
    let metal = batch_common::metal::<f32>([0.5, 0.5], batch_common::gold());
    for sampler in [Sampler::Bounded, Sampler::Exact] {
        let textured = PerElementMetal {
            lobe: metal.with_sampler(sampler),
            alpha_x: &alpha_x,
            alpha_y: &alpha_y,
            f0: f0.as_slices(),
        };
        for level in levels() {
            let many = batch(level, &textured, &elements);
            for i in (0..N).step_by(7) {
                let colour = f0
                    .as_slices()
                    .get(i)
                    .expect("an element")
                    .map(|x| x.within(0.0, 1.0));
                let reflectance = Reflectance::Schlick(Schlick { f0: colour });
                let one = batch_common::metal([alpha_x[i], alpha_y[i]], reflectance);
                let one = batch(level, &one.with_sampler(sampler), &elements);
                assert_eq!(many.f_cos.r[i], one.f_cos.r[i], "{level} {sampler} {i}");
                assert_eq!(many.both.0.g[i], one.both.0.g[i]);
                assert_eq!(many.pdf[i], one.pdf[i]);
                assert_eq!(many.samples.weight.b[i], one.samples.weight.b[i]);
                assert_eq!(many.wi.x[i], one.wi.x[i]);
            }
        }
    }
    let short = PerElementMetal {
        lobe: metal,
        alpha_x: &alpha_x,
        alpha_y: &alpha_y,
        f0: Colours {
            b: &f0.b[1..],
            ..f0.as_slices()
        },
    };
    let mut pdf = vec![0.0; N];
    let (wo, wi) = (elements.wo.as_slices(), elements.wi.as_slices());
    let error = Level::best().pdf(&short, wo, wi, &mut pdf).unwrap_err();
    assert_eq!((error.name, error.found), ("f0.b", N - 1));
}

#[test]
fn bare_samplers_are_the_scalar_ones() {
    let mixed = Elements::<f32>::new(N, 6);
    let above = Elements::<f32>::above(N, 15);
    let nan = Elements::<f32>::above(N, 16).with_nan();
    for elements in [mixed, above, nan] {
        for alpha in [[0.2, 0.7], [0.4, 0.4]] {
            bare_samplers(&elements, alpha);
        }
    }
}

fn bare_samplers(elements: &Elements<f32>, [x, y]: [f32; 2]) {
    let alpha = Alpha::clamped(x, y);
    let (alpha_x, alpha_y) = (vec![x; N], vec![y; N]);
    // Equal alphas among unequal ones.
    let mut partly = alpha_y.clone();
    partly[N / 2] = x;
    let textured = |alpha_y| Alphas::PerElement {
        alpha_x: &alpha_x,
        alpha_y,
    };
    let (wo, wi) = (elements.wo.as_slices(), elements.wi.as_slices());
    let u = [&elements.u[1][..], &elements.u[2]];
    for sampler in batch_common::SAMPLERS {
        for alphas in [Alphas::from(alpha), textured(&alpha_y), textured(&partly)] {
            let mut sampled = Directions::zeroed(N);
            let mut pdf = vec![0.0; N];
            Level::Baseline
                .sample_reflection(sampler, alphas, wo, u, sampled.as_mut_slices())
                .expect("equal lengths");
            Level::Baseline
                .reflection_pdf(sampler, alphas, wo, wi, &mut pdf)
                .expect("equal lengths");
            for i in 0..N {
                let alpha = match alphas {
                    Alphas::Same(alpha) => alpha,
                    Alphas::PerElement { alpha_x, alpha_y } => {
                        Alpha::clamped(alpha_x[i], alpha_y[i])
                    }
                };
                let u = [u[0][i], u[1][i]];
                let (wo, wi) = (
                    wo.get(i).expect("an element"),
                    wi.get(i).expect("an element"),
                );
                let (expected, density) = match sampler {
                    Sampler::Heitz => (
                        vndf::heitz::sample_reflection(alpha, wo, u),
                        vndf::heitz::reflection_pdf(alpha, wo, wi),
                    ),
                    Sampler::Cap => (
                        vndf::cap::sample_reflection(alpha, wo, u),
                        vndf::cap::reflection_pdf(alpha, wo, wi),
                    ),
                    Sampler::Exact => (
                        vndf::exact::sample_reflection(alpha, wo, u),
                        vndf::exact::reflection_pdf(alpha, wo, wi),
                    ),
                    Sampler::Bounded => (
                        vndf::bounded::sample_reflection(alpha, wo, u),
                        vndf::bounded::reflection_pdf(alpha, wo, wi),
                    ),
                };
                let expected = expected.unwrap_or(Vec3::ZERO);
                let found = sampled.as_slices().get(i).expect("an element");
                assert_eq!(found, expected, "{sampler} {i} {wo:?}");
                assert_eq!(
                    format!("{:?}", pdf[i]),
                    format!("{density:?}"),
                    "{sampler} {i}"
                );
            }
        }
    }
}

#[test]
fn rejected_samples_are_zero_throughout() {
    let mut elements = Elements::<f32>::above(2000, 7);
    // Grazing views of a rough metal reflect downwards often.
    elements.wo.x.fill(0.995);
    elements.wo.y.fill(0.0);
    elements.wo.z.fill(0.0998);
    let lobe = batch_common::metal::<f32>([0.9, 0.9], batch_common::gold());
    for level in levels() {
        let s = batch(level, &lobe.with_sampler(Sampler::Cap), &elements).samples;
        let mut rejected = 0;
        for i in 0..2000 {
            let values = [
                s.wi.x[i],
                s.wi.y[i],
                s.wi.z[i],
                s.weight.r[i],
                s.weight.g[i],
                s.weight.b[i],
                s.pdf[i],
            ];
            if s.outcome[i] == SampleOutcome::Rejected {
                rejected += 1;
                assert_eq!(values, [0.0; 7]);
            } else {
                assert!(s.wi.z[i] > 0.0 && s.pdf[i] > 0.0 && s.weight.r[i] > 0.0);
            }
        }
        assert!((100..1500).contains(&rejected), "{level}: {rejected}");
    }
}

#[test]
fn slices_that_differ_in_length_are_named() {
    let e = Elements::<f32>::new(8, 8);
    let lobe = batch_common::lambert::<f32>();
    let (wo, wi) = (e.wo.as_slices(), e.wi.as_slices());
    let short = Directions {
        y: &wi.y[..7],
        ..wi
    };
    let mut pdf = vec![0.5; 8];
    let error = Level::best().pdf(&lobe, wo, short, &mut pdf).unwrap_err();
    let LengthMismatch {
        name,
        found,
        expected,
        ..
    } = error;
    assert_eq!((name, found, expected), ("wi.y", 7, 8));
    assert_eq!(
        error.to_string(),
        "`wi.y` holds 7 elements, but the first slice written holds 8"
    );
    assert_eq!(pdf, [0.5; 8], "nothing is written");

    let textured = PerElement {
        lobe: batch_common::metal::<f32>([0.5; 2], batch_common::gold()),
        alpha_x: &pdf[..],
        alpha_y: &pdf[..3],
    };
    let mut out = vec![0.0; 8];
    let error = Level::best().pdf(&textured, wo, wi, &mut out).unwrap_err();
    assert_eq!((error.name, error.found), ("alpha_y", 3));

    let mut samples = Samples::<Vec<f32>, Vec<SampleOutcome>>::rejected(8);
    samples.outcome.pop();
    let u = e.u();
    let error = Level::best()
        .sample(&lobe, wo, u, Transport::Radiance, samples.as_mut_slices())
        .unwrap_err();
    assert_eq!((error.name, error.found, error.expected), ("outcome", 7, 8));
}
