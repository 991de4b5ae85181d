//! Walks in batches against the scalar functions, element by element and on average.
#![allow(clippy::print_stdout, reason = "tests say what they skipped")]

mod batch_common;

use batch_common::{Elements, colour, ggx, gold, reflectances};
use specula_bsdf::batch::{Colours, Directions, Level, SampleOutcome, Samples};
use specula_bsdf::bsdf::MultibounceConductor;
use specula_bsdf::fresnel::Reflectance;
use specula_bsdf::math::Stream;
use specula_bsdf::multibounce::{MisPdf, MultibounceModel};
use specula_bsdf::{Bsdf, Real, Transport, Vec3};

/// More than two chunks, and not a multiple of a vector.
const N: usize = 601;
const ALPHAS: [[f32; 2]; 6] = [
    [1e-3, 1e-3],
    [0.1, 0.1],
    [0.5, 0.5],
    [1.0, 1.0],
    [0.1, 0.8],
    [6.0, 3.0],
];

/// The levels that this machine has; says which it lacks.
fn levels() -> Vec<Level> {
    let (here, lacking): (Vec<_>, Vec<_>) = Level::ALL.into_iter().partition(|l| l.is_available());
    for level in lacking {
        specula_testing::not_of_this_machine("batches", format_args!("no {level}"));
    }
    here
}

fn streams(n: usize) -> Vec<Stream> {
    (0..n).map(|i| Stream::new(977 * i as u64)).collect()
}

fn metal<T: Real>(alpha: [f32; 2], reflectance: Reflectance<T>) -> MultibounceConductor<T> {
    MultibounceConductor::new(
        ggx(alpha),
        reflectance,
        MultibounceModel::StratifiedBidirectional,
    )
}

/// What both sides return of an element, and the stream's next number.
type Row = [f64; 8];

fn eval<T: Real>(level: Level, metal: &MultibounceConductor<T>, of: &Elements<T>) -> Vec<Row> {
    let n = of.wo.x.len();
    let (mut f_cos, mut pdf) = (Colours::zeroed(n), vec![T::ZERO; n]);
    let mut streams = streams(n);
    let (wo, wi) = (of.wo.as_slices(), of.wi.as_slices());
    level
        .eval_pdf_random(metal, wo, wi, &mut streams, f_cos.as_mut_slices(), &mut pdf)
        .expect("equal lengths");
    let rows = streams.iter_mut().enumerate().map(|(i, stream)| {
        let f = f_cos.as_slices().get(i).expect("as many as elements");
        row([f.r, f.g, f.b, pdf[i], T::ZERO, T::ZERO, T::ZERO], stream)
    });
    rows.collect()
}

fn eval_scalar<T: Real>(metal: &MultibounceConductor<T>, of: &Elements<T>) -> Vec<Row> {
    let mut streams = streams(of.wo.x.len());
    let rows = streams.iter_mut().enumerate().map(|(i, stream)| {
        let (wo, wi) = (
            of.wo.as_slices().get(i).expect("an element"),
            of.wi.as_slices().get(i).expect("an element"),
        );
        let (f, pdf) = metal.eval_pdf_random(wo, wi, Transport::Radiance, stream);
        row([f.r, f.g, f.b, pdf, T::ZERO, T::ZERO, T::ZERO], stream)
    });
    rows.collect()
}

fn sample<T: Real>(level: Level, metal: &MultibounceConductor<T>, of: &Elements<T>) -> Vec<Row> {
    let n = of.wo.x.len();
    let mut samples = Samples::rejected(n);
    let mut streams = streams(n);
    level
        .sample_random(
            metal,
            of.wo.as_slices(),
            of.u(),
            &mut streams,
            samples.as_mut_slices(),
        )
        .expect("equal lengths");
    let samples = samples.as_slices();
    let rows = streams.iter_mut().enumerate().map(|(i, stream)| {
        let (wi, f) = (samples.wi.get(i), samples.weight.get(i));
        let (wi, f) = (wi.expect("an element"), f.expect("an element"));
        let is_reflection = samples.outcome[i] == SampleOutcome::Reflection;
        assert_eq!(is_reflection, samples.pdf[i] > T::ZERO);
        row([f.r, f.g, f.b, samples.pdf[i], wi.x, wi.y, wi.z], stream)
    });
    rows.collect()
}

fn sample_scalar<T: Real>(metal: &MultibounceConductor<T>, of: &Elements<T>) -> Vec<Row> {
    let mut streams = streams(of.wo.x.len());
    let rows = streams.iter_mut().enumerate().map(|(i, stream)| {
        let u = of.u().map(|u| u[i]);
        let wo = of.wo.as_slices().get(i).expect("an element");
        let sample = metal.sample_random(wo, u, Transport::Radiance, stream);
        let values = sample.map_or([T::ZERO; 7], |s| {
            let (f, wi) = (s.weight, s.wi);
            [f.r, f.g, f.b, s.pdf, wi.x, wi.y, wi.z]
        });
        row(values, stream)
    });
    rows.collect()
}

fn row<T: Real>(values: [T; 7], stream: &mut Stream) -> Row {
    let mut row = [0.0; 8];
    for (to, from) in row.iter_mut().zip(values) {
        *to = from.to_f64();
    }
    row[7] = stream.next();
    row
}

/// At [`Level::Baseline`] every bit; at the vector levels, which round otherwise, all but a few walks
/// whose choices turn: of `N`, at most `turned`.
fn compare(what: &str, level: Level, scalar: &[Row], batch: &[Row], tolerance: f64, turned: usize) {
    let mut differ = 0;
    for (i, (expected, found)) in scalar.iter().zip(batch).enumerate() {
        assert!(found.iter().all(|x| x.is_finite()), "{what}, {level}: {i}");
        if level == Level::Baseline {
            assert_eq!(found, expected, "{what}, {level}: {i}");
            continue;
        }
        let is_close = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance * a.abs().max(1e-3);
        differ += usize::from(!expected.iter().zip(found).all(is_close));
    }
    assert!(differ <= turned, "{what}, {level}: {differ} differ");
}

fn agree<T: Real>(tolerance: f64, turned: usize) {
    for alpha in ALPHAS {
        let elements = Elements::<T>::new(N, 5);
        for reflectance in reflectances() {
            let metal = metal(alpha, reflectance);
            let (evals, samples) = (
                eval_scalar(&metal, &elements),
                sample_scalar(&metal, &elements),
            );
            assert!(evals.iter().any(|row| row[0] > 0.0));
            for level in levels() {
                let what = format!("{alpha:?} {reflectance:?}");
                let batch = eval(level, &metal, &elements);
                compare(&what, level, &evals, &batch, tolerance, turned);
                let batch = sample(level, &metal, &elements);
                compare(&what, level, &samples, &batch, tolerance, turned);
            }
        }
    }
}

#[test]
fn elements_are_those_of_the_scalar_functions_f32() {
    agree::<f32>(2e-3, N / 20);
}

#[test]
fn elements_are_those_of_the_scalar_functions_f64() {
    agree::<f64>(1e-9, 0);
}

#[test]
fn the_vector_levels_agree_bit_for_bit_and_elements_are_their_own() {
    let metal = metal([0.8, 1.0], gold::<f32>());
    let all = Elements::<f32>::new(N, 6);
    let vector: Vec<Level> = levels()
        .into_iter()
        .filter(|l| *l != Level::Baseline)
        .collect();
    let whole: Vec<_> = vector
        .iter()
        .map(|l| (eval(*l, &metal, &all), sample(*l, &metal, &all)))
        .collect();
    if let [avx2, avx512] = &whole[..] {
        assert_eq!(avx2, avx512);
    }
    // The first elements alone: few walks at a time, down to one, take another way.
    for n in [0, 1, 2, 5, 6, 7, 15, 16, 17, 255, 256, 257] {
        let first = Elements {
            wo: (0..n).map(|i| all.wo.as_slices().get(i).unwrap()).collect(),
            wi: (0..n).map(|i| all.wi.as_slices().get(i).unwrap()).collect(),
            u: core::array::from_fn(|k| all.u[k][..n].to_vec()),
        };
        for (level, (evals, samples)) in vector.iter().zip(&whole) {
            assert_eq!(eval(*level, &metal, &first), evals[..n], "{level} {n}");
            assert_eq!(sample(*level, &metal, &first), samples[..n], "{level} {n}");
        }
    }
}

/// Rough metal that reflects everything, at grazing angles: the longest walks.
#[test]
fn means_are_those_of_heitz() {
    const REPEATS: usize = 60_000;
    let white = Reflectance::Constant(colour(1.0, 1.0, 1.0));
    for (alpha, cos_o, cos_i) in [([1.0, 1.0], 0.1, 0.8), ([0.5, 0.9], 0.7, 0.3)] {
        let at = |z: f32, x: f32| Vec3 {
            x: x * (1.0 - z * z).sqrt(),
            y: 0.0,
            z,
        };
        let (wo, wi) = (at(cos_o, 1.0), at(cos_i, -1.0));
        let heitz = MultibounceConductor::new(ggx(alpha), white, MultibounceModel::Heitz2016);
        let mut stream = Stream::new(3);
        let estimates = (0..REPEATS).map(|_| f64::from(heitz.estimate(wo, wi, &mut stream).g));
        let (expected, sigma) = moments(estimates);
        let n = 6000;
        let elements = Elements {
            wo: (0..n).map(|_| wo).collect(),
            wi: (0..n).map(|_| wi).collect(),
            u: core::array::from_fn(|_| (0..n).map(|_| stream.next()).collect()),
        };
        for level in levels() {
            let rows = eval(level, &metal(alpha, white), &elements);
            let (mean, own) = moments(rows.iter().map(|row| row[1]));
            let z = (mean - expected) / sigma.hypot(own);
            assert!(z.abs() < 4.5, "{alpha:?} {level}: {mean} {expected}, z {z}");
            // A planted fault of 3 % would show.
            assert!(0.03 * expected > 4.5 * sigma.hypot(own));
            // A weight is the product of Fresnel terms: nothing is lost.
            let rows = sample(level, &metal(alpha, white), &elements);
            assert!(rows.iter().all(|row| row[1] == 1.0));
            let cosine = moments(rows.iter().map(|row| row[6]));
            let walks = (0..REPEATS).filter_map(|_| {
                let u = [stream.next(), stream.next()];
                let (wi, _) = heitz.sample_walk(wo, u, &mut stream)?;
                Some(f64::from(wi.z))
            });
            let (expected, sigma) = moments(walks);
            let z = (cosine.0 - expected) / sigma.hypot(cosine.1);
            assert!(z.abs() < 4.5, "{alpha:?} {level}: {cosine:?} {expected}");
        }
    }
}

/// The mean and its standard deviation.
fn moments(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for x in values {
        n += 1.0;
        sum += x;
        squares += x * x;
    }
    let mean = sum / n;
    (mean, ((squares / n - mean * mean) / n).sqrt())
}

#[test]
fn the_other_models_and_densities_are_the_scalar_ones() {
    let elements = Elements::<f32>::new(70, 7);
    for model in MultibounceModel::ALL {
        for mis in MisPdf::ALL {
            let metal = MultibounceConductor::new(ggx([0.3, 0.6]), gold(), model).with_mis_pdf(mis);
            let (evals, samples) = (
                eval_scalar(&metal, &elements),
                sample_scalar(&metal, &elements),
            );
            let what = format!("{model} {mis}");
            for level in levels() {
                compare(
                    &what,
                    level,
                    &evals,
                    &eval(level, &metal, &elements),
                    2e-3,
                    2,
                );
                compare(
                    &what,
                    level,
                    &samples,
                    &sample(level, &metal, &elements),
                    2e-3,
                    2,
                );
            }
        }
    }
}

#[test]
fn slices_of_another_length_are_named() {
    let elements = Elements::<f32>::above(4, 1);
    let metal = metal([0.3, 0.3], gold());
    let (wo, wi) = (elements.wo.as_slices(), elements.wi.as_slices());
    let mut f_cos = Colours::zeroed(4);
    let error = Level::Baseline
        .eval_pdf_random(
            &metal,
            wo,
            wi,
            &mut streams(3),
            f_cos.as_mut_slices(),
            &mut [0.0; 4],
        )
        .expect_err("a shorter slice");
    assert_eq!((error.name, error.found, error.expected), ("streams", 3, 4));
    assert_eq!(f_cos, Colours::zeroed(4));
    let mut samples = Samples::rejected(4);
    let error = Level::Baseline
        .sample_random(
            &metal,
            Directions {
                x: &wo.x[1..],
                ..wo
            },
            elements.u(),
            &mut streams(4),
            samples.as_mut_slices(),
        )
        .expect_err("a shorter slice");
    assert_eq!((error.name, error.found, error.expected), ("wo.x", 3, 4));
    assert_eq!(samples, Samples::rejected(4));
}
