//! The film of a render on disk, so that no work is lost: written now and then, resumed from.

use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::render::{FilmBuffer, FilmFile, FilmFileError, Label};

use super::Failure;
use super::console::say;

/// Writing takes at most this share of the time.
const LARGEST_SHARE: f64 = 0.05;

/// What to do about a film that is there already.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    /// Refuse: it holds somebody's work.
    New,
    /// Go on with it.
    Resume,
    /// Go on with a film that is elsewhere.
    ResumeFrom(PathBuf),
    /// Replace it.
    Restart,
}

impl Start {
    /// Whether the film that it goes on with is adaptive; `None` where there is none, or one that cannot be read.
    ///
    /// * `beside`: the checkpoint beside the output.
    pub(crate) fn is_adaptive(&self, beside: &Path) -> Option<bool> {
        let path = match self {
            Self::New | Self::Restart => return None,
            Self::Resume => beside,
            Self::ResumeFrom(path) => path,
        };
        let film = FilmFile::read(path).ok()?.film;
        (film.complete_samples() > 0).then(|| film.is_adaptive())
    }
}

/// The checkpoint of a render: the file that its film is saved in.
pub(crate) struct Checkpoint {
    path: PathBuf,
    label: Label,
    /// `None`: never written.
    every: Option<Duration>,
    /// Whether the film is one of the files that were asked for.
    asked_for: bool,
    saved: Instant,
    cost: Duration,
    failed: bool,
    /// Whether it is a share of a round, which the film that it goes on with is no part of.
    is_share: bool,
}

impl Checkpoint {
    /// A film at `path`.
    ///
    /// * `every`: between two writes; `None`: none at all.
    /// * `asked_for`: it stays when the render is done.
    pub(crate) fn new(
        path: PathBuf,
        label: Label,
        every: Option<Duration>,
        asked_for: bool,
    ) -> Self {
        Self {
            path,
            label,
            every,
            asked_for,
            saved: Instant::now(),
            cost: Duration::ZERO,
            failed: false,
            is_share: false,
        }
    }

    /// The film to begin with; `None`: an empty one.
    ///
    /// Fails where the file holds another render, or an unfinished one and `start` does not say what
    /// to do with it.
    pub(crate) fn open(&mut self, start: &Start) -> Result<Option<FilmBuffer>, Failure> {
        let (path, must_be_there) = match start {
            Start::ResumeFrom(path) => (path.clone(), true),
            _ => (self.path.clone(), false),
        };
        let name = path.display();
        let FilmFile { label, film } = match FilmFile::read(&path) {
            Ok(file) => file,
            Err(FilmFileError::Io(e)) if e.kind() == io::ErrorKind::NotFound && !must_be_there => {
                return Ok(None);
            }
            Err(FilmFileError::Damaged | FilmFileError::Format(_)) if *start == Start::Restart => {
                return Ok(None);
            }
            Err(e) => {
                return Err(Failure::bad_input(format_args!(
                    "the checkpoint '{name}' cannot be read: {e}"
                )));
            }
        };
        match start {
            Start::Restart => return Ok(None),
            Start::New => {
                return Err(Failure::bad_input(format_args!(
                    "'{name}' holds a render of {}: {} samples per pixel.\n\
                     --resume goes on with it, --restart begins anew and replaces it",
                    label.scene,
                    film.complete_samples()
                )));
            }
            Start::Resume => {}
            Start::ResumeFrom(_) => self.refuse_other_work(film.complete_samples())?,
        }
        if let Some(difference) = self.label.difference(&label) {
            return Err(Failure::bad_input(format_args!(
                "cannot go on with the checkpoint '{name}': {difference}.\n\
                 --restart begins anew and replaces it"
            )));
        }
        if !self.is_share {
            self.label.seconds = label.seconds;
        }
        Ok(Some(film))
    }

    /// Fails where the film beside the output is of another render, or is farther than one that has so many
    /// samples per pixel: it would be replaced.
    fn refuse_other_work(&self, samples: u32) -> Result<(), Failure> {
        let beside = match FilmFile::read(&self.path) {
            Err(FilmFileError::Io(e)) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
            other => other,
        };
        let is_older = beside.is_ok_and(|file| {
            let same = self.label.difference(&file.label).is_none();
            same && file.film.complete_samples() <= samples
        });
        if is_older {
            return Ok(());
        }
        Err(Failure::bad_input(format_args!(
            "'{}' holds another render, which this one would replace: move it, or name another output",
            self.path.display()
        )))
    }

    /// Of a share of a round, only its own time counts: that of the film before it is in that film.
    pub(crate) fn leave_earlier_time_out(&mut self) {
        self.is_share = true;
    }

    /// Whether it is time to write.
    pub(crate) fn is_due(&self) -> bool {
        let rest = self.cost.mul_f64(1.0 / LARGEST_SHARE);
        self.every
            .is_some_and(|every| self.saved.elapsed() >= every.max(rest))
    }

    /// Writes the film. A render goes on where that fails: there may be space again next time.
    ///
    /// * `seconds`: of this run.
    pub(crate) fn save(&mut self, film: &FilmBuffer, seconds: f64) {
        if self.every.is_none() && !self.asked_for {
            return;
        }
        let start = Instant::now();
        let label = self.label(seconds);
        let written = FilmFile::write(&self.path, &label, film);
        self.cost = start.elapsed();
        self.saved = Instant::now();
        match written {
            Ok(()) => self.failed = false,
            Err(e) => {
                if !self.failed {
                    let name = self.path.display();
                    say!("warning: cannot write the checkpoint '{name}': {e}");
                }
                self.failed = true;
            }
        }
    }

    /// The render is done: the film goes, unless it was asked for.
    ///
    /// # Errors
    ///
    /// Where a film that was asked for cannot be written.
    pub(crate) fn finish(&mut self, film: &FilmBuffer, seconds: f64) -> Result<(), Failure> {
        if self.asked_for {
            self.save(film, seconds);
            if self.failed {
                let name = self.path.display();
                return Err(Failure::other(format_args!("cannot write '{name}'")));
            }
            return Ok(());
        }
        match std::fs::remove_file(&self.path) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => {
                let name = self.path.display();
                say!("warning: cannot remove the checkpoint '{name}': {e}");
            }
            _ => {}
        }
        Ok(())
    }

    /// Writes the film where there is room, as its pictures cannot be written: in its place, else into the
    /// folder for temporary files. Returns what to say about it.
    ///
    /// * `seconds`: of this run.
    pub(crate) fn rescue(&self, film: &FilmBuffer, seconds: f64) -> String {
        let label = self.label(seconds);
        let Err(first) = FilmFile::write(&self.path, &label, film) else {
            return format!(
                "the samples are saved in '{}': --resume goes on from there",
                self.path.display()
            );
        };
        let elsewhere = tempfile::Builder::new()
            .prefix("specula-")
            .suffix(".film")
            .tempfile()
            .and_then(|file| Ok(file.keep()?.1));
        let path = match elsewhere {
            Ok(path) => path,
            Err(second) => return format!("the samples are lost: {first}; {second}"),
        };
        let name = path.display();
        match FilmFile::write(&path, &label, film) {
            Ok(()) => {
                format!("the samples are saved in '{name}': --resume={name} goes on from there")
            }
            Err(second) => {
                let _ = std::fs::remove_file(&path);
                format!("the samples are lost: {first}; {second}")
            }
        }
    }

    /// What the film belongs to, with the time of earlier runs and `seconds` of this one.
    pub(crate) fn label(&self, seconds: f64) -> Label {
        Label {
            seconds: self.label.seconds + seconds,
            ..self.label.clone()
        }
    }

    /// The file, where it is written at all.
    pub(crate) fn path(&self) -> Option<&Path> {
        (self.every.is_some() || self.asked_for).then_some(&self.path)
    }
}
