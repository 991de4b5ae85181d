//! Cost of one reflection and of one density for every GGX sampler, scalar, one thread.
//!
//! All candidates run in turn, many times, and medians are compared: ratios are what counts,
//! absolute times are the machine's. Beside them stand the papers' ratios: the cap 1.38 times
//! faster than Heitz 2018 (Dupuy and Benyoub 2023, section 4), the bounded cap 1.25 times the
//! cap's cost (Tokuyoshi and Eto 2024, table 2).
#![allow(clippy::print_stdout, reason = "a bench reports on stdout")]

use std::hint::black_box;
use std::time::Instant;

use specula_bsdf::math::warp::uniform_sphere;
use specula_bsdf::vndf::{Reflections, Sampler};
use specula_bsdf::{Alpha, Vec3, vndf};

const POINTS: usize = 4096;
const ROUNDS: usize = 301;

#[derive(Clone, Copy)]
struct Point {
    alpha: Alpha<f32>,
    wo: Vec3<f32>,
    wi: Vec3<f32>,
    u: [f32; 2],
    fixed_view: Reflections<f32>,
}

impl Point {
    fn new(alpha: Alpha<f32>, wo: Vec3<f32>, wi: Vec3<f32>, u: [f32; 2]) -> Self {
        Self {
            alpha,
            wo,
            wi,
            u,
            fixed_view: Reflections::new(alpha, wo, Sampler::Exact),
        }
    }
}

/// Points over the hemisphere of views with alphas in [0.05, 1], from the R2 sequence.
fn points() -> Vec<Point> {
    let fraction = |i: usize, step: f64| {
        #[allow(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            reason = "a small index, and a number in [0, 1)"
        )]
        let x = (0.5 + i as f64 * step).fract() as f32;
        x.min(0.999_999)
    };
    (0..POINTS)
        .map(|i| {
            let at = |k: f64| fraction(i, k);
            let up = |w: Vec3<f32>| Vec3 {
                z: w.z.abs().max(1e-3),
                ..w
            };
            Point::new(
                Alpha::clamped(0.05 + 0.95 * at(0.754_877_7), 0.05 + 0.95 * at(0.569_840_3)),
                up(uniform_sphere([at(0.819_172_5), at(0.671_043_6)])).normalize(),
                up(uniform_sphere([at(0.549_700_5), at(0.618_033_9)])).normalize(),
                [at(0.856_674_9), at(0.733_891_9)],
            )
        })
        .collect()
}

#[inline(never)]
fn time_samples(points: &[Point], sample: impl Fn(&Point) -> Option<Vec3<f32>>) -> f64 {
    let start = Instant::now();
    for p in points {
        black_box(sample(black_box(p)));
    }
    start.elapsed().as_secs_f64()
}

#[inline(never)]
fn time_pdfs(points: &[Point], pdf: impl Fn(&Point) -> f32) -> f64 {
    let start = Instant::now();
    for p in points {
        black_box(pdf(black_box(p)));
    }
    start.elapsed().as_secs_f64()
}

fn median_ns(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    #[allow(clippy::cast_precision_loss, reason = "4096 points")]
    let per_point = 1e9 / POINTS as f64;
    times[times.len() / 2] * per_point
}

fn main() {
    let points = points();
    let isotropic: Vec<Point> = points
        .iter()
        .map(|p| Point::new(Alpha::isotropic(p.alpha.x), p.wo, p.wi, p.u))
        .collect();
    let mut times = vec![Vec::new(); 14];
    for _ in 0..ROUNDS {
        times[0].push(time_samples(&points, |p| {
            vndf::heitz::sample_reflection(p.alpha, p.wo, p.u)
        }));
        times[1].push(time_samples(&points, |p| {
            vndf::cap::sample_reflection(p.alpha, p.wo, p.u)
        }));
        times[2].push(time_samples(&points, |p| {
            vndf::bounded::sample_reflection(p.alpha, p.wo, p.u)
        }));
        times[3].push(time_samples(&isotropic, |p| {
            vndf::exact::sample_reflection(p.alpha, p.wo, p.u)
        }));
        times[4].push(time_samples(&points, |p| {
            vndf::exact::sample_reflection(p.alpha, p.wo, p.u)
        }));
        times[5].push(time_pdfs(&points, |p| {
            vndf::heitz::reflection_pdf(p.alpha, p.wo, p.wi)
        }));
        times[6].push(time_pdfs(&points, |p| {
            vndf::cap::reflection_pdf(p.alpha, p.wo, p.wi)
        }));
        times[7].push(time_pdfs(&points, |p| {
            vndf::bounded::reflection_pdf(p.alpha, p.wo, p.wi)
        }));
        times[8].push(time_pdfs(&isotropic, |p| {
            vndf::exact::reflection_pdf(p.alpha, p.wo, p.wi)
        }));
        times[9].push(time_pdfs(&points, |p| {
            vndf::exact::reflection_pdf(p.alpha, p.wo, p.wi)
        }));
        for (i, points) in [&isotropic, &points].into_iter().enumerate() {
            times[10 + i].push(time_pdfs(points, |p| p.fixed_view.pdf(p.wi)));
            times[12 + i].push(time_samples(points, |p| p.fixed_view.sample(p.u)));
        }
    }
    let ns: Vec<f64> = times.iter_mut().map(|t| median_ns(t)).collect();
    report(&ns);
}

/// * `ns`: samples, densities, then densities and samples with a `Reflections` of the view.
fn report(ns: &[f64]) {
    let names = ["heitz", "cap", "bounded", "exact, ax = ay", "exact"];
    println!("GGX reflection off a visible normal, f32, scalar, one thread (median of {ROUNDS})");
    println!("  sampler         sample ns   pdf ns");
    for (i, name) in names.iter().enumerate() {
        println!("  {name:<14} {:>10.2} {:>8.2}", ns[i], ns[i + 5]);
    }
    println!(
        "  heitz / cap              {:.2}   (paper: 1.38)",
        ns[0] / ns[1]
    );
    println!(
        "  bounded / cap            {:.2}   (paper: 1.25)",
        ns[2] / ns[1]
    );
    println!(
        "  pdf bounded / cap        {:.2}   (paper: 1.31)",
        ns[7] / ns[6]
    );
    println!(
        "  exact, ax = ay / bounded {:.2}   pdf {:.2}",
        ns[3] / ns[2],
        ns[8] / ns[7]
    );
    println!(
        "  exact / bounded          {:.2}   pdf {:.2}",
        ns[4] / ns[2],
        ns[9] / ns[7]
    );
    println!(
        "  exact by vndf::Reflections, which stores N and cone of the view, ns and share of the above"
    );
    for (i, name) in ["ax = ay", "any"].iter().enumerate() {
        println!(
            "    {name:<10} sample {:.2} ({:.2})   pdf {:.2} ({:.2})",
            ns[12 + i],
            ns[12 + i] / ns[3 + i],
            ns[10 + i],
            ns[10 + i] / ns[8 + i]
        );
    }
}
