//! The files of a render: checked before it begins, written when it ends and now and then.

use std::collections::HashSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::render::picture::{self, Metadata, Picture, check_writable};
use crate::render::{FilmBuffer, FilmFile, Label};
use crate::scene::atomic;

use super::console::say;
use super::display::DisplayChoice;
use super::file_id::{FileId, Inputs};
use super::lock::Lock;
use super::{Failure, denoise};

/// Where a render goes.
pub(crate) struct Outputs {
    paths: Vec<PathBuf>,
    display: DisplayChoice,
    /// Stops of the last PNG file whose exposure was found from what it shows; NaN where there was none.
    exposure: AtomicU32,
    /// Held while the files may be written.
    locks: Vec<Lock>,
}

impl Outputs {
    /// Fails where one of the files cannot be written, is one of `inputs`, or is being written by another
    /// program: now, not after an hour.
    pub(crate) fn new(
        paths: Vec<PathBuf>,
        display: DisplayChoice,
        inputs: &Inputs,
    ) -> Result<Self, Failure> {
        let mut seen = HashSet::new();
        for path in &paths {
            refuse_input(path, inputs)?;
            check_writable(path)
                .map_err(|e| Failure::other(format_args!("cannot write the picture: {e}")))?;
            if !seen.insert(place(path)) {
                return Err(Failure::bad_input(format_args!(
                    "output '{}' is given twice",
                    path.display()
                )));
            }
        }
        if paths.iter().filter(|p| is_film(p)).count() > 1 {
            return Err(Failure::bad_input("more than one .film is asked for"));
        }
        let locks = (paths.iter().map(|path| Lock::hold(path))).collect::<Result<_, _>>()?;
        Ok(Self {
            paths,
            display,
            exposure: AtomicU32::new(f32::NAN.to_bits()),
            locks,
        })
    }

    /// The film that was asked for.
    pub(crate) fn film(&self) -> Option<&Path> {
        self.paths.iter().find(|p| is_film(p)).map(PathBuf::as_path)
    }

    /// Where the film of a render is saved: the one asked for, or one beside the first file.
    pub(crate) fn checkpoint(&self) -> PathBuf {
        match (self.film(), self.paths.first()) {
            (Some(film), _) => film.to_owned(),
            (None, Some(first)) => first.with_extension("film"),
            (None, None) => PathBuf::from("render.film"),
        }
    }

    /// Claims the checkpoint, too, where it is a file of its own.
    pub(crate) fn claim_checkpoint(&mut self, inputs: &Inputs) -> Result<(), Failure> {
        let path = self.checkpoint();
        refuse_input(&path, inputs)?;
        if self.film().is_none() {
            self.locks.push(Lock::hold(&path)?);
        }
        Ok(())
    }

    /// Removes what a render that was killed left half-written.
    pub(crate) fn sweep(&self) {
        for path in self.paths.iter().chain([&self.checkpoint()]) {
            if let Err(e) = atomic::sweep(path) {
                let name = path.display();
                say!("warning: cannot remove what was left half-written of '{name}': {e}");
            }
        }
    }

    /// Writes every picture, denoised where that is asked for, and says where values were not finite.
    ///
    /// # Errors
    ///
    /// What could not be written or denoised; all else is written.
    pub(crate) fn write_pictures(
        &self,
        film: &FilmBuffer,
        metadata: &Metadata,
        denoised: bool,
    ) -> Result<(), Failure> {
        let mut picture = film.picture();
        let smooth = match denoised {
            true => denoise::denoise(&mut picture),
            false => Ok(()),
        };
        let written = self.write(&picture, metadata);
        smooth.and(written)
    }

    /// Writes a picture to every file that is no film.
    ///
    /// # Errors
    ///
    /// The files that could not be written; all others are.
    pub(crate) fn write(&self, picture: &Picture, metadata: &Metadata) -> Result<(), Failure> {
        let mut replaced = 0;
        let mut faults = Vec::new();
        for path in self.paths.iter().filter(|p| !is_film(p)) {
            let written = if has_extension(path, "png") {
                let display = self.display.of(&picture.colour);
                if self.display.is_automatic() {
                    let stops = display.exposure_stops.to_bits();
                    self.exposure.store(stops, Ordering::Relaxed);
                }
                picture::write_png(path, picture, display)
            } else {
                picture::write_exr(path, picture, metadata)
            };
            match written {
                Ok(count) => replaced = replaced.max(count),
                Err(e) => faults.push(format!("cannot write the picture: {e}")),
            }
        }
        if replaced > 0 {
            say!("warning: {replaced} values were not finite and are written as 0");
        }
        match &faults[..] {
            [] => Ok(()),
            _ => Err(Failure::other(faults.join("\n"))),
        }
    }

    /// Writes the film that was asked for.
    pub(crate) fn write_film(&self, film: &FilmBuffer, label: &Label) -> Result<(), Failure> {
        let Some(path) = self.film() else {
            return Ok(());
        };
        FilmFile::write(path, label, film)
            .map_err(|e| Failure::other(format_args!("cannot write '{}': {e}", path.display())))
    }

    /// The files, for messages.
    pub(crate) fn names(&self) -> String {
        let names: Vec<String> = self.paths.iter().map(|p| p.display().to_string()).collect();
        let stops = f32::from_bits(self.exposure.load(Ordering::Relaxed));
        match stops.is_nan() {
            true => names.join(" and "),
            false => format!("{} (--exposure {stops:.2})", names.join(" and ")),
        }
    }
}

/// What a picture's file says about it.
pub(crate) fn metadata(film: &FilmBuffer, label: &Label, seed: Option<u32>) -> Metadata {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "for people: the nearest number is near enough, and none is below 0"
    )]
    let (seconds, samples) = (
        label.seconds as f32,
        film.most_and_mean_samples().1.round() as u32,
    );
    Metadata {
        software: Some(format!("specula {}", label.version)),
        scene: Some(label.scene.clone()),
        samples_per_pixel: Some(samples),
        seed,
        render_seconds: Some(seconds),
        bias: label.bias().map(str::to_owned),
        missing: label.missing().map(str::to_owned),
    }
}

/// Fails where an output is a file that was read.
pub(crate) fn refuse_input(output: &Path, inputs: &Inputs) -> Result<(), Failure> {
    let Some(input) = inputs.same_as(output) else {
        return Ok(());
    };
    let also = match input == output {
        true => String::new(),
        false => format!(" as '{}'", input.display()),
    };
    Err(Failure::bad_input(format_args!(
        "'{}' would be written over: it was read{also}. Name another output",
        output.display()
    )))
}

/// Names for the pictures of a scene in the current folder; where one of them is a file that the scene
/// reads, others, with a note.
///
/// * `ends`: extensions of the files.
pub(crate) fn default_names(scene: &str, ends: &[&str], inputs: &Inputs) -> Vec<PathBuf> {
    // Appended: with_extension would cut `a.b` down to `a`.
    let named = |name: &str| -> Vec<PathBuf> {
        let of = |end: &&str| PathBuf::from(format!("{name}.{end}"));
        ends.iter().map(of).collect()
    };
    let read = |paths: &[PathBuf]| {
        let with_checkpoint = paths.iter().cloned();
        let checkpoint = paths.first().map(|p| p.with_extension("film"));
        let mut all = with_checkpoint.chain(checkpoint);
        all.find(|p| inputs.same_as(p).is_some())
    };
    let plain = named(scene);
    let Some(taken) = read(&plain) else {
        return plain;
    };
    let others = std::iter::once(format!("{scene}-render"))
        .chain((2..).map(|i| format!("{scene}-render{i}")));
    let mut free = others.map(|name| named(&name));
    let names = free.find(|names| read(names).is_none()).unwrap_or(plain);
    let list: Vec<String> = names.iter().map(|p| p.display().to_string()).collect();
    say!(
        "note: the scene reads '{}', so the render goes to {}",
        taken.display(),
        list.join(" and ")
    );
    names
}

/// Where a file lies, by whatever name its folder is called.
fn place(path: &Path) -> (Result<FileId, PathBuf>, PathBuf) {
    let (folder, name) = (path.parent(), path.file_name());
    let folder = match folder {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    };
    let id = FileId::of(folder).map_err(|_: io::Error| folder.to_owned());
    (id, name.unwrap_or_default().into())
}

/// Whether a name is that of a film.
pub(crate) fn is_film(path: &Path) -> bool {
    has_extension(path, "film")
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case(extension))
}
