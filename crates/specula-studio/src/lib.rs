//! What the studio's pages ask for: lobes, samplers and progressive renders.
//!
//! A page sends a request, a JSON object whose `ask` names what is wanted; [`Studio::answer`] returns an [`Answer`] in
//! bytes. The program's server passes both on; in a page without a server, this crate runs in WebAssembly.
//!
//! The requests and answers, as the pages see them: `specula-studio-server/web/src/core/protocol.ts`.

mod answer;
mod clock;
mod fields;
mod lobes;
mod render;
mod request;
mod samplers;
mod shaders;
#[cfg(target_arch = "wasm32")]
pub mod wasm;

pub use answer::{Answer, Array};
pub use render::{GivenScene, SceneFrom};
pub use request::AskError;

use render::Renders;

/// Answers requests; renders stay open between them.
#[derive(Debug, Default)]
pub struct Studio {
    renders: Renders,
}

impl Studio {
    /// Says to pages whether scenes can be dropped or opened by path: the program adds them.
    #[must_use]
    pub fn with_files(self, opens_files: bool) -> Self {
        self.renders.catalogue().opens_files = opens_files;
        self
    }

    /// Adds a scene that can be rendered, in the place of one of the same name; open renders of that go on.
    ///
    /// * `scene`: a scene, or one that was read, with its warnings.
    pub fn add_scene(
        &self,
        name: &str,
        title: &str,
        from: SceneFrom,
        scene: impl Into<GivenScene>,
    ) {
        self.renders
            .catalogue()
            .add(name, title, from, scene.into());
    }

    /// Removes a scene; open renders of it go on. Returns whether there was one of this name.
    pub fn remove_scene(&self, name: &str) -> bool {
        self.renders.catalogue().remove(name)
    }

    /// Closes renders that no request has named for so long; returns how many.
    pub fn close_idle(&self, after: std::time::Duration) -> usize {
        self.renders.close_idle(after.as_secs_f64())
    }

    /// Answers a request: bytes of an [`Answer`], or of an error's words.
    #[must_use]
    pub fn answer(&self, request: &[u8]) -> Vec<u8> {
        match self.try_answer(request) {
            Ok(answer) => answer.into_bytes(),
            Err(error) => answer::error_bytes(&error.to_string()),
        }
    }

    /// Answers a request.
    ///
    /// # Errors
    /// Where the request cannot be read, or asks for what cannot be.
    pub fn try_answer(&self, request: &[u8]) -> Result<Answer, AskError> {
        let (ask, request) = request::read(request)?;
        match ask.split_once('.') {
            Some(("lobes", what)) => lobes::answer(what, request),
            Some(("samplers", what)) => samplers::answer(what, request),
            Some(("render", what)) => self.renders.answer(what, request),
            Some(("shaders", what)) => shaders::answer(what, request),
            _ => Err(AskError::unknown(&ask)),
        }
    }
}
