//! What the server asks of the library beside answers.

use std::time::Duration;

use specula_studio::{GivenScene, SceneFrom, Studio};

/// A scene under the name by which pages open it; it takes the place of an earlier one of that name.
pub(crate) struct NewScene {
    pub(crate) name: String,
    pub(crate) title: String,
    pub(crate) from: SceneFrom,
    pub(crate) scene: GivenScene,
}

/// Adds a scene.
pub(crate) fn add_scene(studio: &Studio, new: NewScene) {
    studio.add_scene(&new.name, &new.title, new.from, new.scene);
}

/// Closes renders that nobody has asked for in so long.
pub(crate) fn close_idle(studio: &Studio, after: Duration) {
    studio.close_idle(after);
}
