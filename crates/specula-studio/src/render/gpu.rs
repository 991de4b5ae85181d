//! `render.gpu`: what a page needs to take the same samples with WebGPU.

use specula_render::{PreparedScene, RenderOptions};

use super::session::Session;
use crate::{Answer, AskError};

/// What WebGPU cannot render of a scene, in words.
pub(super) fn missing(scene: &PreparedScene, _options: &RenderOptions) -> Vec<String> {
    scene.flatten().missing
}

impl Session {
    /// Answers `render.gpu`.
    pub(super) fn gpu(&self) -> Result<Answer, AskError> {
        Err(AskError::unknown("render.gpu"))
    }
}
