//! The report, as Markdown.

use std::fmt::Write;
use std::fs;

use super::Versus;
use super::measure::{Outcome, Row};
use super::statistics::{equal_error_ratio, median};

/// What the goal asks: time to equal error over the peer's.
const GOAL: f64 = 0.5;

/// The table of one scene, its pairs after it.
pub(crate) fn scene(outcome: &Outcome) -> String {
    let mut text = String::from(
        "| renderer | sampler | samples (reference) | wall s | CPU s | Msamples/s | RMSE | trimmed RMSE | relMSE \
         | RMSE to the other's | mean | rate | warm-up s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in &outcome.rows {
        let over = |of: &dyn Fn(&super::measure::Render) -> f64| {
            median(&row.renders.iter().map(of).collect::<Vec<_>>())
        };
        let samples = row.pixels as f64 * f64::from(row.spp);
        let other = row
            .rmse_of_other
            .map_or("".to_owned(), |e| format!("{e:.4}"));
        let _ = writeln!(
            text,
            "| {} | {} | {} ({}) | {:.2} | {:.2} | {:.2} | {:.4} | {:.4} | {:.4} | {other} | {:.4} | {:.2} | {:.1} |",
            row.name,
            row.sampler,
            row.spp,
            row.reference_spp,
            over(&|r| r.wall),
            over(&|r| r.cpu),
            1e-6 * samples / over(&|r| r.seconds),
            over(&|r| r.errors.mse).sqrt(),
            over(&|r| r.errors.trimmed_mse).sqrt(),
            over(&|r| r.errors.rel_mse),
            row.reference_mean,
            row.rate,
            row.warm_up,
        );
    }
    text.push('\n');
    for (specula, theirs) in pairs(outcome) {
        if let Some(fault) = &theirs.fault {
            let _ = writeln!(text, "- error: {fault}.");
            continue;
        }
        let spread = ratios(specula, theirs, 0);
        let (least, most) = spread
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(a, b), &r| (a.min(r), b.max(r)));
        let _ = writeln!(
            text,
            "- {} against {}: time to equal RMSE {:.3} ({least:.3} to {most:.3}), to equal trimmed \
             RMSE {:.3}, to equal relMSE {:.3}; means {:+.2} %.",
            specula.name,
            theirs.name,
            median(&spread),
            median(&ratios(specula, theirs, 1)),
            median(&ratios(specula, theirs, 2)),
            100.0 * (specula.reference_mean / theirs.reference_mean - 1.0),
        );
    }
    text
}

/// One line for each pair: our time over theirs to equal RMSE.
pub(crate) fn summary(outcomes: &[Outcome]) -> String {
    let mut text = String::from(
        "| scene | peer | time to equal RMSE | trimmed | relMSE | goal 0.5 |\n|---|---|---|---|---|---|\n",
    );
    for outcome in outcomes {
        for (specula, theirs) in pairs(outcome) {
            if let Some(fault) = &theirs.fault {
                let name = outcome.scene.name;
                let _ = writeln!(text, "| {name} | {} | error: {fault} | | | |", theirs.name);
                continue;
            }
            let [plain, trimmed, relative] =
                [0, 1, 2].map(|metric| median(&ratios(specula, theirs, metric)));
            let _ = writeln!(
                text,
                "| {} | {} | {plain:.3} | {trimmed:.3} | {relative:.3} | {} |",
                outcome.scene.name,
                theirs.name,
                if plain <= GOAL { "met" } else { "missed" },
            );
        }
    }
    text
}

/// Our time over theirs to an equal error, round by round; `metric` as in `Errors::to_array`.
fn ratios(specula: &Row, theirs: &Row, metric: usize) -> Vec<f64> {
    let rounds = specula.renders.iter().zip(&theirs.renders);
    let point = |r: &super::measure::Render| (r.seconds, r.errors.to_array()[metric]);
    rounds
        .map(|(a, b)| equal_error_ratio(point(a), point(b)))
        .collect()
}

fn pairs(outcome: &Outcome) -> impl Iterator<Item = (&Row, &Row)> {
    let rows = &outcome.rows;
    rows.iter().filter_map(move |theirs| {
        let pair = theirs.against?;
        let specula = rows.iter().find(|r| r.name == pair.specula)?;
        Some((specula, theirs))
    })
}

/// The whole document.
pub(crate) fn document(versus: &Versus, outcomes: &[Outcome], minutes: f64) -> String {
    let plan = versus.plan();
    let mut versions: Vec<&str> = Vec::new();
    for row in outcomes.iter().flat_map(|o| &o.rows) {
        if !versions.contains(&&*row.version) {
            versions.push(&row.version);
        }
    }
    let mut text = String::from(HEAD);
    let _ = writeln!(
        text,
        "- Machine: {}, {} threads for everybody; Linux. Specula on `--device {}`, Mitsuba as `{}`.\n\
         - Versions: {}.\n- This run: {} rounds of \
         renders of about {} s, references of {} times the samples, `--clock {}`, {minutes:.0} \
         minutes in all.\n",
        processor(),
        plan.threads,
        versus.device,
        versus.variant,
        versions.join("; "),
        plan.rounds,
        plan.seconds,
        plan.reference,
        format!("{:?}", plan.clock).to_lowercase(),
    );
    text.push_str(
        "## Result\n\nTime to equal error, Specula over theirs, median of the rounds:\n\n",
    );
    text.push_str(&summary(outcomes));
    for outcome in outcomes {
        let (name, title) = (outcome.scene.name, outcome.scene.title);
        let names: Vec<&str> = outcome.rows.iter().map(|r| r.name).collect();
        let _ = write!(
            text,
            "\n## {name}: {title}\n\n![{title}]({name}.png)\n\nLeft to right: the whole, and a detail of \
             the reference, {}, at about equal time.\n\n{}",
            names.join(", "),
            scene(outcome)
        );
    }
    text
}

/// The processor's name, as Linux knows it.
fn processor() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|l| l.starts_with("model name"));
    let name = line.and_then(|l| l.split_once(": "));
    name.map_or("unknown processor", |(_, name)| name)
        .to_owned()
}

const HEAD: &str = "\
# Equal time, other renderers

Written by the chore below, on a machine that does nothing else; the scenes are in `data/versus`.

    cargo xtask versus --mitsuba PYTHON --cycles PYTHON --publish

## What is compared, and how

- **Scenes.** Four, each in Mitsuba's and in pbrt's format, 512x512 pixels, box filter. Mitsuba and
  `specula-xml` read the very same file (GGX with separable masking, as Mitsuba's), pbrt and
  `specula-pbrt` the other (height-correlated masking); a test holds that both are the same picture but
  for the masking. Cycles, whose masking is height-correlated, builds the same shapes, lights and
  materials from the first (spheres as smooth meshes of 256 x 128, Metallic and Glass with GGX, no
  multiple scattering, front sides of lamps only). Path lengths agree; Russian roulette is each
  renderer's own.
- **Settings.** No denoising or clamping; caustics on; light tree on. Specula with the best of even sampling and
  `--adaptive` with every path alone or with those of 8 or of 16 pixels that share (`--share-paths`), Mitsuba
  with the best of its five samplers (it has no adaptive sampling) and Cycles with the best of tabulated Sobol, blue
  noise and adaptive sampling with its own threshold, chosen per scene by seconds times trimmed variance, from two
  renders each, of which the quicker tells the time. Samples are what the sampler took: Mitsuba's stratified ones
  round up to squares; where sampling is adaptive they are what was asked for.
- **Time** is that of rendering alone. Specula: what its picture says, without reading the scene, building
  the hierarchy and writing the picture (for CPU time, twice that of one sample less that of two).
  Mitsuba: `mi.render`, evaluated and synchronised, its kernels compiled before (warm-up). Cycles: the
  render operator with persistent data, scene and hierarchy transferred before. pbrt: the process less
  one that renders a pixel.
- **Error** is against each renderer's own reference, made with the sampler of the renders: the mean of
  two halves of other seeds, together of the stated multiple of samples. The halves tell the
  reference's own squared error, a quarter of their mean squared difference, which is taken off
  what is measured. The column beside gives the error against the other's reference. RMSE over
  pixels and channels; trimmed: without the largest 0.1 % of squares; relMSE with 0.01 added to the
  squared reference.
- **Time to equal error**, Specula over theirs: t mse / (t' mse'), as squared errors fall with time. The
  column `rate` checks that: the exponent of the trimmed RMSE's fall from the rounds to a render of four
  times the samples: 0.5 for independent samples.
- **The means** of a pair's references must agree within 0.5 %, pbrt's, which is spectral, within 2 %;
  else the row is an error and the chore fails.

";

#[cfg(test)]
mod tests {
    use super::super::measure::{Pair, Render};
    use super::super::scenes::SCENES;
    use super::super::statistics::Errors;
    use super::*;

    fn row(name: &'static str, against: Option<&'static str>, seconds: &[f64], mse: f64) -> Row {
        let render = |&seconds: &f64| Render {
            seconds,
            wall: seconds,
            cpu: 2.0 * seconds,
            errors: Errors {
                mse,
                trimmed_mse: 0.5 * mse,
                rel_mse: mse,
            },
        };
        Row {
            name,
            version: format!("{name} 1"),
            against: against.map(|specula| Pair {
                specula,
                tolerance: 0.005,
            }),
            sampler: "s",
            spp: 16,
            pixels: 4,
            reference_spp: 256,
            reference_mean: 1.0,
            warm_up: 0.0,
            renders: seconds.iter().map(render).collect(),
            rmse_of_other: None,
            rate: 0.5,
            fault: None,
        }
    }

    #[test]
    fn the_ratio_is_the_median_over_rounds_and_the_goal_is_judged() {
        let mut outcome = Outcome {
            scene: &SCENES[0],
            rows: vec![
                row("specula", None, &[1.0, 2.0, 9.0], 0.01),
                row("theirs", Some("specula"), &[2.0, 2.0, 2.0], 0.02),
                row("slow", Some("nobody"), &[2.0], 0.02),
            ],
            width: 2,
            pictures: Vec::new(),
        };
        let text = summary(std::slice::from_ref(&outcome));
        assert!(
            text.ends_with("| metal-room | theirs | 0.500 | 0.500 | 0.500 | met |\n"),
            "{text}"
        );
        assert!(scene(&outcome).contains("0.500 (0.250 to 2.250)"));
        outcome.rows[0] = row("specula", None, &[3.0], 0.01);
        let one = std::slice::from_ref(&outcome);
        assert!(summary(one).contains("| 0.750 | 0.750 | 0.750 | missed |"));
        outcome.rows[1].fault = Some("dark".to_owned());
        assert!(summary(std::slice::from_ref(&outcome)).contains("| theirs | error: dark |"));
        assert!(scene(&outcome).contains("- error: dark."));
    }
}
