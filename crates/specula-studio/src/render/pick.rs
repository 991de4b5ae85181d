//! `render.pick`: what is at a pixel.

use serde::Deserialize;
use serde_json::json;

use super::materials;
use super::session::Session;
use crate::{Answer, AskError};

/// `render.pick`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pick {
    pub(super) session: u64,
    /// Column from the left, row from the top; whole numbers are the pixels' corners.
    x: f64,
    y: f64,
}

impl Session {
    /// Answers `render.pick`.
    pub(super) fn pick(&self, asked: &Pick) -> Result<Answer, AskError> {
        let [width, height] = self.resolution();
        for (name, value, most) in [("x", asked.x, width), ("y", asked.y, height)] {
            if !(0.0..f64::from(most)).contains(&value) {
                return Err(AskError::new(format!(
                    "{name}: expected a place in [0, {most}), got {value}"
                )));
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "of a pixel's size at most")]
        let middle = [asked.x, asked.y].map(|v| (v.floor() + 0.5) as f32);
        let hit = self.prepared()?.seen(middle).map(|seen| {
            let material = &self.scene.given.scene.materials[seen.material];
            json!({
                "material": seen.material,
                "name": materials::name(material, seen.material),
                "point": seen.position,
                "normal": seen.normal,
                "distance": seen.distance,
            })
        });
        Ok(Answer::new(json!({"hit": hit})))
    }
}
