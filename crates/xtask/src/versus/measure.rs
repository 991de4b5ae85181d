//! Renders in turn, and what they tell.

use std::fs;
use std::path::Path;
use std::rc::Rc;

use specula_bsdf::Rgb;

use super::block::Block;
use super::outcome::{Outcome, Pair, Render, Row, SeedPair};
use super::plan::Plan;
use super::reference::{Reference, colours};
use super::renderers::Engine;
use super::scenes::Scene;
use super::statistics::{mean, rate};
use super::trial::{self, Choice};
use crate::Result;

/// A renderer with its scene.
pub(crate) struct Contestant {
    form: &'static str,
    block: Option<Block>,
    samplers: Vec<&'static str>,
    against: Option<Pair>,
    engine: Box<dyn Engine>,
}

impl Contestant {
    pub(crate) fn new(
        form: &'static str,
        samplers: &[&'static str],
        engine: impl Engine + 'static,
    ) -> Self {
        Self {
            form,
            block: None,
            samplers: samplers.to_vec(),
            against: None,
            engine: Box::new(engine),
        }
    }

    /// Makes it Specula in one of its blocks.
    pub(crate) fn in_block(self, block: Block) -> Self {
        Self {
            block: Some(block),
            ..self
        }
    }

    /// Names the form of Specula that it is compared with, in every block.
    pub(crate) fn against(self, specula: &'static str, tolerance: f64) -> Self {
        Self {
            against: Some(Pair { specula, tolerance }),
            ..self
        }
    }

    /// Leaves only those of its samplers that are named; all of them where none is.
    pub(crate) fn among(mut self, named: &[String]) -> Self {
        let is_named = |sampler: &&str| named.iter().any(|n| n == sampler);
        if self.samplers.iter().any(is_named) {
            self.samplers.retain(is_named);
        }
        self
    }

    /// Whether it is Specula with shared paths.
    pub(crate) fn shares_paths(&self) -> bool {
        self.block == Some(Block::Shared)
    }

    fn name(&self) -> String {
        match self.block {
            Some(block) => format!("{}-{}", self.form, block.name()),
            None => self.form.to_owned(),
        }
    }
}

/// Everything about one scene.
pub(crate) fn run(
    scene: Scene,
    plan: &Plan,
    mut contestants: Vec<Contestant>,
    folder: &Path,
    key: u64,
) -> Result<Outcome> {
    fs::create_dir_all(folder)?;
    let choices = choose(plan, &mut contestants, folder)?;
    let references = references(plan, &mut contestants, &choices, folder, key)?;
    let mut rows = Vec::new();
    for (i, contestant) in contestants.iter().enumerate() {
        rows.push(row(contestant, &choices[i], &references[i]));
        rows[i].same_as = same_as(&contestants[..=i], &choices);
    }
    compare_means(&mut rows);
    let mut first = rounds(plan, &mut contestants, &mut rows, &references, folder)?;
    rates(&mut contestants, &mut rows, &references, folder)?;
    copy_same(&mut rows, &mut first);
    compare_with_others(&mut rows, &references, &first)?;
    rows.iter_mut().for_each(Row::check_agreement);
    Ok(Outcome {
        scene,
        rows,
        references,
        first,
    })
}

/// The samplers and samples of all. Specula's best without shared paths takes as many as its defaults:
/// renders of other lengths would compare rates of convergence, too.
fn choose(plan: &Plan, contestants: &mut [Contestant], folder: &Path) -> Result<Vec<Choice>> {
    let mut choices: Vec<Choice> = Vec::new();
    for i in 0..contestants.len() {
        let form = contestants[i].form;
        let defaults = |c: &Contestant| c.form == form && c.block == Some(Block::Defaults);
        let wanted = match contestants[i].block {
            Some(Block::Alone) => contestants[..i].iter().position(defaults),
            _ => None,
        };
        let wanted = wanted.map(|j| choices[j].wanted);
        let name = contestants[i].name();
        let Contestant {
            samplers, engine, ..
        } = &mut contestants[i];
        let engine = &mut **engine;
        choices.push(trial::choose(
            plan,
            &name,
            (engine, samplers),
            wanted,
            folder,
        )?);
    }
    Ok(choices)
}

/// The references of all. Specula's rows of one form have one in common: its best without shared paths
/// renders it, with the stated multiple of the most samples that any of them takes.
fn references(
    plan: &Plan,
    contestants: &mut [Contestant],
    choices: &[Choice],
    folder: &Path,
    key: u64,
) -> Result<Vec<Rc<Reference>>> {
    let forms: Vec<&str> = contestants.iter().map(|c| c.form).collect();
    let mut references: Vec<Rc<Reference>> = Vec::new();
    for (i, form) in forms.iter().enumerate() {
        if let Some(earlier) = forms[..i].iter().position(|f| f == form) {
            references.push(references[earlier].clone());
            continue;
        }
        let of_form = || (i..forms.len()).filter(|&j| forms[j] == *form);
        let maker = of_form().find(|&j| contestants[j].block == Some(Block::Alone));
        let maker = maker.unwrap_or(i);
        let most = of_form().map(|j| choices[j].spp).max();
        let half = (plan.reference * most.unwrap_or(1)).div_ceil(2);
        let sampler = choices[maker].sampler;
        let start = format!("{form}-reference-{key:016x}-{sampler}-");
        let engine = &mut *contestants[maker].engine;
        let reference = Reference::of(engine, sampler, half, folder, &start)?;
        println!(
            "  {form}: reference of {} samples, {sampler}, RMSE {:.5}",
            reference.spp,
            reference.rmse()
        );
        references.push(Rc::new(reference));
    }
    Ok(references)
}

fn row(contestant: &Contestant, choice: &Choice, reference: &Reference) -> Row {
    Row {
        name: contestant.name(),
        form: contestant.form,
        block: contestant.block,
        version: contestant.engine.version(),
        against: contestant.against,
        sampler: choice.sampler,
        spp: choice.spp,
        pixels: reference.picture.len(),
        reference_spp: reference.spp,
        reference_mean: mean(&reference.picture),
        warm_up: choice.warm_up,
        same_as: None,
        renders: Vec::new(),
        pairs: Vec::new(),
        rmse_of_other: None,
        rate: f64::NAN,
        flip: None,
        fault: None,
    }
}

/// The first of Specula's rows of one form whose trial rendered the picture of the last one's, bit for bit.
fn same_as(contestants: &[Contestant], choices: &[Choice]) -> Option<usize> {
    let (last, earlier) = contestants.split_last()?;
    last.block?;
    let picture = |i: usize| (choices[i].spp, &choices[i].picture);
    let same = |i: usize| contestants[i].form == last.form && picture(i) == picture(earlier.len());
    (0..earlier.len()).find(|&i| same(i))
}

/// Renders all in turn, round after round, and returns the pictures of the first.
fn rounds(
    plan: &Plan,
    contestants: &mut [Contestant],
    rows: &mut [Row],
    references: &[Rc<Reference>],
    folder: &Path,
) -> Result<Vec<Vec<Rgb<f32>>>> {
    let mut first = vec![Vec::new(); rows.len()];
    let mut last = first.clone();
    for round in 1..=plan.rounds {
        for (i, row) in rows.iter_mut().enumerate() {
            if row.same_as.is_some() {
                continue;
            }
            let engine = &mut *contestants[i].engine;
            let (render, picture) = render(plan, engine, row, &references[i], round, folder)?;
            if let Some(before) = row.renders.last() {
                row.pairs.push(SeedPair {
                    seconds: 0.5 * (before.seconds + render.seconds),
                    errors: references[i].errors_of_pair([&last[i], &picture])?,
                });
            }
            row.renders.push(render);
            if round == 1 {
                first[i].clone_from(&picture);
            }
            last[i] = picture;
        }
    }
    Ok(first)
}

/// One render of a round.
fn render(
    plan: &Plan,
    engine: &mut dyn Engine,
    row: &Row,
    reference: &Reference,
    round: u32,
    folder: &Path,
) -> Result<(Render, Vec<Rgb<f32>>)> {
    let name = &row.name;
    let file = folder.join(format!("{name}-{round}.exr"));
    let timing = engine.render(row.sampler, row.spp, round, &file)?;
    if timing.spp != row.spp {
        return Err(format!("{name} took {} samples, then {}", row.spp, timing.spp).into());
    }
    let seconds = plan.seconds_of(timing);
    if seconds <= 0.0 {
        // pbrt's are a difference, which another program's work can turn round.
        return Err(format!("{name} took less than its loading: try again").into());
    }
    let picture = colours(&file)?.1;
    let errors = reference.errors(&picture)?;
    println!(
        "{round} {name:<21} {:6.2} s wall, {:6.2} s CPU, RMSE {:.4}, block RMSE {:.4}",
        timing.wall,
        timing.cpu,
        errors.mse.sqrt(),
        errors.block_mse.sqrt()
    );
    let render = Render {
        seconds,
        wall: timing.wall,
        cpu: timing.cpu,
        errors,
    };
    Ok((render, picture))
}

/// How the errors of all fall, to four times the samples.
fn rates(
    contestants: &mut [Contestant],
    rows: &mut [Row],
    references: &[Rc<Reference>],
    folder: &Path,
) -> Result<()> {
    for (i, row) in rows.iter_mut().enumerate() {
        if row.same_as.is_some() {
            continue;
        }
        let file = folder.join(format!("{}-x4.exr", row.name));
        let engine = &mut *contestants[i].engine;
        let timing = engine.render(row.sampler, 4 * row.spp, trial::SEED, &file)?;
        let many = references[i].errors(&colours(&file)?.1)?.trimmed_mse;
        let few = row.mean_over_rounds(|r| r.errors.trimmed_mse);
        row.rate = rate((f64::from(row.spp), few), (f64::from(timing.spp), many));
    }
    Ok(())
}

/// Fills in the rows whose pictures another has rendered.
fn copy_same(rows: &mut [Row], first: &mut [Vec<Rgb<f32>>]) {
    for i in 0..rows.len() {
        if let Some(j) = rows[i].same_as {
            rows[i].renders = rows[j].renders.clone();
            rows[i].pairs = rows[j].pairs.clone();
            rows[i].rate = rows[j].rate;
            first[i] = first[j].clone();
        }
    }
}

/// Notes where the means of a pair's references differ too much: one of the two renders another scene.
fn compare_means(rows: &mut [Row]) {
    for i in 0..rows.len() {
        let Some(Pair { specula, tolerance }) = rows[i].against else {
            continue;
        };
        let Some(specula) = rows.iter().find(|r| r.form == specula) else {
            continue;
        };
        let apart = rows[i].reference_mean / specula.reference_mean - 1.0;
        // A mean that is not a number is off, too.
        let close = apart.abs() <= tolerance;
        if !close {
            rows[i].fault = Some(format!(
                "{} has {:+.2} % of the light of {}, more than {:.1} % apart",
                rows[i].name,
                100.0 * apart,
                specula.form,
                100.0 * tolerance
            ));
        }
    }
}

/// Of each pair, the first picture of one against the reference of the other.
fn compare_with_others(
    rows: &mut [Row],
    references: &[Rc<Reference>],
    first: &[Vec<Rgb<f32>>],
) -> Result<()> {
    for i in 0..rows.len() {
        let Some(Pair { specula, .. }) = rows[i].against else {
            continue;
        };
        for j in 0..rows.len() {
            if rows[j].form == specula {
                rows[i].rmse_of_other = Some(references[j].errors(&first[i])?.mse.sqrt());
                rows[j].rmse_of_other = Some(references[i].errors(&first[j])?.mse.sqrt());
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::hash::{DefaultHasher, Hash, Hasher};
    use std::path::PathBuf;

    use specula_render::picture::{Metadata, Picture, write_exr};

    use super::super::Clock;
    use super::super::renderers::Timing;
    use super::super::scenes::tests::scene;
    use super::super::statistics::{Errors, Metric};
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("versus-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    /// Paints noise of variance `1 / spp` around a radiance, by a sampler's name:
    ///
    /// - "square" rounds up as Mitsuba's do.
    /// - "bad" has ten times the variance.
    /// - "held up" has half of the variance, but takes ten times the seconds at its first trial.
    /// - "blocks" has a third of the variance, which blocks of 8 x 8 pixels have in common.
    /// - "repeats a fifth" and "repeats half" have so much of the variance from noise that is the same in
    ///   all rounds.
    struct Painter {
        radiance: f32,
        renders: Rc<Cell<u32>>,
    }

    impl Painter {
        fn of(radiance: f32) -> Self {
            Self {
                radiance,
                renders: Rc::default(),
            }
        }

        /// Even in [-1, 1].
        fn even(&self, pixel: u32, seed: u32, spp: u32) -> f64 {
            let words = [pixel, seed, spp, self.radiance.to_bits()];
            let mut hasher = DefaultHasher::new();
            words.hash(&mut hasher);
            let unit = hasher.finish();
            (unit >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    const SIDE: u32 = 128;

    impl Engine for Painter {
        fn render(&mut self, sampler: &str, spp: u32, seed: u32, target: &Path) -> Result<Timing> {
            self.renders.set(self.renders.get() + 1);
            let spp = match sampler {
                "square" => (1..).map(|i| i * i).find(|&s| s >= spp).unwrap(),
                _ => spp,
            };
            let share = match sampler {
                "bad" => 10.0,
                "held up" => 0.5,
                "blocks" => 1.0 / 3.0,
                _ => 1.0,
            };
            let repeated = match sampler {
                "repeats a fifth" if seed < trial::SEED => 0.2,
                "repeats half" if seed < trial::SEED => 0.5,
                _ => 0.0_f64,
            };
            let held_up = sampler == "held up" && seed == trial::SEED;
            let each = if held_up { 0.01 } else { 0.001 };
            // Of variance 1/3 where it is 1.
            let spread = (3.0 * share / f64::from(spp)).sqrt();
            let pixel = |i: u32| {
                let source = match sampler {
                    "blocks" => i / SIDE / 8 * SIDE + i % SIDE / 8,
                    _ => i,
                };
                let own = (1.0 - repeated).sqrt() * self.even(source, seed, spp);
                let again = repeated.sqrt() * self.even(source, 0, spp);
                #[allow(clippy::cast_possible_truncation, reason = "a picture's precision")]
                let noise = (spread * (own + again)) as f32;
                Rgb::splat(self.radiance + noise)
            };
            let picture = Picture::from_colour(SIDE, SIDE, (0..SIDE * SIDE).map(pixel).collect());
            write_exr(target, &picture, &Metadata::default())?;
            Ok(Timing {
                wall: each * f64::from(spp),
                cpu: 2.0 * each * f64::from(spp),
                spp,
            })
        }

        fn version(&self) -> String {
            "painter".to_owned()
        }
    }

    fn outcome_in(folder: &Path, contestants: Vec<Contestant>) -> Outcome {
        let plan = Plan {
            rounds: 3,
            seconds: 0.008,
            reference: 4,
            threads: 2,
            clock: Clock::Wall,
        };
        run(scene(), &plan, contestants, folder, 1).unwrap()
    }

    fn outcome_of(name: &str, contestants: Vec<Contestant>) -> Outcome {
        let folder = scratch(name);
        let outcome = outcome_in(&folder, contestants);
        fs::remove_dir_all(folder).unwrap();
        outcome
    }

    fn outcome(name: &str, radiance: f32, samplers: &[&'static str]) -> Outcome {
        let specula = Contestant::new("specula", &["default"], Painter::of(10.0));
        let theirs = Contestant::new("theirs", samplers, Painter::of(radiance));
        outcome_of(
            name,
            vec![
                specula.in_block(Block::Defaults),
                theirs.against("specula", 0.005),
            ],
        )
    }

    #[test]
    fn errors_are_those_of_the_picture_alone() {
        // Against a reference of four times the samples a quarter would come on top.
        let found = outcome("alone", 10.0, &["plain"]);
        for row in &found.rows {
            assert_eq!((row.spp, row.reference_spp), (8, 32));
            assert_eq!((row.renders.len(), row.pairs.len()), (3, 2));
            for errors in row.renders.iter().map(|r| r.errors) {
                assert!((8.0 * errors.mse - 1.0).abs() < 0.08, "{errors:?}");
            }
            assert!((row.rate - 0.5).abs() < 0.06, "{}", row.rate);
            assert_eq!(row.fault, None);
        }
    }

    #[test]
    fn pairs_of_seeds_and_references_agree_on_white_noise_and_on_blocks() {
        let found = outcome("pairs", 10.0, &["blocks"]);
        for (row, over_rmse) in found.rows.iter().zip([1.0, 8.0]) {
            for errors in row.pairs.iter().map(|p| p.errors) {
                let found = (errors.block_mse / errors.mse).sqrt();
                assert!((found / over_rmse - 1.0).abs() < 0.1, "{errors:?}");
            }
            let agreement = row.agreement(Metric::Rmse);
            let within = if over_rmse > 1.0 { 0.05 } else { 0.01 };
            assert!((agreement - 1.0).abs() < within, "{agreement}");
            // 256 blocks: the noise of a covariance is 6 % of the variance.
            let agreement = row.agreement(Metric::BlockRmse);
            assert!((agreement - 1.0).abs() < 0.08, "{agreement}");
        }
    }

    #[test]
    fn pairs_are_of_consecutive_rounds() {
        let folder = scratch("consecutive");
        let painter = Contestant::new("any", &["plain"], Painter::of(10.0));
        let found = outcome_in(&folder, vec![painter]);
        let rounds = [1, 2, 3].map(|i| colours(&folder.join(format!("any-{i}.exr"))).unwrap().1);
        for (pair, pictures) in found.rows[0].pairs.iter().zip(rounds.windows(2)) {
            let [a, b] = [&*pictures[0], &*pictures[1]];
            let expected = Errors::of_pair(a, [a, b], SIDE as usize).unwrap();
            assert_eq!(pair.errors.mse, expected.mse);
            assert_eq!(pair.errors.block_mse, expected.block_mse);
        }
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn rounds_that_repeat_noise_are_noted_and_those_that_repeat_much_are_a_fault() {
        let found = outcome("fifth", 10.0, &["repeats a fifth"]);
        let row = &found.rows[1];
        let agreement = row.agreement(Metric::Rmse);
        assert!((agreement - 0.8_f64.sqrt()).abs() < 0.02, "{agreement}");
        assert!(row.disagreements().contains(&Metric::Rmse));
        assert_eq!(row.fault, None);
        let found = outcome("half", 10.0, &["repeats half"]);
        let fault = found.rows[1].fault.as_ref().unwrap();
        let told = "theirs: RMSE from pairs of seeds is 0.7";
        assert!(fault.starts_with(told), "{fault}");
    }

    #[test]
    fn blocks_of_specula_have_one_reference_and_equal_pictures_are_rendered_once() {
        let painters = [0; 3].map(|_| Painter::of(10.0));
        let renders = [0, 1, 2].map(|i| painters[i].renders.clone());
        let samplers: [&[&'static str]; 3] = [&["default"], &["bad", "plain"], &["held up"]];
        let mut contestants = Vec::new();
        for ((painter, block), samplers) in painters.into_iter().zip(Block::ALL).zip(samplers) {
            contestants.push(Contestant::new("specula", samplers, painter).in_block(block));
        }
        let found = outcome_of("blocks", contestants);
        let rows = &found.rows;
        let names = ["specula-defaults", "specula-alone", "specula-shared"];
        assert_eq!([0, 1, 2].map(|i| rows[i].name.as_str()), names);
        assert_eq!([0, 1, 2].map(|i| rows[i].same_as), [None, Some(0), None]);
        assert_eq!((rows[1].sampler, rows[1].rate), ("plain", rows[0].rate));
        assert_eq!((rows[1].renders.len(), rows[1].pairs.len()), (3, 2));
        assert_eq!(found.first[1], found.first[0]);
        assert!(Rc::ptr_eq(&found.references[0], &found.references[2]));
        // Two to warm up, a trial, three rounds and one of four times the samples; two to warm up, three for
        // each of two samplers and two halves of the reference.
        assert_eq!([0, 1, 2].map(|i| renders[i].get()), [7, 10, 7]);
    }

    #[test]
    fn pictures_of_another_sampler_are_not_taken_for_the_defaults() {
        let of = |samplers, block| {
            Contestant::new("specula", samplers, Painter::of(10.0)).in_block(block)
        };
        let found = outcome_of(
            "other",
            vec![
                of(&["default"], Block::Defaults),
                of(&["blocks", "bad"], Block::Alone),
            ],
        );
        let [defaults, alone] = [0, 1].map(|i| &found.rows[i]);
        assert_eq!((alone.sampler, alone.same_as), ("blocks", None));
        assert_eq!(alone.spp, defaults.spp);
        assert!(alone.renders[0].errors.mse < 0.5 * defaults.renders[0].errors.mse);
        assert!(alone.renders[0].errors.block_mse > 5.0 * defaults.renders[0].errors.block_mse);
    }

    #[test]
    fn the_best_sampler_makes_the_reference_and_is_charged_with_what_it_took() {
        let found = outcome("sampler", 10.0, &["bad", "square", "bad"]);
        let row = &found.rows[1];
        assert_eq!((row.sampler, row.spp), ("square", 9));
        // Halves of 18, which become 25.
        assert_eq!(row.reference_spp, 50);
        assert!((row.renders[0].seconds - 0.009).abs() < 1e-9);
    }

    #[test]
    fn a_sampler_that_was_held_up_once_is_not_charged_with_it() {
        let found = outcome("held-up", 10.0, &["plain", "held up"]);
        assert_eq!(found.rows[1].sampler, "held up");
    }

    #[test]
    fn samplers_that_are_named_are_all_that_is_left_of_a_renderers() {
        let left = |named: &[&str]| {
            let named: Vec<String> = named.iter().map(ToString::to_string).collect();
            Contestant::new("any", &["plain", "square", "bad"], Painter::of(1.0))
                .among(&named)
                .samplers
        };
        assert_eq!(left(&["bad", "plain", "adaptive"]), ["plain", "bad"]);
        assert_eq!(left(&["adaptive"]), ["plain", "square", "bad"]);
        assert_eq!(left(&[]), ["plain", "square", "bad"]);
    }

    #[test]
    fn a_peer_with_one_per_cent_more_light_is_reported() {
        let found = outcome("brighter", 10.1, &["plain"]);
        let fault = found.rows[1].fault.as_ref().unwrap();
        assert!(fault.contains("theirs has +1.0"), "{fault}");
    }
}
