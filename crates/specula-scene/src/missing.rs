//! Files that a scene names and that do not exist: all of them in one report, or stand-ins for them.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::rc::Rc;

use crate::Loaded;
use crate::error::{ErrorKind, MissingFile, SceneError, Warning};
use crate::scene::{Bump, FloatParam, Scene, Texture, TextureId};

/// Most missing files that one message lists.
const MOST: usize = 1000;

/// What is done about files that a scene names and that do not exist.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Missing {
    /// The scene is not read; one error lists them all.
    #[default]
    Refuse,
    /// Reading goes on: a grey checker stands in for a picture, a mesh is left out, a file that is
    /// included is empty, other files leave what they describe at its default. Warnings list them, and
    /// names that are defined nowhere are then no errors either.
    StandIn,
}

/// What a missing file holds.
fn what(file: &MissingFile) -> &'static str {
    match file.kind() {
        ErrorKind::Image => "picture",
        ErrorKind::Mesh => "mesh",
        ErrorKind::Spectrum => "spectrum",
        ErrorKind::Measured => "measured material",
        _ => "file",
    }
}

/// The warning about what is rendered instead of a missing file.
fn warning(file: &MissingFile) -> Warning {
    let instead = match file.kind() {
        ErrorKind::Image => "a grey checker stands in for it",
        ErrorKind::Mesh => "its shapes are left out",
        ErrorKind::Spectrum => "the default stands in for it",
        ErrorKind::Measured => "diffuse grey of 0.5 stands in for it",
        _ => "what it holds is left out",
    };
    let path = file.path().display();
    let message = format!("{} {path} is missing: {instead}", what(file));
    Warning::new(file.place(), message)
}

/// The missing files of a scene so far, shared by all that reads it.
#[derive(Clone, Debug, Default)]
pub(crate) struct MissingList(Rc<RefCell<Found>>);

#[derive(Debug, Default)]
struct Found {
    policy: Missing,
    files: Vec<MissingFile>,
    paths: HashSet<PathBuf>,
    /// The first error, for its words.
    first: Option<SceneError>,
    /// Names that a missing file may have defined.
    names: Vec<Warning>,
}

impl MissingList {
    pub(crate) fn new(policy: Missing) -> Self {
        Self(Rc::new(RefCell::new(Found {
            policy,
            ..Found::default()
        })))
    }

    /// Takes an error that is about a missing file, so that reading goes on; others come back.
    ///
    /// * `collects`: whether errors are collected anyway, as a check does.
    pub(crate) fn take(&self, error: SceneError, collects: bool) -> Result<(), SceneError> {
        let mut found = self.0.borrow_mut();
        let stands_in = found.policy == Missing::StandIn;
        match error.missing() {
            [file] if stands_in || !collects => {
                if found.paths.insert(file.path().to_owned()) {
                    found.files.push(file.clone());
                }
                found.first.get_or_insert(error);
                Ok(())
            }
            [] if stands_in && error.kind() == ErrorKind::UnknownName && found.loses_names() => {
                let message = format!("{}: a missing file may have it", error.message());
                let is_told = found.names.iter().any(|w| w.message() == message);
                if !is_told {
                    found.names.push(Warning::new(error.place(), message));
                }
                Ok(())
            }
            // The report of missing files comes before what may follow from them.
            [] if !stands_in && !collects && found.first.is_some() => match error.kind() {
                ErrorKind::Limit => Err(error),
                _ => Ok(()),
            },
            _ => Err(error),
        }
    }

    /// The scene with what stands in for missing files, or the one error about them all.
    ///
    /// * Returns: beside it, the warnings where the scene has other errors.
    pub(crate) fn settled(
        &self,
        loaded: Result<Loaded, SceneError>,
    ) -> (Result<Loaded, SceneError>, Vec<Warning>) {
        let found = std::mem::take(&mut *self.0.borrow_mut());
        let Some(first) = found.first else {
            return (loaded, Vec::new());
        };
        if found.policy == Missing::Refuse {
            return (Err(report(first, found.files)), Vec::new());
        }
        let mut warnings: Vec<Warning> = found.files.iter().map(warning).collect();
        warnings.extend(found.names);
        match loaded {
            Ok(mut loaded) => {
                smooth(&mut loaded.scene);
                loaded.warnings.splice(0..0, warnings);
                loaded.missing = found.files.iter().map(|f| f.path().to_owned()).collect();
                (Ok(loaded), Vec::new())
            }
            Err(error) => (Err(error), warnings),
        }
    }
}

impl Found {
    /// Whether a file is missing that may define names: one that is included.
    fn loses_names(&self) -> bool {
        self.files.iter().any(|f| f.kind() == ErrorKind::Io)
    }
}

/// One error for all missing files.
fn report(first: SceneError, mut files: Vec<MissingFile>) -> SceneError {
    if files.len() < 2 {
        return first;
    }
    // Files in the order in which they were met, places from the top down.
    let mut order: HashMap<String, usize> = HashMap::new();
    for file in &files {
        let next = order.len();
        order
            .entry(file.place().source().name().to_owned())
            .or_insert(next);
    }
    files.sort_by_key(|f| {
        (
            order.get(f.place().source().name()).copied(),
            f.place().offset(),
        )
    });
    let place = files[0].place().clone();
    let mut message = format!("{} files that the scene names are missing:", files.len());
    for file in files.iter().take(MOST) {
        message += &format!(
            "\n{}: {} {}",
            file.place(),
            what(file),
            file.path().display()
        );
    }
    if let Some(more) = files.len().checked_sub(MOST).filter(|n| *n > 0) {
        message += &format!("\nand {more} more");
    }
    let error = SceneError::new(first.kind(), &place, message);
    error
        .with_hint(first.help().map(str::to_owned))
        .with_missing(files)
}

/// Takes the checkers of missing pictures from where they would be no colours: surfaces stay smooth and
/// opaque.
fn smooth(scene: &mut Scene) {
    let stands_in = |id: TextureId| match scene.textures.get(id.0) {
        Some(Texture::Image { image, .. }) => scene
            .images
            .get(image.0)
            .is_some_and(|i| i.name == crate::image::STAND_IN),
        _ => false,
    };
    for material in &mut scene.materials {
        let map = match material.bump {
            Some(Bump::Normal { map, .. } | Bump::Height(FloatParam::Texture(map))) => map,
            _ => continue,
        };
        if stands_in(map) {
            material.bump = None;
        }
    }
    let in_objects = scene.objects.iter_mut().flat_map(|o| &mut o.shapes);
    for shape in in_objects.chain(&mut scene.shapes) {
        if let FloatParam::Texture(id) = shape.alpha
            && stands_in(id)
        {
            shape.alpha = FloatParam::Value(1.0);
        }
    }
}
