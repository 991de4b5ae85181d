//! The files of a render: checked before it begins, written when it ends and now and then.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use specula::render::picture::{self, Display, Metadata, Picture, check_writable};
use specula::render::{FilmBuffer, FilmFile, Label};
use specula::scene::atomic;

use super::{Failure, denoise};

/// Where a render goes.
pub(crate) struct Outputs {
    paths: Vec<PathBuf>,
    display: Display,
}

impl Outputs {
    /// Fails where one of the files cannot be written: now, not after an hour.
    pub(crate) fn new(paths: Vec<PathBuf>, display: Display) -> Result<Self, Failure> {
        let mut seen = HashSet::new();
        for path in &paths {
            if !seen.insert(path) {
                return Err(Failure::bad_input(format_args!(
                    "output '{}' is given twice",
                    path.display()
                )));
            }
            check_writable(path)
                .map_err(|e| Failure::other(format_args!("cannot write the picture: {e}")))?;
        }
        if paths.iter().filter(|p| is_film(p)).count() > 1 {
            return Err(Failure::bad_input("more than one .film is asked for"));
        }
        Ok(Self { paths, display })
    }

    /// The film that was asked for.
    pub(crate) fn film(&self) -> Option<&Path> {
        self.paths.iter().find(|p| is_film(p)).map(PathBuf::as_path)
    }

    /// Where the film of a render is kept: the one asked for, or one beside the first file.
    pub(crate) fn checkpoint(&self) -> PathBuf {
        match (self.film(), self.paths.first()) {
            (Some(film), _) => film.to_owned(),
            (None, Some(first)) => first.with_extension("film"),
            (None, None) => PathBuf::from("render.film"),
        }
    }

    /// Removes what a render that was killed left half-written.
    pub(crate) fn sweep(&self) {
        for path in self.paths.iter().chain([&self.checkpoint()]) {
            if let Err(e) = atomic::sweep(path) {
                let name = path.display();
                eprintln!("warning: cannot remove what was left half-written of '{name}': {e}");
            }
        }
    }

    /// Writes every picture, denoised where that is asked for, and says where values were not finite.
    pub(crate) fn write_pictures(
        &self,
        film: &FilmBuffer,
        label: &Label,
        seed: Option<u32>,
        denoised: bool,
    ) -> Result<(), Failure> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "for people: the nearest number is near enough, and none is below 0"
        )]
        let (seconds, samples) = (
            label.seconds as f32,
            film.most_and_mean_samples().1.round() as u32,
        );
        let metadata = Metadata {
            software: Some(format!("specula {}", label.version)),
            scene: Some(label.scene.clone()),
            samples_per_pixel: Some(samples),
            seed,
            render_seconds: Some(seconds),
        };
        let mut picture = film.picture();
        if denoised {
            denoise::denoise(&mut picture)?;
        }
        self.write(&picture, &metadata)
    }

    /// Writes a picture to every file that is no film.
    pub(crate) fn write(&self, picture: &Picture, metadata: &Metadata) -> Result<(), Failure> {
        let mut replaced = 0;
        for path in self.paths.iter().filter(|p| !is_film(p)) {
            let written = if has_extension(path, "png") {
                picture::write_png(path, picture, self.display)
            } else {
                picture::write_exr(path, picture, metadata)
            };
            let count = written
                .map_err(|e| Failure::other(format_args!("cannot write the picture: {e}")))?;
            replaced = replaced.max(count);
        }
        if replaced > 0 {
            eprintln!("warning: {replaced} values were not finite and are written as 0");
        }
        Ok(())
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
        names.join(" and ")
    }
}

fn is_film(path: &Path) -> bool {
    has_extension(path, "film")
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case(extension))
}
