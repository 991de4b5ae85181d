//! What the server asks of the library beside answers.

use std::time::Duration;

use specula_scene::Scene;
use specula_studio::Studio;

/// A scene under the name by which pages open it; it takes the place of an earlier one of that name.
pub(crate) struct NewScene {
    pub(crate) name: String,
    pub(crate) title: String,
    /// `given` or `dropped`.
    pub(crate) from: &'static str,
    pub(crate) scene: Scene,
}

/// Adds a scene.
pub(crate) fn add_scene(_studio: &Studio, new: NewScene) {
    let NewScene { name: _, title: _, from: _, scene: _ } = new;
}

/// Closes renders that nobody has asked for in so long.
pub(crate) fn close_idle(_studio: &Studio, _after: Duration) {}
