//! The kernel that adds samples, beside whole random of the processor: equal to the last bit.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail loudly")]
#![allow(
    clippy::cast_possible_truncation,
    reason = "random of a test, known to be small"
)]

mod common;

use common::gpu;
use specula_gpu::{ComputeKernel, Gpu};
use specula_render::RunSums;

const TEXT: &str = include_str!("../wgsl/sums.wgsl");
/// Places of a run among the samples.
const PLACES: usize = 64;

/// A sample as the path tracer leaves it: values and depth; albedo and rays; normal and weight.
type Sample = [[f32; 4]; 3];

/// Random by a fixed recurrence.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        self.0 >> 32
    }

    /// Of either sign, with an exponent in `-range..range`; now and then one of `others`.
    fn float(&mut self, range: i32, others: &[f32]) -> f32 {
        let kind = self.next() % 16;
        if kind == 0 && !others.is_empty() {
            return others[(self.next() as usize) % others.len()];
        }
        let mantissa = 1.0 + (self.next() % (1 << 23)) as f32 / (1 << 23) as f32;
        let exponent = i32::try_from(self.next() % (2 * range as u64)).unwrap() - range;
        let sign = if kind % 4 == 1 { -1.0 } else { 1.0 };
        sign * mantissa * 2.0_f32.powi(exponent)
    }
}

/// The exponent of a number's bits, and its digits, below 0 where it is.
fn parts(x: f32) -> (i32, i128) {
    let exponent = ((x.to_bits() >> 23) & 0xff) as i32;
    let digits = i128::from(x.to_bits() & 0x7f_ffff) | if exponent > 0 { 1 << 23 } else { 0 };
    (
        exponent.max(1),
        if x.is_sign_negative() {
            -digits
        } else {
            digits
        },
    )
}

/// `digits * 2^places`, towards zero.
fn moved(digits: i128, places: i32) -> i128 {
    match places {
        0.. => digits << places,
        -127..0 => digits.signum() * (digits.abs() >> -places),
        _ => 0,
    }
}

fn fixed(x: f32) -> i64 {
    (f64::from(x).clamp(-256.0, 256.0) * (1_u64 << 30) as f64).round() as i64
}

/// What the sums are, by their definition.
fn expected(samples: &[Sample]) -> RunSums {
    let mut sums = RunSums::default();
    let is_finite = |s: &&Sample| s[0][..3].iter().all(|v| v.is_finite());
    let has_depth = |s: &&Sample| s[0][3].is_finite() && s[0][3].is_sign_positive();
    let finite = || samples.iter().filter(is_finite);
    let exponents = finite().flat_map(|s| s[0][..3].iter().map(|&v| parts(v).0));
    let largest = exponents.max().unwrap_or(1);
    let met = || finite().filter(has_depth);
    let deepest = met().map(|s| parts(s[0][3]).0).max().unwrap_or(1);
    for s in finite() {
        let [values, albedo, normal] = s;
        for (k, (exponent, digits)) in values[..3].iter().map(|&v| parts(v)).enumerate() {
            sums.colour[k] += moved(digits, 96 - (largest - exponent));
            sums.squares[k] += moved(digits * digits, 72 - 2 * (largest - exponent));
            sums.albedo[k] += fixed(albedo[k]);
            sums.normal[k] += fixed(normal[k]);
        }
    }
    for s in met() {
        let (exponent, digits) = parts(s[0][3]);
        sums.depth += moved(digits, 96 - (deepest - exponent));
    }
    let hits = u32::try_from(met().count()).unwrap();
    sums.scales = largest as u32 | (deepest as u32) << 8 | hits << 16;
    sums.rays = samples.iter().map(|s| s[1][3] as u32).sum();
    for (i, s) in samples.iter().enumerate() {
        sums.invalid |= u64::from(!is_finite(&s)) << i;
    }
    sums
}

/// Runs of different lengths and ranges of random.
fn runs() -> Vec<Vec<Sample>> {
    let mut random = Random(7);
    let odd = [0.0, -0.0, 1e-40, -3e-39, f32::MAX, f32::MIN_POSITIVE];
    let broken = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0];
    let ordinary: &[f32] = &[];
    let mut run = |count: usize, range: i32, others: &[f32]| -> Vec<Sample> {
        let sample = |_| {
            let mut sample = [[0.0; 4]; 3];
            for x in sample.as_flattened_mut() {
                *x = random.float(range, others);
            }
            sample[1][3] = (random.next() % 1000) as f32;
            sample
        };
        (0..count).map(sample).collect()
    };
    let mut runs = Vec::new();
    for count in [1, 2, 31, 33, 63, 64] {
        for range in [2, 20, 120] {
            for others in [ordinary, &odd, &broken] {
                runs.push(run(count, range, others));
            }
        }
    }
    // All at once: what the sums must hold at most.
    runs.push(vec![
        [
            [f32::MAX; 4],
            [f32::MAX, f32::MIN, 1e8, 5.0],
            [-1.0; 4]
        ];
        64
    ]);
    runs.push(vec![[[f32::MIN, f32::MAX, -1.0, -1.0]; 3]; 64]);
    runs
}

/// What the device makes of the runs.
fn on_device(gpu: &Gpu, text: &str, runs: &[Vec<Sample>]) -> Vec<RunSums> {
    let count = u32::try_from(runs.len()).unwrap();
    let mut wanted = vec![[PLACES as u32, count, 0, 0], [0; 4]];
    wanted.extend(runs.iter().map(|r| [0, 0, 0, r.len() as u32]));
    let mut found: Vec<Sample> = Vec::new();
    for run in runs {
        found.extend(run);
        // What must not count.
        found.resize(found.len().next_multiple_of(PLACES), [[1e30; 4]; 3]);
    }
    let module = gpu.shader("sums", text).unwrap();
    let kernel = ComputeKernel::new(gpu, &module, "sums_main", 2).unwrap();
    let inputs: [&[u8]; 2] = [bytemuck::cast_slice(&wanted), bytemuck::cast_slice(&found)];
    let size = size_of::<RunSums>() * runs.len();
    let arrays = kernel.upload(gpu, &inputs, size as u64).unwrap();
    kernel
        .run(gpu, &arrays, [count.div_ceil(64), 1, 1])
        .unwrap();
    bytemuck::pod_collect_to_vec(&arrays.output(gpu).unwrap())
}

#[test]
fn sums_are_exact() {
    let Some(gpu) = gpu("sums of samples") else {
        return;
    };
    let runs = runs();
    let found = on_device(gpu, TEXT, &runs);
    assert_eq!(found.len(), runs.len());
    for (i, (run, found)) in runs.iter().zip(&found).enumerate() {
        assert_eq!(*found, expected(run), "run {i} of {} samples", run.len());
    }
    let invalid: u32 = found.iter().map(|s| s.invalid.count_ones()).sum();
    assert!(invalid > 50, "{invalid}");
}

#[test]
fn planted_faults_are_noticed() {
    let Some(gpu) = gpu("planted faults of sums") else {
        return;
    };
    let runs = runs();
    let right: Vec<RunSums> = runs.iter().map(|run| expected(run)).collect();
    for (from, to) in [
        (
            "carry = select(0u, 1u, overflows || sum[i] < carry)",
            "carry = 0u",
        ),
        (
            "(digits + (1u << (places - 1u))) >> places",
            "digits >> places",
        ),
        ("+ select(0u, 1u, low < sum.x)", ""),
        ("select(0u, 1u, next < begin) + ", ""),
        (
            "i32(SUMS_SQUARE_SHIFT) - 2 * below",
            "i32(SUMS_SQUARE_SHIFT) - below",
        ),
        ("hits += 1u;", "hits = 1u;"),
        // The last sample in no sum.
        (
            "var invalid = vec2u(0u);\n    for (var i = 0u; i",
            "var invalid = vec2u(0u);\n    for (var i = 0u; i + 1u",
        ),
        ("i < 32u);", "true);"),
    ] {
        let text = TEXT.replacen(from, to, 1);
        assert_ne!(text, TEXT, "{from}");
        assert_ne!(on_device(gpu, &text, &runs), right, "{from}");
    }
}
