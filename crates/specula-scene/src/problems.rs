//! Errors while a scene is read: they go back to the caller, or into a report.

use std::cell::RefCell;
use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::rc::Rc;

use specula_bsdf::Rgb;

use crate::Loaded;
use crate::error::{Place, SceneError, Warning};
use crate::image::Image;
use crate::missing::{Missing, MissingList};
use crate::scene::{ColourParam, Light};

/// Most errors, and most warnings and notes, that a report lists.
pub(crate) const MOST: usize = 100;

/// The sink of a scene's errors, shared by all that reads the scene.
///
/// In an ordinary load, which is the default, the first error goes back to the caller, but for those
/// about missing files, which wait for the end. In a check errors are recorded, and reading goes on with
/// a neutral stand-in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Problems {
    collected: Option<Rc<RefCell<CollectedProblems>>>,
    missing: MissingList,
}

/// What a check has found.
#[derive(Debug, Default)]
pub(crate) struct CollectedProblems {
    pub(crate) errors: Vec<SceneError>,
    /// Errors beyond the first [`MOST`].
    pub(crate) more_errors: usize,
    pub(crate) notes: Vec<Note>,
    /// Warnings of a scene that could not be put together.
    pub(crate) warnings: Vec<Warning>,
    /// Hashes of place and message of the errors so far: a name that many things refer to is
    /// reported missing once.
    seen: HashSet<u64>,
}

/// Something that is not a mistake but may surprise.
#[derive(Clone, Debug)]
pub(crate) struct Note {
    pub(crate) kind: NoteKind,
    pub(crate) message: String,
    pub(crate) place: Place,
}

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoteKind {
    /// A definition that nothing refers to.
    Unused,
    /// A light that emits nothing.
    Dark,
}

impl Problems {
    /// A sink of an ordinary load.
    pub(crate) fn loading(missing: Missing) -> Self {
        Self {
            collected: None,
            missing: MissingList::new(missing),
        }
    }

    /// A sink that records errors.
    pub(crate) fn collecting(missing: Missing) -> Self {
        Self {
            collected: Some(Rc::default()),
            missing: MissingList::new(missing),
        }
    }

    /// What was read, with stand-ins for missing files; or the error about these.
    pub(crate) fn settled(&self, loaded: Result<Loaded, SceneError>) -> Result<Loaded, SceneError> {
        let (loaded, mut warnings) = self.missing.settled(loaded);
        self.record_warnings(&mut warnings);
        loaded
    }

    /// Whether errors are recorded.
    pub(crate) fn is_check(&self) -> bool {
        self.collected.is_some()
    }

    /// Whether an error was recorded.
    pub(crate) fn has_errors(&self) -> bool {
        self.collected
            .as_ref()
            .is_some_and(|k| !k.borrow().errors.is_empty())
    }

    /// Whether a report would list no further error.
    pub(crate) fn is_full(&self) -> bool {
        self.collected
            .as_ref()
            .is_some_and(|k| k.borrow().errors.len() >= MOST)
    }

    /// Records an error.
    ///
    /// # Errors
    ///
    /// The error itself, in an ordinary load.
    pub(crate) fn record(&self, error: SceneError) -> Result<(), SceneError> {
        let Err(error) = self.missing.take(error, self.is_check()) else {
            return Ok(());
        };
        let Some(collected) = &self.collected else {
            return Err(error);
        };
        let mut collected = collected.borrow_mut();
        let mut hasher = DefaultHasher::new();
        (error.file(), error.place().offset(), error.message()).hash(&mut hasher);
        if !collected.seen.insert(hasher.finish()) {
            return Ok(());
        }
        if collected.errors.len() < MOST {
            collected.errors.push(error);
        } else {
            collected.more_errors += 1;
        }
        Ok(())
    }

    /// What was read, or a stand-in where its error is recorded.
    ///
    /// # Errors
    ///
    /// That of `read`, in an ordinary load.
    pub(crate) fn or<T>(
        &self,
        read: Result<T, SceneError>,
        stand_in: impl FnOnce() -> T,
    ) -> Result<T, SceneError> {
        match read {
            Ok(value) => Ok(value),
            Err(error) => {
                self.record(error)?;
                Ok(stand_in())
            }
        }
    }

    /// Records a note; an ordinary load ignores it.
    pub(crate) fn note(&self, kind: NoteKind, place: &Place, message: impl FnOnce() -> String) {
        if let Some(collected) = &self.collected {
            let note = Note {
                kind,
                message: message(),
                place: place.clone(),
            };
            collected.borrow_mut().notes.push(note);
        }
    }

    /// Records the warnings of a reader that ends in an error; an ordinary load ignores them.
    pub(crate) fn record_warnings(&self, warnings: &mut Vec<Warning>) {
        if let Some(collected) = &self.collected {
            collected.borrow_mut().warnings.append(warnings);
        }
    }

    /// All that was recorded; the sink is empty after it.
    pub(crate) fn take(&self) -> CollectedProblems {
        self.collected
            .as_ref()
            .map_or_else(CollectedProblems::default, |k| k.borrow_mut().take())
    }
}

impl CollectedProblems {
    fn take(&mut self) -> Self {
        std::mem::take(self)
    }
}

/// Whether a light emits nothing.
pub(crate) fn is_dark(light: &Light, images: &[Image]) -> bool {
    let (colour, picture) = match light {
        Light::Infinite {
            radiance, image, ..
        }
        | Light::Portal {
            radiance, image, ..
        } => (*radiance, *image),
        Light::Distant { irradiance, .. } => (*irradiance, None),
        Light::Point { intensity, .. } | Light::Spot { intensity, .. } => (*intensity, None),
        Light::Picture { intensity, .. } => match intensity {
            ColourParam::Value(colour) => (*colour, None),
            ColourParam::Texture(_) => (Rgb::WHITE, None),
        },
    };
    let is_black = |id: usize| {
        let image = images.get(id);
        image.is_some_and(|image| image.pixels.position(|v| v != 0.0).is_none())
    };
    colour == Rgb::BLACK || picture.is_some_and(|(id, _)| is_black(id.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::{ErrorKind, SourceText};

    fn error(offset: usize) -> SceneError {
        let place = Place::new(&SourceText::new("a", "text"), offset, 1);
        SceneError::new(ErrorKind::Syntax, &place, "wrong")
    }

    #[test]
    fn a_load_ends_with_the_first_error_and_a_check_keeps_all_once() {
        let load = Problems::default();
        assert!(load.or(Err(error(0)), || 7).is_err());
        assert!(!load.has_errors());
        let check = Problems::collecting(Missing::Refuse);
        for offset in [0, 1, 0] {
            assert_eq!(check.or(Err(error(offset)), || 7).unwrap(), 7);
        }
        assert!(check.has_errors());
        for offset in 2..MOST + 5 {
            check.record(error(offset)).unwrap();
        }
        let collected = check.take();
        assert_eq!((collected.errors.len(), collected.more_errors), (MOST, 5));
        assert!(!check.has_errors());
    }
}
