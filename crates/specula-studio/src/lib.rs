//! What the studio's pages ask for: lobes, samplers and progressive renders.
//!
//! A page sends a request, a JSON object whose `ask` names what is wanted; [`Studio::answer`] returns an [`Answer`] in
//! bytes. The program's server passes both on; in a page without a server, this crate runs in WebAssembly.
//!
//! The requests and answers, as the pages see them: `specula-studio-server/web/src/core/protocol.ts`.

mod answer;
mod fields;
mod lobes;
mod render;
mod request;
mod samplers;
mod shaders;

pub use answer::{Answer, Array};
pub use request::AskError;

use render::Renders;

/// Answers requests; renders stay open between them.
#[derive(Debug, Default)]
pub struct Studio {
    renders: Renders,
}

impl Studio {
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
