//! How far the kernels are from the same formulas in f64, at every level: the table in the
//! documentation of `batch`.
//!
//! Inputs are f32 values; the f64 twin gets the same. Densities and weights of samples are held
//! against the twin's at the direction that was returned, so that its rounding (within 1e-6) does
//! not count twice.
#![allow(
    clippy::print_stdout,
    reason = "tests say what they skipped and measured"
)]

mod batch_common;

use batch_common::Elements;
use specula_bsdf::batch::{Alphas, Colours, Directions, Level, Lobes, SampleOutcome, Samples};
use specula_bsdf::{Alpha, Bsdf, Transport, Vec3};
use specula_testing::horizon::{is_compared, roundings};

const N: usize = 20_000;

/// Extreme and ordinary alphas.
const ALPHAS: [[f32; 2]; 8] = [
    [1e-3, 1e-3],
    [1e-3, 1.0],
    [0.03, 0.03],
    [0.3, 0.3],
    [0.1, 0.8],
    [1.0, 1.0],
    [4.0, 0.5],
    [8.0, 8.0],
];

/// Largest relative errors of one lobe: of `f |cos|`, `pdf`, a sample's weight and its density.
#[derive(Clone, Copy, Debug, Default)]
struct Worst([f64; 4]);

impl Worst {
    /// Values below 1e-6 count by their absolute error over that.
    fn see(&mut self, which: usize, got: f32, expected: f64) {
        let error = (f64::from(got) - expected).abs() / expected.abs().max(1e-6);
        assert!(error.is_finite(), "{got} for {expected}");
        self.0[which] = self.0[which].max(error);
    }
}

fn measure<L, M>(worst: &mut Worst, level: Level, lobe: &L, twin: &M, e: &Elements<f32>)
where
    L: Lobes<f32>,
    M: Bsdf<f64>,
{
    let (wo, wi) = (e.wo.as_slices(), e.wi.as_slices());
    let transport = Transport::Radiance;
    let mut f_cos = Colours::<Vec<f32>>::zeroed(N);
    let mut pdf = vec![0.0_f32; N];
    let mut samples = Samples::<Vec<f32>, Vec<SampleOutcome>>::rejected(N);
    level
        .eval_pdf(lobe, wo, wi, transport, f_cos.as_mut_slices(), &mut pdf)
        .expect("equal lengths");
    level
        .sample(lobe, wo, e.u(), transport, samples.as_mut_slices())
        .expect("equal lengths");
    let samples = samples.as_slices();
    for (i, &density) in pdf.iter().enumerate() {
        let (wo, wi): (Vec3<f64>, Vec3<f64>) = (
            wo.get(i).expect("an element").cast(),
            wi.get(i).expect("an element").cast(),
        );
        let (f, p) = twin.eval_pdf(wo, wi, transport);
        worst.see(0, f_cos.g[i], f.g);
        worst.see(1, density, p);
        if matches!(
            samples.outcome[i],
            SampleOutcome::Reflection | SampleOutcome::Transmission
        ) {
            let wi = samples.wi.get(i).expect("an element").cast();
            let (f, p) = twin.eval_pdf(wo, wi, transport);
            worst.see(2, samples.weight.g[i], f.g / p);
            worst.see(3, samples.pdf[i], p);
        }
    }
}

fn levels() -> Vec<Level> {
    Level::ALL
        .into_iter()
        .filter(|l| l.is_available())
        .collect()
}

#[test]
fn errors_stay_within_the_table() {
    let elements = Elements::<f32>::new(N, 11);
    let mut metal = [Worst::default(); 4];
    let mut glass = Worst::default();
    let mut coats = Worst::default();
    let mut diffuse = [Worst::default(); 3];
    for level in levels() {
        for alpha in ALPHAS {
            for (sampler, worst) in batch_common::SAMPLERS.into_iter().zip(&mut metal) {
                let lobe = batch_common::metal(alpha, batch_common::gold()).with_sampler(sampler);
                let twin = batch_common::metal(alpha, batch_common::gold()).with_sampler(sampler);
                measure(worst, level, &lobe, &twin, &elements);
            }
            let (lobe, twin) = (
                batch_common::glass(alpha, 1.5),
                batch_common::glass(alpha, 1.5),
            );
            measure(&mut glass, level, &lobe, &twin, &elements);
            let (lobe, twin) = (
                batch_common::lossy_coat(Some(alpha)),
                batch_common::lossy_coat(Some(alpha)),
            );
            measure(&mut coats, level, &lobe, &twin, &elements);
            let (lobe, twin) = (batch_common::plastic(alpha), batch_common::plastic(alpha));
            measure(&mut coats, level, &lobe, &twin, &elements);
        }
        let (lambert, eon) = (batch_common::lambert(), batch_common::eon());
        let [a, b, c] = &mut diffuse;
        measure(a, level, &lambert, &batch_common::lambert(), &elements);
        measure(b, level, &eon, &batch_common::eon(), &elements);
        let sheet = batch_common::sheet();
        measure(c, level, &sheet, &batch_common::sheet(), &elements);
    }
    println!("metals {metal:?}\nglass {glass:?}\ncoats {coats:?}\ndiffuse {diffuse:?}");
    let within = |worst: Worst, bounds: [f64; 4]| {
        let all = worst.0.into_iter().zip(bounds);
        assert!(
            all.clone().all(|(worst, bound)| worst <= bound),
            "{worst:?}"
        );
    };
    metal.into_iter().for_each(|worst| within(worst, [2e-6; 4]));
    within(glass, [5e-5, 5e-5, 3e-3, 3e-3]);
    within(coats, [5e-6, 1e-5, 1e-5, 1e-5]);
    diffuse
        .into_iter()
        .for_each(|worst| within(worst, [1e-6; 4]));
}

/// How far `f64` values lie apart where each component of the directions is rounded once more: no `f32` knows better.
fn uncertainty<M: Bsdf<f64>>(twin: &M, at: [Vec3<f64>; 2], value: [f64; 2]) -> [f64; 2] {
    let mut most = [0.0_f64; 2];
    for moved in roundings(at.map(Vec3::to_array)) {
        let [wo, wi] = moved.map(Vec3::from);
        let (f, pdf) = twin.eval_pdf(wo, wi, Transport::Radiance);
        for (most, (a, b)) in most.iter_mut().zip([f.g, pdf].into_iter().zip(value)) {
            *most = most.max((a - b).abs());
        }
    }
    most
}

/// Largest error as a share of its bound, and how many elements were compared.
fn near_the_horizon<L, M>(level: Level, lobe: &L, twin: &M, e: &Elements<f32>) -> (f64, usize)
where
    L: Lobes<f32>,
    M: Bsdf<f64>,
{
    let (wo, wi) = (e.wo.as_slices(), e.wi.as_slices());
    let mut f_cos = Colours::<Vec<f32>>::zeroed(N);
    let mut pdf = vec![0.0_f32; N];
    let transport = Transport::Radiance;
    level
        .eval_pdf(lobe, wo, wi, transport, f_cos.as_mut_slices(), &mut pdf)
        .expect("equal lengths");
    let (mut worst, mut compared) = (0.0_f64, 0);
    for (i, &density) in pdf.iter().enumerate() {
        let at = [wo, wi].map(|w| w.get(i).expect("an element").cast::<f64>());
        let found = [f_cos.g[i], density].map(f64::from);
        assert!(found.iter().all(|x| x.is_finite() && *x >= 0.0), "{at:?}");
        if !is_compared(at.map(Vec3::to_array)) {
            continue;
        }
        compared += 1;
        let (f, p) = twin.eval_pdf(at[0], at[1], transport);
        let uncertain = uncertainty(twin, at, [f.g, p]);
        for ((a, b), uncertain) in found.into_iter().zip([f.g, p]).zip(uncertain) {
            let off = (a - b).abs() / (1e-3 * b.abs() + 4.0 * uncertain + 2e-4);
            assert!(off <= 1.0, "{level}, {at:?}: {a:e}, f64 {b:e}");
            worst = worst.max(off);
        }
    }
    (worst, compared)
}

/// The sweep of specula-stat's `extremes` for batches.
#[test]
fn values_are_those_of_f64_down_to_the_horizon() {
    let elements = Elements::near_the_horizon(N, 13);
    let (mut worst, mut compared, mut tried) = (0.0_f64, 0, 0);
    for level in levels() {
        for alpha in ALPHAS {
            let mut see = |(off, count): (f64, usize)| {
                worst = worst.max(off);
                compared += count;
                tried += N;
            };
            for sampler in batch_common::SAMPLERS {
                let lobe = batch_common::metal(alpha, batch_common::gold()).with_sampler(sampler);
                let twin = batch_common::metal(alpha, batch_common::gold()).with_sampler(sampler);
                see(near_the_horizon(level, &lobe, &twin, &elements));
            }
            let (lobe, twin) = (
                batch_common::glass(alpha, 1.5),
                batch_common::glass(alpha, 1.5),
            );
            see(near_the_horizon(level, &lobe, &twin, &elements));
            let (lobe, twin) = (
                batch_common::coated_diffuse(Some(alpha)),
                batch_common::coated_diffuse(Some(alpha)),
            );
            see(near_the_horizon(level, &lobe, &twin, &elements));
        }
    }
    println!("{tried} pairs of directions, {compared} compared, at most {worst:.3} of the bound");
    assert!(compared > tried / 20, "{compared} of {tried}");
}

#[test]
fn directions_stay_within_their_bound() {
    let e = Elements::<f32>::new(N, 12);
    let wo = e.wo.as_slices();
    let double = |v: &[f32]| v.iter().map(|&x| f64::from(x)).collect::<Vec<_>>();
    let twins = Directions {
        x: double(&e.wo.x),
        y: double(&e.wo.y),
        z: double(&e.wo.z),
    };
    let u = [double(&e.u[1]), double(&e.u[2])];
    for sampler in batch_common::SAMPLERS {
        let mut worst = 0.0_f64;
        for [x, y] in ALPHAS {
            let alpha = Alpha::clamped(f64::from(x), f64::from(y));
            let mut expected = Directions::<Vec<f64>>::zeroed(N);
            let done = Level::Baseline.sample_reflection(
                sampler,
                Alphas::Same(alpha),
                twins.as_slices(),
                [&u[0], &u[1]],
                expected.as_mut_slices(),
            );
            done.unwrap();
            for level in levels() {
                let mut got = Directions::<Vec<f32>>::zeroed(N);
                let (alphas, u) = (Alphas::Same(Alpha { x, y }), [&e.u[1][..], &e.u[2]]);
                level
                    .sample_reflection(sampler, alphas, wo, u, got.as_mut_slices())
                    .unwrap();
                for i in 0..N {
                    let got: Vec3<f64> = got.as_slices().get(i).expect("an element").cast();
                    let expected = expected.as_slices().get(i).expect("an element");
                    // At the horizon one may be rejected and the other not.
                    if got.z.min(expected.z) > 1e-5 {
                        worst = worst.max((got - expected).length());
                    }
                }
            }
        }
        println!("{sampler}: {worst:e}");
        assert!(worst < 2e-3, "{sampler}: {worst:e}");
    }
}
