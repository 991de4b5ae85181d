//! The report, as Markdown.

use std::fmt::Write;
use std::fs;

use super::Versus;
use super::block::Block;
use super::outcome::{Outcome, Row, Source, time_to_equal};
use super::sheet;
use super::statistics::Metric;
use super::table::{self, mark};

/// What the goal asks: time to equal RMSE and to equal block RMSE, over the peer's.
const GOAL: f64 = 0.5;

/// A table for each block: our time over theirs to equal errors.
pub(crate) fn summary(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for block in Block::ALL {
        let pairs: Vec<_> = outcomes
            .iter()
            .flat_map(|o| o.pairs(block).map(|(a, b)| (&o.scene.name, a, b)))
            .collect();
        if pairs.is_empty() {
            continue;
        }
        let goal = block.has_goal();
        let _ = write!(
            text,
            "### {}\n\n{}\n\n| scene | peer | time to equal RMSE | of 8 x 8 block means | relMSE \
             | Msamples/s, Specula / theirs | time per sample |{}\n|---|---|---|---|---|---|---|{}\n",
            block.title(),
            block.description(),
            if goal { " goal 0.5 |" } else { "" },
            if goal { "---|" } else { "" },
        );
        for (scene, specula, theirs) in pairs {
            let _ = write!(
                text,
                "| {scene} | {} | {}",
                theirs.form,
                cells(specula, theirs, goal)
            );
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

/// The cells of a pair, from the time to equal RMSE on.
fn cells(specula: &Row, theirs: &Row, goal: bool) -> String {
    if let Some(fault) = specula.fault.as_ref().or(theirs.fault.as_ref()) {
        return format!("error: {fault} | | | | |{}", if goal { " |" } else { "" });
    }
    let to_equal = |metric| time_to_equal(specula, theirs, metric, Source::References);
    let [plain, blocks] = [Metric::Rmse, Metric::BlockRmse].map(to_equal);
    let [rate, other_rate] = [specula, theirs].map(Row::samples_per_second);
    let mark = |metric| mark(&[specula, theirs], metric);
    let judgement = match (goal, plain <= GOAL && blocks <= GOAL) {
        (false, _) => "",
        (true, true) => " met |",
        (true, false) => " missed |",
    };
    format!(
        "{plain:.3}{} | {blocks:.3}{} | {:.3} | {:.2} / {:.2} | {:.3} |{judgement}",
        mark(Metric::Rmse),
        mark(Metric::BlockRmse),
        to_equal(Metric::RelMse),
        1e-6 * rate,
        1e-6 * other_rate,
        other_rate / rate,
    )
}

/// The whole document.
pub(crate) fn document(versus: &Versus, outcomes: &[Outcome], minutes: f64) -> String {
    let mut text = String::from(HEAD);
    text.push_str(&summary(outcomes));
    text.push_str(METHOD);
    text.push_str(&this_run(versus, outcomes, minutes));
    for outcome in outcomes {
        let (name, title) = (&outcome.scene.name, &outcome.scene.title);
        let _ = write!(text, "\n## {name}: {title}\n\n");
        if outcome.is_shown() {
            let shown = outcome.rows.iter().filter(|r| sheet::shows(r));
            let names: Vec<&str> = shown.map(|r| r.name.as_str()).collect();
            let _ = write!(
                text,
                "![{title}]({name}.png)\n\nLeft to right: the reference, {}, at about equal \
                 time. Above a detail, below the whole picture, shrunk.\n\n",
                names.join(", "),
            );
        }
        text.push_str(&table::scene(outcome));
    }
    text
}

/// Machine, versions and settings.
fn this_run(versus: &Versus, outcomes: &[Outcome], minutes: f64) -> String {
    let plan = versus.plan();
    let rows = || outcomes.iter().flat_map(|o| &o.rows);
    let mut versions: Vec<&str> = Vec::new();
    for row in rows() {
        if !versions.contains(&&*row.version) {
            versions.push(&row.version);
        }
    }
    let mut text = String::new();
    let _ = writeln!(
        text,
        "- Machine: {}, {} threads for everybody; Linux. Specula on `--device {}`, Mitsuba as `{}`, Cycles \
         on `{}`.\n\
         - Versions: {}.\n- This run: {} rounds of \
         renders of about {} s, references of {} times the samples, `--clock {}`, {minutes:.0} \
         minutes in all.",
        processor(),
        plan.threads,
        versus.device,
        versus.variant,
        versus.cycles_device,
        versions.join("; "),
        plan.rounds,
        plan.seconds,
        plan.reference,
        format!("{:?}", plan.clock).to_lowercase(),
    );
    let is_denoised = |row: &Row| row.flip.is_some_and(|f| f.denoised.is_some());
    if !rows().any(is_denoised) {
        text.push_str(
            "- No picture was denoised: this Specula was built without Open Image Denoise.\n",
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

Written by the chore below; the scenes are in `data/versus`. Seconds by the clock are those of a machine that does
nothing else; with `--clock cpu` they are those of the processor, on a machine that is shared.

    cargo xtask versus --mitsuba PYTHON --cycles PYTHON --pbrt PROGRAM --publish

## Result

Time to equal error, Specula over theirs, median of the rounds, in three blocks: what Specula does by default, its best
without shared paths, and with them. The goal is half of the time to equal RMSE and to equal RMSE of means of 8 x 8
pixels. `apart` marks errors that the reference and pairs of seeds tell more than 5 % differently. Scenes whose names end
in `gold` or `white` are the same ones with all their metals of gold, or of white, beside the quickest peer.

";

const METHOD: &str = "\
## What is compared, and how

- **Scenes.** Four, each in Mitsuba's and in pbrt's format, 512x512 pixels, box filter. Mitsuba and
  `specula-xml` read the very same file (GGX with separable masking, as Mitsuba's), pbrt and
  `specula-pbrt` the other (height-correlated masking); a test holds that both are the same picture but
  for the masking. Cycles, whose masking is height-correlated, builds the same shapes, lights and
  materials from the first (spheres as smooth meshes of 256 x 128, Metallic and Glass with GGX, no
  multiple scattering, front sides of lamps only). Path lengths agree; Russian roulette is each
  renderer's own.
- **Metals.** The scenes have several metals. With `--metals gold,white` all of them are gold, or a white metal that reflects
  0.9996 of the light, in both formats. They are compared with Mitsuba, the quickest of the peers.
- **Blocks.** `defaults` is `specula render SCENE --spp N`. `alone` is the better of even sampling and `--adaptive`,
  every path alone; where it renders the same pictures as the defaults, bit for bit, they are rendered once. `shared`
  is the better of `--adaptive` with the paths of 8 and of 16 pixels shared (`--share-paths`), on the CPU only. Pixels
  that share paths have noise in common: the error of every pixel falls, that of means of 8 x 8 pixels does not, and
  seen from afar the picture is as noisy as before. So these figures stand apart. Every peer is rendered once, and
  compared in each block.
- **Settings.** No denoising or clamping; caustics on; light tree on. Mitsuba with the best of its five samplers (it
  has no adaptive sampling), Cycles with the best of tabulated Sobol, blue noise and adaptive sampling with its own
  threshold, pbrt with its ZSobol sampler. Samplers are chosen per scene by seconds times trimmed variance, from two
  renders each, of which the quicker tells the time. Samples are what the sampler took: Mitsuba's stratified ones
  round up to squares; where sampling is adaptive they are what was asked for. All pictures have 32 bits per channel.
- **Time** is that of rendering alone. Specula: what its picture says, without reading the scene, building
  the hierarchy and writing the picture (for CPU time, twice that of one sample less that of two).
  Mitsuba: `mi.render`, evaluated and synchronised, its kernels compiled before (warm-up). Cycles: the
  render operator with persistent data, scene and hierarchy transferred before. pbrt: the process less
  one that renders a pixel. The time per sample is Specula's over theirs.
- **Errors** are over pixels and channels. RMSE; trimmed: without the largest 0.1 % of squares; relMSE with 0.01 added
  to the squared reference. Block RMSE is that of the means of 8 x 8 pixels, times 8: for white noise it is the RMSE,
  for noise that all pixels of a block have in common 8 times the RMSE.
- **References** are each renderer's own, of the sampler of its renders; those of Specula with one format have one,
  made by `alone`. One is the mean of two halves of other seeds, together of the stated multiple of samples. The
  halves tell the reference's own squared error, a quarter of their mean squared difference, which is taken off
  what is measured. One column gives the error against the other's reference.
- **Pairs of seeds** tell RMSE and block RMSE without a reference: half of the mean squared difference of the pictures
  of rounds 1 and 2, 2 and 3 and so on. In brackets is the root of their mean over that of the same renders against
  the reference. More than 5 % apart is marked: seeds are not independent, or the reference is not of the same
  estimator, or there is too much noise in the errors. More than 25 % apart, the row is an error and the chore fails.
- **Time to equal error**, Specula over theirs: t mse / (t' mse'), as squared errors fall with time. The
  column `rate` checks that: the exponent of the trimmed RMSE's fall from the rounds to a render of four
  times the samples: 0.5 for independent samples.
- **FLIP** (Andersson et al. 2020) is the mean over the picture of the first round against the renderer's reference,
  both clamped as on a screen, 67 pixels per degree: as rendered, and denoised. The denoiser is the same for all: Open
  Image Denoise, given the colours alone, where Specula was built with it. The reference is not denoised.
- **The means** of a pair's references must agree within 0.5 %, pbrt's, which is spectral, within 2 %;
  else the row is an error and the chore fails.

";

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::super::flip::Flip;
    use super::super::outcome::tests::row;
    use super::super::scenes::tests::scene;
    use super::*;

    /// Blocks out of order, the shared one quicker than all.
    fn outcome() -> Outcome {
        Outcome {
            scene: scene(),
            rows: vec![
                row(
                    "specula-shared",
                    Some(Block::Shared),
                    &[1.0, 1.0, 1.0],
                    0.01,
                ),
                row("specula-alone", Some(Block::Alone), &[3.0; 3], 0.01),
                row(
                    "specula-defaults",
                    Some(Block::Defaults),
                    &[1.0, 2.0, 9.0],
                    0.01,
                ),
                row("peer", None, &[2.0, 2.0, 2.0], 0.02),
            ],
            references: Vec::new(),
            first: Vec::new(),
        }
    }

    #[test]
    fn three_blocks_come_out_in_order_and_the_goal_is_asked_of_two() {
        let text = summary(&[outcome()]);
        let lines: Vec<&str> = text
            .lines()
            .filter(|l| l.starts_with("| metal-room"))
            .collect();
        assert_eq!(
            lines,
            [
                "| metal-room | peer | 0.500 | 0.500 | 0.500 | 32.00 / 32.00 | 1.000 | met |",
                "| metal-room | peer | 0.750 | 0.750 | 0.750 | 21.33 / 32.00 | 1.500 | missed |",
                "| metal-room | peer | 0.250 | 0.250 | 0.250 | 64.00 / 32.00 | 0.500 |",
            ]
        );
        let headings: Vec<&str> = text.lines().filter(|l| l.starts_with('#')).collect();
        let titles = Block::ALL.map(|b| format!("### {}", b.title()));
        assert_eq!(headings, titles);
        let without_shared = Outcome {
            rows: outcome().rows.split_off(1),
            ..outcome()
        };
        assert_eq!(summary(&[without_shared]).matches("###").count(), 2);
    }

    #[test]
    fn the_goal_is_met_by_pixels_and_by_blocks_or_missed() {
        for metric in [Metric::Rmse, Metric::BlockRmse] {
            let mut outcome = outcome();
            for render in &mut outcome.rows[2].renders {
                match metric {
                    Metric::Rmse => render.errors.mse *= 1.1,
                    _ => render.errors.block_mse *= 1.1,
                }
            }
            let text = summary(&[outcome]);
            assert!(!text.contains("| met |"), "{metric:?}: {text}");
        }
    }

    #[test]
    fn a_disagreement_is_marked_and_a_fault_takes_the_place_of_the_figures() {
        let mut outcome = outcome();
        for pair in &mut outcome.rows[3].pairs {
            pair.errors.block_mse *= 0.81;
        }
        let text = summary(std::slice::from_ref(&outcome));
        assert!(text.contains("| 0.500 | 0.500 apart | 0.500 |"), "{text}");
        outcome.rows[2].fault = Some("dark".to_owned());
        let text = summary(std::slice::from_ref(&outcome));
        assert!(
            text.contains("| peer | error: dark | | | | | |\n"),
            "{text}"
        );
        assert!(text.contains("| 0.250 | 0.250 apart | 0.250 |"), "{text}");
        outcome.rows[3].fault = Some("bright".to_owned());
        let text = summary(std::slice::from_ref(&outcome));
        assert!(
            text.contains("| peer | error: bright | | | | |\n"),
            "{text}"
        );
    }

    #[derive(Parser)]
    struct Chore {
        #[command(flatten)]
        versus: Versus,
    }

    #[test]
    fn the_document_begins_with_the_result_and_says_whether_pictures_were_denoised() {
        let versus = Chore::parse_from(["versus"]).versus;
        let mut outcome = outcome();
        let text = document(&versus, std::slice::from_ref(&outcome), 1.0);
        let place = |what: &str| text.find(what).unwrap_or_else(|| panic!("{what}: {text}"));
        let parts = [
            "## Result",
            "### Defaults",
            "### With",
            "## What is",
            "- Machine",
            "![rough",
        ];
        assert!(parts.map(place).is_sorted(), "{text}");
        assert!(
            text.contains("reference, specula-shared, specula-defaults, peer, at"),
            "{text}"
        );
        assert!(text.contains("- No picture was denoised"), "{text}");
        for row in &mut outcome.rows {
            row.flip = Some(Flip {
                rendered: 0.1,
                denoised: Some(0.05),
            });
        }
        let text = document(&versus, &[outcome], 1.0);
        assert!(!text.contains("- No picture was denoised"), "{text}");
    }
}
