//! Dupuy and Benyoub 2023, fig. 1: rough metal and rough glass by caps and by Heitz 2018.

use specula_bsdf::fresnel::{dielectric, refract};
use specula_bsdf::math::Stream;
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Vec3};
use specula_render::RenderOptions;
use specula_render::picture::Picture;
use specula_scene::Energy;
use specula_stat::image::{NoisyImage, compare};
use specula_stat::z_test::{Moments, equal_means, sidak};

use super::sampler_trials::{ALL_WAYS, Plan, Prepared, Trial, trials};
use crate::output::{Inset, PictureComparison, Shot, Table};
use crate::scenes::two_urns::{GLASS_ALPHA, two_urns};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "dupuy23-fig1",
    source: Source::Dupuy23,
    item: "fig. 1",
    title: "rough metal and rough glass by caps and by Heitz 2018",
    statement: "Caps offer the same variance as Heitz 2018 and converge to the same picture, for rough \
                conductors and rough dielectrics, with a slight but systematic gain in rendering time.",
    run,
};

/// Chance of a false alarm of each of the tests.
const SIGNIFICANCE: f64 = 1e-6;

/// Pixels on a side of the tiles whose means are compared.
const TILE: usize = 16;

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let width = lab.pick(96, 400);
    let plan = Plan {
        options: RenderOptions {
            samples_per_pixel: 32,
            max_depth: 32,
            energy: Energy::None,
            resolution: Some([width, width * 9 / 16]),
            ..RenderOptions::default()
        },
        rounds: lab.pick(4, 6),
    };
    // Caps twice, so that the comparison can be compared with one that is known to be of equals.
    let ways = [ALL_WAYS[0], ALL_WAYS[3], ALL_WAYS[0]];
    let prepared = Prepared::new(&two_urns(), &ways, &plan.options)?;
    let found = trials(lab, &prepared, &plan, [0.0, 0.9])?;
    let [cap, heitz, again] = [&found[0], &found[1], &found[2]];
    lab.step(0.9, "directions through glass")?;
    let glass = glass(lab)?;
    let pictures = Pictures::new(cap, heitz);
    let control = Pictures::new(cap, again);
    pictures_table(lab, &pictures, &control, heitz.time_ratio(cap))?;
    show(lab, &plan, [heitz, cap])?;
    Ok(verdict(&pictures, &glass, heitz.time_ratio(cap)))
}

/// Statistics of two pictures.
struct Pictures {
    /// Difference of the means over the mean, and its standard error.
    apart: [f64; 2],
    /// p-values of the means and of the worst tile.
    p_values: [f64; 2],
    /// Of the tiles: whether none is beyond the threshold.
    tiles_pass: bool,
    /// Variance of caps over that of Heitz 2018, and its standard error.
    variance: [f64; 2],
}

impl Pictures {
    fn new(cap: &Trial, heitz: &Trial) -> Self {
        let [a, b] = [&cap.picture, &heitz.picture].map(luminances);
        let width = cap.picture.width as usize;
        let noisy = |(mean, variance): &'_ (Vec<f64>, Vec<f64>)| -> (f64, f64) {
            let n = mean.len() as f64;
            (
                mean.iter().sum::<f64>() / n,
                variance.iter().sum::<f64>() / (n * n),
            )
        };
        let image = |(mean, variance)| NoisyImage {
            width,
            mean,
            variance,
        };
        let report = compare(
            &image((&a.0, &a.1)),
            &image((&b.0, &b.1)),
            TILE,
            3.0 * SIGNIFICANCE,
        );
        let check = |name: &str| report.checks.iter().find(|c| c.name == name);
        let p = |name| check(name).and_then(|c| c.p_value).unwrap_or(0.0);
        let ((mean, variance), (mean_b, variance_b)) = (noisy(&a), noisy(&b));
        let mut quotients = Moments::default();
        quotients.extend((cap.variance.iter().zip(&heitz.variance)).map(|(a, b)| a / b));
        Self {
            apart: [
                (mean - mean_b) / mean_b,
                (variance + variance_b).sqrt() / mean_b,
            ],
            p_values: [p("image mean"), p("image tiles")],
            tiles_pass: check("image tiles").is_some_and(|c| c.is_pass),
            variance: [quotients.mean(), quotients.variance_of_mean().sqrt()],
        }
    }
}

/// Luminances of a picture and their variances. Channels are not independent: the variance is that of
/// full correlation, an upper bound.
fn luminances(picture: &Picture) -> (Vec<f64>, Vec<f64>) {
    let mean = picture.colour.iter().map(|c| f64::from(c.luminance()));
    let deviation = |c: &specula_bsdf::Rgb<f32>| f64::from(c.map(f32::sqrt).luminance());
    let variance = picture.variance.iter().map(|c| deviation(c).powi(2));
    (mean.collect(), variance.collect())
}

fn pictures_table(
    lab: &mut Lab<'_>,
    found: &Pictures,
    control: &Pictures,
    time: f64,
) -> Result<()> {
    let mut table = Table::new(
        "pictures",
        "Caps against Heitz 2018 and against caps again, from independent random numbers; luminance, \
         single scattering, paths of up to 32 bounces.",
        &[
            "quantity",
            "Heitz 2018",
            "its standard error",
            "caps again",
            "its standard error",
        ],
    );
    let none = [f64::NAN; 2];
    for (quantity, [value, error], [value_again, error_again]) in [
        (
            "mean of caps over that of the other, less 1",
            found.apart,
            control.apart,
        ),
        (
            "p-value of equal means",
            [found.p_values[0], f64::NAN],
            [control.p_values[0], f64::NAN],
        ),
        (
            "smallest p-value of equal tiles",
            [found.p_values[1], f64::NAN],
            [control.p_values[1], f64::NAN],
        ),
        (
            "variance of caps over that of the other",
            found.variance,
            control.variance,
        ),
        (
            "time of the other over that of caps, median",
            [time, f64::NAN],
            none,
        ),
    ] {
        table.push([
            quantity.into(),
            value.into(),
            error.into(),
            value_again.into(),
            error_again.into(),
        ]);
    }
    lab.table(table)
}

fn show(lab: &mut Lab<'_>, plan: &Plan, trials: [&Trial; 2]) -> Result<()> {
    let width = trials[0].picture.width;
    let inset = |x: u32, y: u32| Inset {
        x: x * width / 512,
        y: y * width / 512,
        width: 72 * width / 512,
        height: 54 * width / 512,
    };
    let shots = trials.map(|t| Shot {
        label: t.way.name,
        picture: &t.picture,
        note: format!(
            "{} spp, {:.2} s of processor time",
            plan.options.samples_per_pixel * plan.rounds,
            t.seconds.iter().sum::<f64>()
        ),
    });
    lab.comparison(&PictureComparison {
        name: "two-urns",
        caption: "Rough metal (alpha 0.4) and rough glass (alpha 0.25).",
        shots: shots.into(),
        reference: None,
        insets: vec![inset(128, 120), inset(312, 120)],
        exposure_stops: 0.0,
    })?;
    Ok(())
}

/// What is summed over samples through glass.
const QUANTITIES: [&str; 7] = [
    "reflected",
    "reflected x",
    "reflected z",
    "passed",
    "passed x",
    "passed y^2",
    "passed z",
];

/// Statistics of directions through rough glass.
struct Glass {
    tests: usize,
    smallest_p: f64,
}

/// Compares directions reflected and refracted by normals of both samplers: each facet reflects
/// its Fresnel share and lets the rest pass.
fn glass(lab: &mut Lab<'_>) -> Result<Glass> {
    let samples = lab.pick(10_000, 400_000);
    let mut table = Table::new(
        "glass",
        "Means over facets sampled by each sampler, weighed by what they reflect or let pass; \
         directions beyond the surface count 0.",
        &[
            "alpha",
            "theta_o [deg]",
            "eta",
            "quantity",
            "Heitz 2018",
            "cap",
            "p-value",
        ],
    );
    let mut found = Glass {
        tests: 0,
        smallest_p: 1.0,
    };
    let mut seed = lab.seed();
    for alpha in [0.1, f64::from(GLASS_ALPHA), 0.5, 1.0] {
        for theta_deg in [10.0, 45.0, 80.0_f64] {
            for eta in [1.5, 1.0 / 1.5] {
                seed = seed.wrapping_add(2);
                let [heitz, cap] = [(Sampler::Heitz, 0), (Sampler::Cap, 1)].map(|(sampler, i)| {
                    through_glass(sampler, alpha, theta_deg, eta, samples, seed + i)
                });
                for ((name, a), b) in QUANTITIES.into_iter().zip(heitz).zip(cap) {
                    let estimate = |m: Moments| (m.mean(), m.variance_of_mean());
                    let p = equal_means(estimate(a), estimate(b));
                    found.tests += 1;
                    found.smallest_p = found.smallest_p.min(p);
                    table.push([
                        alpha.into(),
                        theta_deg.into(),
                        eta.into(),
                        name.into(),
                        a.mean().into(),
                        b.mean().into(),
                        p.into(),
                    ]);
                }
            }
        }
    }
    lab.table(table)?;
    Ok(found)
}

fn through_glass(
    sampler: Sampler,
    alpha: f64,
    theta_deg: f64,
    eta: f64,
    samples: u32,
    seed: u64,
) -> [Moments; 7] {
    let (sine, cosine) = theta_deg.to_radians().sin_cos();
    let wo = Vec3 {
        x: sine,
        y: 0.0,
        z: cosine,
    };
    let alpha = Alpha::isotropic(alpha);
    let mut stream = Stream::new(seed);
    let mut sums = [Moments::default(); 7];
    for _ in 0..samples {
        let u = [stream.next(), stream.next()];
        let wm = match sampler {
            Sampler::Heitz => vndf::heitz::sample_wm(alpha, wo, u),
            _ => vndf::cap::sample_wm(alpha, wo, u),
        };
        let cos_o = wo.dot(wm);
        let facet = dielectric(cos_o, eta);
        let up = vndf::reflect(wo, wm);
        let down = refract(wo, wm, cos_o, facet.cos_t, eta);
        let reflected = if up.z > 0.0 { facet.reflectance } else { 0.0 };
        let passed = match facet.reflectance < 1.0 && down.z < 0.0 {
            true => 1.0 - facet.reflectance,
            false => 0.0,
        };
        let values = [
            reflected,
            reflected * up.x,
            reflected * up.z,
            passed,
            passed * down.x,
            passed * down.y * down.y,
            passed * down.z,
        ];
        for (sum, value) in sums.iter_mut().zip(values) {
            sum.push(value);
        }
    }
    sums
}

fn verdict(pictures: &Pictures, glass: &Glass, time: f64) -> Verdict {
    let [apart, error] = pictures.apart.map(|v| 100.0 * v);
    let [mean, tiles] = pictures.p_values;
    let [variance, variance_error] = pictures.variance;
    let threshold = sidak(SIGNIFICANCE, glass.tests);
    Verdict {
        summary: format!(
            "Means differ by {apart:.3} +- {error:.3} %, variances by a factor of {variance:.3} +- \
             {variance_error:.3}; Heitz 2018 takes {time:.3} times as long."
        ),
        claims: vec![
            Claim::law(
                "Caps and Heitz 2018 converge to the same mean",
                "the same result",
                format!("means apart by {apart:.3} +- {error:.3} %, p = {mean:.2}"),
                mean > SIGNIFICANCE,
            ),
            Claim::measured(
                "No tile of 16 x 16 pixels differs by more than the pictures' own estimate of noise allows",
                "the same result",
                format!("worst tile p = {tiles:.1e}"),
                pictures.tiles_pass,
            ),
            Claim::law(
                "Directions reflected and refracted by rough glass have the same distribution",
                "the same result",
                format!(
                    "{} moments, smallest p = {:.1e} (bound {threshold:.1e})",
                    glass.tests, glass.smallest_p
                ),
                glass.smallest_p > threshold,
            ),
            Claim::measured(
                "The variance is the same",
                "the same",
                format!("x {variance:.3} +- {variance_error:.3}"),
                (variance - 1.0).abs() < (4.0 * variance_error).max(0.02),
            ),
            Claim::measured(
                "Rendering with caps takes slightly less time",
                "slight but systematic gains",
                format!("Heitz 2018 takes {time:.3} times as long"),
                time > 1.0,
            ),
        ],
        caveat: "A scene of our own. The renderer samples normals of glass by caps always; the picture \
                 compares the samplers on metal, also as seen through glass, and the table of directions \
                 compares them on glass."
            .to_owned(),
    }
}
