//! Specula: the share of reflections that each sampler rejects, over alphas and views.

use specula_bsdf::math::Stream;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Vec3};

use super::view_grid::{self, Axes, view};
use crate::output::Table;
use crate::plot::Figure;
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "specula-rejection",
    source: Source::Specula,
    item: "rejection maps",
    title: "share of rejected reflections over alphas and views",
    statement: "A cap rejects 1 - N_exact / N of its reflections; the exact sampler none.",
    run,
};

/// Those that reject: of the exact sampler there is no map.
const NAMES: [&str; 2] = ["cap", "bounded"];

/// Rejected shares in per cent: cap, bounded, exact.
type Shares = [f64; 3];

/// Pairs whose means `docs/exact-reflection-sampling.md` states, with those of cap and bounded.
const STATED: [((f64, f64), [f64; 2]); 5] = [
    ((0.2, 0.8), [16.5, 15.1]),
    ((0.05, 1.0), [20.7, 20.6]),
    ((0.6, 1.0), [25.0, 14.0]),
    ((1.0, 1.5), [38.4, 15.6]),
    ((0.6, 0.6), [17.5, 3.8]),
];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let side = lab.pick(30, 60);
    let views = view_grid::hemisphere(lab.pick(200, 2000));
    let isotropic = view_grid::over_angles(side, |a, theta| shares(a, view(theta, 0.0)));
    lab.step(0.2, "averaging over views")?;
    let anisotropic = view_grid::over_alphas(side, |a| mean(a, &views));
    write(lab, "isotropic", Axes::Angles, &isotropic)?;
    write(lab, "anisotropic", Axes::Alphas, &anisotropic)?;

    lab.step(0.5, "sampling reflections")?;
    let samples = lab.pick(20_000, 500_000);
    let sampled = sampled(lab.seed(), samples);
    let below = exact_below(lab.seed(), 20 * samples);
    lab.step(0.9, "comparing means")?;
    let many = view_grid::hemisphere(4096);
    let means = STATED.map(|(alphas, stated)| (alphas, stated, mean(of(alphas), &many)));
    let mut table = Table::new(
        "means",
        "Rejected shares, means over the hemisphere of views.",
        &[
            "alpha_x",
            "alpha_y",
            "cap [%]",
            "bounded [%]",
            "cap, stated [%]",
            "bounded, stated [%]",
        ],
    );
    for ((x, y), stated, mean) in means {
        table.push([
            x.into(),
            y.into(),
            mean[0].into(),
            mean[1].into(),
            stated[0].into(),
            stated[1].into(),
        ]);
    }
    lab.table(table)?;
    let farthest = means
        .iter()
        .flat_map(|(_, stated, mean)| [mean[0] - stated[0], mean[1] - stated[1]])
        .fold(0.0, |m: f64, d| m.max(d.abs()));
    Ok(verdict(&isotropic, &anisotropic, &sampled, below, farthest))
}

fn of((x, y): (f64, f64)) -> Alpha<f64> {
    Alpha::clamped(x, y)
}

/// `1 - N_exact / N` in per cent.
fn shares(alpha: Alpha<f64>, wo: Vec3<f64>) -> Shares {
    let norm = |sampler| Ggx::new(alpha).reflection_norm(sampler, wo);
    let exact = norm(Sampler::Exact);
    [Sampler::Cap, Sampler::Bounded, Sampler::Exact].map(|s| 100.0 * (1.0 - exact / norm(s)))
}

fn mean(alpha: Alpha<f64>, views: &[Vec3<f64>]) -> Shares {
    let mut sums = [0.0; 3];
    for &wo in views {
        for (sum, share) in sums.iter_mut().zip(shares(alpha, wo)) {
            *sum += share;
        }
    }
    sums.map(|s| s / views.len() as f64)
}

fn write(lab: &mut Lab<'_>, name: &str, axes: Axes, cells: &[Vec<Shares>]) -> Result<()> {
    let (second, caption) = match axes {
        Axes::Angles => (
            "theta_o [deg]",
            "Rejected shares for equal alphas, by view.",
        ),
        Axes::Alphas => (
            "alpha_y",
            "Rejected shares, means over the hemisphere of views.",
        ),
    };
    let heads = ["alpha_x", second, "cap [%]", "bounded [%]", "exact [%]"];
    let mut table = Table::new(name, caption, &heads);
    let side = u32::try_from(cells.len()).unwrap_or(0);
    let ys = match axes {
        Axes::Angles => view_grid::middles(side, 90.0),
        Axes::Alphas => view_grid::middles(side, 1.0),
    };
    let xs = view_grid::middles(side, 1.0);
    for (row, y) in cells.iter().zip(ys) {
        for ([cap, bounded, exact], &x) in row.iter().zip(&xs) {
            table.push([
                x.into(),
                y.into(),
                (*cap).into(),
                (*bounded).into(),
                (*exact).into(),
            ]);
        }
    }
    lab.table(table)?;
    let panels = (0..)
        .zip(NAMES)
        .map(|(i, title)| {
            let label = ("rejected [%]", [0.0, 50.0]);
            view_grid::panel(title, axes, label, cells, |shares: &Shares| shares[i])
        })
        .collect();
    lab.plot(name, caption, &Figure::grid(2, panels))
}

/// Largest distance of sampled shares from the closed form in standard errors, and how many were compared.
fn sampled(seed: u64, samples: u32) -> (f64, usize) {
    let mut stream = Stream::new(seed);
    let mut scores = Vec::new();
    for alphas in [(0.4, 0.4), (0.9, 0.9), (0.2, 0.8), (1.0, 0.5)] {
        for theta in [0.0, 45.0, 75.0] {
            let (alpha, wo) = (of(alphas), view(theta, 40.0));
            let [cap, bounded, _] = shares(alpha, wo);
            for (sampler, share) in [(Sampler::Cap, cap), (Sampler::Bounded, bounded)] {
                let below = (0..samples).filter(|_| {
                    let u = [stream.next(), stream.next()];
                    Ggx::new(alpha).sample_reflection(sampler, wo, u).z <= 0.0
                });
                let (n, p) = (f64::from(samples), share / 100.0);
                let counted = below.count() as f64;
                // Half a sample more, where the share is nearly 0.
                let error = (n * p * (1.0 - p)).sqrt() + 0.5;
                scores.push((counted - n * p).abs() / error);
            }
        }
    }
    (scores.iter().copied().fold(0.0, f64::max), scores.len())
}

/// How many of `samples` reflections in `f32` the exact sampler leaves below the surface, per million.
fn exact_below(seed: u64, samples: u32) -> f64 {
    let mut stream = Stream::new(seed);
    let mut below = 0_u32;
    for _ in 0..samples {
        let alpha = Alpha::clamped(stream.next::<f32>(), stream.next());
        let wo = specula_bsdf::math::warp::cosine_hemisphere([stream.next(), stream.next()]);
        let u = [stream.next(), stream.next()];
        let wi = vndf::exact::sample_direction(alpha, wo, u);
        below += u32::from(wi.z <= 0.0);
    }
    1e6 * f64::from(below) / f64::from(samples)
}

fn verdict(
    isotropic: &[Vec<Shares>],
    anisotropic: &[Vec<Shares>],
    &(score, compared): &(f64, usize),
    below_ppm: f64,
    farthest: f64,
) -> Verdict {
    let all = || isotropic.iter().chain(anisotropic).flatten();
    let worst = all().map(|s| s[1] - s[0]).fold(f64::NEG_INFINITY, f64::max);
    let average = |cells: &[Vec<Shares>], i: usize| {
        let values: Vec<f64> = cells.iter().flatten().map(|s| s[i]).collect();
        values.iter().sum::<f64>() / values.len() as f64
    };
    let [cap, bounded] = [0, 1].map(|i| average(anisotropic, i));
    let most = |i: usize| all().map(|s| s[i]).fold(0.0, f64::max);
    Verdict {
        summary: format!(
            "Mean over alphas up to 1 and views: the cap rejects {cap:.1} % (up to {:.0}), the bounded \
             cap {bounded:.1} % (up to {:.0}), the exact sampler {below_ppm:.1} per million by rounding.",
            most(0),
            most(1)
        ),
        claims: vec![
            Claim::law(
                "Rejected shares are 1 - N_exact / N",
                "closed form",
                format!("{compared} sampled shares within {score:.1} standard errors"),
                score < 5.0,
            ),
            Claim::law(
                "The bounded cap never rejects more than the cap",
                "tighter",
                format!("at most {worst:.1e} points more"),
                worst < 1e-9,
            ),
            Claim::law(
                "The exact sampler rejects nothing but by rounding in f32",
                "none",
                format!("{below_ppm:.2} per million"),
                below_ppm < 20.0,
            ),
            Claim::law(
                "Means over views are those of docs/exact-reflection-sampling.md",
                "16.5 and 15.1 % for (0.2, 0.8), and four more",
                format!("within {farthest:.2} points"),
                farthest < 0.2,
            ),
        ],
        caveat: String::new(),
    }
}
