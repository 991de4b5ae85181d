//! Samplers and treatments of energy against each other on a scene of the user's: every combination
//! renders for the same time, in turns, and is compared with a reference of its treatment. Statements about
//! them follows from intervals: yes, no, or undecided.

mod advice;
mod claims;
mod estimate;
mod interval;
mod reference;
mod results;
mod turns;
mod verdict;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use specula_bsdf::vndf::Sampler;
use specula_render::RenderOptions;
use specula_render::picture::Picture;
use specula_scene::{Energy, Scene};

use crate::runner::{Subject, carry_out};
use crate::{Lab, Progress, Quality, Record, Result, RunOptions, Source, Verdict};

use reference::Reference;
pub(crate) use results::style;
use turns::Entry;

/// Options of a comparison.
pub struct CompareOptions<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its name: part of the name of the folder.
    pub name: &'a str,
    /// Samplers, each once.
    pub samplers: Vec<Sampler>,
    /// Treatments of energy, each once.
    pub energies: Vec<Energy>,
    /// Seconds that each combination renders for; each reference renders for four times as long.
    pub seconds: f64,
    /// The reference; `None`: it is rendered. With one treatment of energy only, as each converges
    /// to a picture of its own.
    pub reference: Option<Picture>,
    /// Depth, size and strategy; sampler, energy and seed are replaced.
    pub render: RenderOptions,
    /// Exposure of pictures for screens, in stops.
    pub exposure_stops: f32,
    /// Of all random numbers.
    pub seed: u64,
    /// For the record.
    pub command: String,
}

/// The record's name for a scene: also that of its folder.
#[must_use]
pub fn id(name: &str) -> String {
    format!("compare-{}", crate::output::comparison::file_name(name))
}

/// Compares; the record and its files go to `folder/ID`, whole or not at all.
///
/// # Errors
///
/// Where the scene cannot be made ready, a file not be written, or the caller asks to stop.
pub fn run(
    options: &CompareOptions<'_>,
    folder: &Path,
    stop: &AtomicBool,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Record> {
    let subject = Subject {
        id: id(options.name),
        source: Source::Specula,
        item: "compare".to_owned(),
        title: format!("samplers and energy on {}", options.name),
        statement: String::new(),
        command: options.command.clone(),
    };
    let effort = RunOptions {
        quality: Quality::Paper,
        seed: options.seed,
    };
    carry_out(subject, effort, folder, stop, progress, |lab| {
        measure(options, lab)
    })
}

fn measure(options: &CompareOptions<'_>, lab: &mut Lab<'_>) -> Result<Verdict> {
    if let Some(reference) = &options.reference {
        reference::check_size(options, reference)?;
    }
    let clock = Clock::new(options);
    let mut references = Vec::new();
    for (i, energy) in options.energies.iter().enumerate() {
        references.push(match &options.reference {
            Some(picture) => Reference::given(picture.clone()),
            None => Reference::render(options, *energy, i, &clock, lab)?,
        });
    }
    let mut entries = Vec::new();
    for (e, &energy) in options.energies.iter().enumerate() {
        for &sampler in &options.samplers {
            entries.push(Entry::new(options, sampler, energy, e, entries.len()));
        }
    }
    turns::take(options, &mut entries, &references, &clock, lab)?;
    let (judged, fields) = estimate::judge(&entries, &references)?;
    results::write(options, &judged, &fields, &references, lab)?;
    Ok(verdict::verdict(options, &judged, &fields, &references))
}

/// How far all of it is, in seconds of rendering.
struct Clock {
    all: f64,
}

impl Clock {
    fn new(options: &CompareOptions<'_>) -> Self {
        let entries = (options.samplers.len() * options.energies.len()) as f64;
        let references = match options.reference {
            Some(_) => 0.0,
            None => reference::TIMES * options.energies.len() as f64,
        };
        Self {
            all: options.seconds * (entries + references),
        }
    }

    fn share(&self, seconds: f64) -> f64 {
        (seconds / self.all).min(1.0)
    }
}
