//! Dupuy and Benyoub 2023, section 4: the synthetic benchmark of the processor.

use specula_bsdf::math::Stream;
use specula_bsdf::vndf::{self, Sampler};
use specula_bsdf::{Alpha, Vec3};

use super::sample_times::{self, Inputs};
use super::stopwatch::median;
use crate::output::Table;
use crate::plot::{Axis, Content, Figure, Panel, Series};
use crate::{Claim, Experiment, Lab, Result, Source, Verdict};

/// The experiment.
pub(super) const EXPERIMENT: Experiment = Experiment {
    id: "dupuy23-cpu-benchmark",
    source: Source::Dupuy23,
    item: "section 4, CPU",
    title: "time of a visible normal by the cap and by Heitz 2018, processor",
    statement: "The cap is 37.67 % faster than Heitz 2018 (i7-13700K, median over 100 invocations), \
                consistently across roughness values and incident directions, and of the same quality.",
    run,
};

const THETAS_DEG: [f32; 3] = [0.0, 45.0, 80.0];

fn run(lab: &mut Lab<'_>) -> Result<Verdict> {
    let alphas: &[f32] = lab.pick(
        &[0.1, 0.4, 0.7, 1.0],
        &[0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0],
    );
    let mut table = Table::new(
        "times",
        "Medians over 100 invocations per sample, f32, one thread.",
        &[
            "alpha",
            "theta [deg]",
            "normal, Heitz 2018 [ns]",
            "normal, cap [ns]",
            "quotient",
            "reflection in batches, Heitz 2018 [ns]",
            "reflection in batches, cap [ns]",
            "quotient in batches",
        ],
    );
    // By view: quotients over the alphas, scalar and in batches.
    let mut lines: [Vec<Series>; 2] = Default::default();
    let mut quotients: [Vec<f64>; 2] = Default::default();
    let mut farthest: f64 = 0.0;
    for (i, theta) in THETAS_DEG.into_iter().enumerate() {
        for lines in &mut lines {
            lines.push(Series::new(&format!("theta = {theta} deg"), i, Vec::new()));
        }
        for (j, &alpha) in alphas.iter().enumerate() {
            let share = (i * alphas.len() + j) as f64 / (3 * alphas.len()) as f64;
            lab.step(share, "timing samples")?;
            farthest = farthest.max(difference(alpha, theta, lab.seed()));
            let inputs = Inputs::one_view(Alpha::isotropic(alpha), theta, lab.seed());
            let mut runs = [
                sample_times::normals(&inputs, Sampler::Heitz),
                sample_times::normals(&inputs, Sampler::Cap),
                sample_times::batch_reflections(&inputs, Sampler::Heitz),
                sample_times::batch_reflections(&inputs, Sampler::Cap),
            ];
            let times = sample_times::medians(&mut runs, 100);
            let ratios = [times[0] / times[1], times[2] / times[3]];
            for (k, ratio) in ratios.into_iter().enumerate() {
                lines[k][i].points.push([f64::from(alpha), ratio]);
                quotients[k].push(ratio);
            }
            table.push([
                alpha.into(),
                theta.into(),
                times[0].into(),
                times[1].into(),
                ratios[0].into(),
                times[2].into(),
                times[3].into(),
                ratios[1].into(),
            ]);
        }
    }
    lab.table(table)?;
    let highest = quotients.iter().flatten().copied().fold(1.5, f64::max);
    let panels = (lines.into_iter().zip(["scalar", "in batches"]))
        .map(|(mut series, title)| {
            series.push(Series::new(
                "paper: 1.38",
                7,
                vec![[0.0, 1.3767], [1.0, 1.3767]],
            ));
            Panel {
                title: title.to_owned(),
                x: Axis::linear("alpha").from_to(0.0, 1.0),
                y: Axis::linear("time of Heitz 2018 / time of the cap").from_to(0.0, 1.1 * highest),
                content: Content::Lines(series),
            }
        })
        .collect();
    let caption = "How many times faster the cap samples than Heitz 2018.";
    lab.plot("speed-up", caption, &Figure::grid(2, panels))?;
    let scalar = Spread::of(&quotients[0]);
    let batch = Spread::of(&quotients[1]);
    Ok(verdict(&scalar, &batch, farthest))
}

/// Distance of the two samplers' mean normals in standard errors: the largest over the components.
fn difference(alpha: f32, theta_deg: f32, seed: u64) -> f64 {
    const COUNT: u32 = 4000;
    let alpha = Alpha::isotropic(f64::from(alpha));
    let (sine, cosine) = f64::from(theta_deg).to_radians().sin_cos();
    let wo = Vec3 {
        x: 0.6 * sine,
        y: 0.8 * sine,
        z: cosine,
    };
    let mut stream = Stream::new(seed);
    let mut mean = |sample: fn(Alpha<f64>, Vec3<f64>, [f64; 2]) -> Vec3<f64>| {
        let (mut sums, mut squares) = ([0.0; 3], [0.0; 3]);
        for _ in 0..COUNT {
            let wm = sample(alpha, wo, [stream.next(), stream.next()]);
            for (k, value) in [wm.x, wm.y, wm.z].into_iter().enumerate() {
                sums[k] += value;
                squares[k] += value * value;
            }
        }
        let n = f64::from(COUNT);
        [0, 1, 2].map(|k| {
            let mean = sums[k] / n;
            (mean, (squares[k] / n - mean * mean) / n)
        })
    };
    let heitz = mean(vndf::heitz::sample_wm);
    let cap = mean(vndf::cap::sample_wm);
    (heitz.into_iter().zip(cap))
        .map(|((a, va), (b, vb))| (a - b).abs() / (va + vb).sqrt())
        .fold(0.0, f64::max)
}

/// Least, middle and greatest.
struct Spread {
    low: f64,
    middle: f64,
    high: f64,
}

impl Spread {
    fn of(values: &[f64]) -> Self {
        Self {
            low: values.iter().copied().fold(f64::INFINITY, f64::min),
            middle: median(values.iter().copied()),
            high: values.iter().copied().fold(0.0, f64::max),
        }
    }

    fn text(&self) -> String {
        format!("{:.2} ({:.2} to {:.2})", self.middle, self.low, self.high)
    }
}

fn verdict(scalar: &Spread, batch: &Spread, farthest: f64) -> Verdict {
    Verdict {
        summary: format!(
            "Heitz 2018 takes {} times the cap's time for a normal, {} times for a reflection in \
             batches; paper 1.38.",
            scalar.text(),
            batch.text()
        ),
        claims: vec![
            Claim::measured(
                "The cap samples a visible normal faster than Heitz 2018",
                "37.67 % (read as 1.38 times)",
                format!("{} times", scalar.text()),
                scalar.middle > 1.1,
            ),
            Claim::measured(
                "Consistently across roughness values and incident directions",
                "consistent",
                format!("quotients from {:.2} to {:.2}", scalar.low, scalar.high),
                scalar.low > 1.0 && scalar.high < 1.5 * scalar.low,
            ),
            Claim::measured(
                "So it is for reflections in batches, with the machine's vectors",
                "not in the paper",
                format!("{} times", batch.text()),
                batch.middle > 1.1,
            ),
            Claim::law(
                "Both sample the same distribution",
                "the same quality",
                format!("mean normals differ by at most {farthest:.1} standard errors"),
                farthest < 5.0,
            ),
        ],
        caveat: "Another processor. The paper does not say whether 37.67 % is a quotient of times or a \
                 share of time saved; it is read as a quotient. The scalar gain depends on whether \
                 square roots, minima and sines compile to instructions without branches and calls; \
                 those of Specula do, in both samplers."
            .to_owned(),
    }
}
