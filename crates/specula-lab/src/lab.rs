//! The interface of an experiment to its run: quality, seed, and output of results.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use crate::output::comparison::WrittenComparison;
use crate::output::{PictureComparison, Table};
use crate::plot::Figure;
use crate::plot::WrittenPlot;
use crate::{LabError, Quality, Rendered, Result};
use specula_render::RenderOptions;
use specula_scene::Scene;

/// The progress of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Share done, in `[0, 1]`.
    pub share: f64,
    /// What is being done.
    pub what: String,
}

/// Quality, seed and output of a running experiment.
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
    /// A run that writes to `folder`, which must exist.
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

    /// How much work to do.
    #[must_use]
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// The value for the quality of this run.
    #[must_use]
    pub fn pick<T>(&self, draft: T, paper: T) -> T {
        match self.quality {
            Quality::Draft => draft,
            Quality::Paper => paper,
        }
    }

    /// The seed of all random numbers.
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

    /// Reports progress, and ends the experiment where the caller asks to stop. Call it often.
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

    /// Whether the caller asks to stop.
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

    /// Writes a table as CSV, and stores it for the record.
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

    /// Writes pictures beside each other; returns their files and errors.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written.
    pub fn comparison(&mut self, comparison: &PictureComparison<'_>) -> Result<WrittenComparison> {
        let written = comparison.write(&self.folder)?;
        self.comparisons.push(written.clone());
        Ok(written)
    }
}
