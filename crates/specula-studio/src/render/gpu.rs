//! `render.gpu`: what a page needs to take the same samples with WebGPU.

use serde_json::json;
use specula_gpu::{MissingFeatures, SceneProgram};
use specula_render::{PreparedScene, RenderOptions};

use super::session::Session;
use crate::{Answer, AskError};

/// Bytes of an array that every WebGPU device binds.
const LARGEST_ARRAY: u64 = 128 << 20;

/// What WebGPU cannot render of a scene, in words; nothing: it can.
pub(super) fn missing(scene: &PreparedScene, options: &RenderOptions) -> Vec<String> {
    match SceneProgram::new(scene, options) {
        Ok(program) => too_large(&program).into_iter().collect(),
        Err(MissingFeatures(missing)) => missing,
    }
}

fn too_large(program: &SceneProgram<'_>) -> Option<String> {
    let largest = program.largest_array();
    (largest > LARGEST_ARRAY).then(|| {
        let [bytes, most] = [largest, LARGEST_ARRAY].map(|bytes| bytes >> 20);
        format!("a scene of {bytes} MiB in one array (WebGPU binds {most} MiB)")
    })
}

impl Session {
    /// Answers `render.gpu`.
    pub(super) fn gpu(&self) -> Result<Answer, AskError> {
        let missing = |missing: &str| AskError::new(format!("WebGPU does not render {missing}"));
        let program = SceneProgram::new(self.prepared()?, &self.options)
            .map_err(|MissingFeatures(all)| missing(&all.join(", ")))?;
        if let Some(too_large) = too_large(&program) {
            return Err(missing(&too_large));
        }
        let text = program.text().map_err(|e| AskError::new(e.to_string()))?;
        let [width, height] = self.resolution();
        let mut answer = Answer::new(json!({
            "wgsl": text,
            "settings": program.settings(),
            "width": width,
            "height": height,
        }));
        let names = ["tables", "nodes", "packets", "words"];
        for (name, bytes) in names.into_iter().zip(program.arrays()) {
            // Bindings must not be empty.
            let bytes = if bytes.is_empty() { &[0; 16] } else { bytes };
            answer = answer.with_u8(name, &[bytes.len()], bytes.to_vec());
        }
        Ok(answer)
    }
}
