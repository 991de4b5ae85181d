//! What an experiment is given: its quality and seed, and where to put what it finds.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::output::comparison::WrittenComparison;
use crate::output::record::WrittenPlot;
use crate::output::{Comparison, Table};
use crate::plot::Figure;
use crate::{LabError, Quality, Rendered, Result};
use specula_render::RenderOptions;
use specula_scene::Scene;

/// Where an experiment is.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Share done, in `[0, 1]`.
    pub share: f64,
    /// What is being done.
    pub what: String,
}

/// An experiment's desk.
pub struct Lab<'a> {
    quality: Quality,
    seed: u64,
    folder: PathBuf,
    stop: &'a AtomicBool,
    progress: &'a (dyn Fn(Progress) + Sync),
    pub(crate) tables: Vec<Table>,
    pub(crate) plots: Vec<WrittenPlot>,
    pub(crate) comparisons: Vec<WrittenComparison>,
}

impl<'a> Lab<'a> {
    /// A desk whose files go to `folder`, which must be there.
    pub fn new(
        quality: Quality,
        seed: u64,
        folder: &Path,
        stop: &'a AtomicBool,
        progress: &'a (dyn Fn(Progress) + Sync),
    ) -> Self {
        Self {
            quality,
            seed,
            folder: folder.to_owned(),
            stop,
            progress,
            tables: Vec::new(),
            plots: Vec::new(),
            comparisons: Vec::new(),
        }
    }

    /// How much work is asked for.
    #[must_use]
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// The one of the two that the quality asks for.
    #[must_use]
    pub fn pick<T>(&self, draft: T, paper: T) -> T {
        match self.quality {
            Quality::Draft => draft,
            Quality::Paper => paper,
        }
    }

    /// Of all random numbers.
    #[must_use]
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// [`Lab::seed`] for renders.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the low bits will do")]
    pub fn render_seed(&self) -> u32 {
        self.seed as u32
    }

    /// Says how far it is, and ends the experiment where the caller asks to stop. Call it often.
    ///
    /// # Errors
    ///
    /// [`LabError::Stopped`].
    pub fn step(&self, share: f64, what: &str) -> Result<()> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(LabError::Stopped);
        }
        (self.progress)(Progress {
            share,
            what: what.to_owned(),
        });
        Ok(())
    }

    /// What says that the caller asks to stop.
    #[must_use]
    pub fn stop(&self) -> &'a AtomicBool {
        self.stop
    }

    /// Renders a scene.
    ///
    /// # Errors
    ///
    /// Those of [`crate::render()`].
    pub fn render(&self, scene: &Scene, options: &RenderOptions) -> Result<Rendered> {
        crate::render(scene, options, self.stop)
    }

    /// Writes a table as CSV, and keeps it for the record.
    ///
    /// # Errors
    ///
    /// Where the file cannot be written.
    pub fn table(&mut self, table: Table) -> Result<()> {
        table.write_csv(&self.folder.join(format!("{}.csv", table.name)))?;
        self.tables.push(table);
        Ok(())
    }

    /// Writes a plot as SVG and PNG.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written.
    pub fn plot(&mut self, name: &str, caption: &str, figure: &Figure) -> Result<()> {
        let written = figure.write(&self.folder, name, caption)?;
        self.plots.push(written);
        Ok(())
    }

    /// Writes pictures beside each other; returns what was found of them.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written.
    pub fn comparison(&mut self, comparison: &Comparison<'_>) -> Result<WrittenComparison> {
        let written = comparison.write(&self.folder)?;
        self.comparisons.push(written.clone());
        Ok(written)
    }
}
