//! `render.save` and `render.scene`: the picture as a file, the scene as text.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::json;
use specula_render::picture::{Display, Metadata, exr_bytes, png_bytes};
use specula_scene::write_pbrt::pbrt_text;

use super::catalogue::SceneFrom;
use super::session::Session;
use crate::{Answer, AskError};

/// `render.save`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Save {
    pub(super) session: u64,
    pub(super) format: PictureFormat,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum PictureFormat {
    Exr,
    Png,
}

/// `render.scene`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Export {
    pub(super) session: u64,
    pub(super) format: TextFormat,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum TextFormat {
    Pbrt,
    Command,
}

impl Session {
    /// Answers `render.save`.
    pub(super) fn save(&self, format: PictureFormat) -> Result<Answer, AskError> {
        let picture = self.picture()?;
        let stem = self.stem();
        let (name, bytes) = match format {
            PictureFormat::Exr => (format!("{stem}.exr"), exr_bytes(&picture, &self.metadata())),
            PictureFormat::Png => (
                format!("{stem}.png"),
                png_bytes(&picture, Display::default()),
            ),
        };
        let bytes =
            bytes.map_err(|e| AskError::new(format!("the picture cannot be written: {e}")))?;
        let shape = [bytes.len()];
        Ok(Answer::new(json!({"name": name})).with_u8("file", &shape, bytes))
    }

    fn metadata(&self) -> Metadata {
        #[expect(clippy::cast_possible_truncation, reason = "rounds")]
        let seconds = self.progress.seconds as f32;
        Metadata {
            software: Some(format!("specula {}", env!("CARGO_PKG_VERSION"))),
            scene: Some(self.scene.name.clone()),
            samples_per_pixel: self.film().map(|film| film.complete_samples()),
            seed: Some(self.options.seed),
            render_seconds: Some(seconds),
            bias: self.options.bias(),
            missing: None,
        }
    }

    /// The scene's name without what cannot be in a file's.
    fn stem(&self) -> String {
        let path = Path::new(&self.scene.name);
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let kept = |c: char| {
            if c.is_alphanumeric() || "-_. ".contains(c) {
                c
            } else {
                '-'
            }
        };
        let stem: String = stem.chars().map(kept).collect();
        if stem.is_empty() {
            "render".to_owned()
        } else {
            stem
        }
    }

    /// Answers `render.scene`.
    pub(super) fn export(&self, format: TextFormat) -> Result<Answer, AskError> {
        let text = match format {
            TextFormat::Command => self.command(),
            TextFormat::Pbrt => self.pbrt()?,
        };
        Ok(Answer::new(json!({"text": text})))
    }

    fn pbrt(&self) -> Result<String, AskError> {
        let scene = self.changed_scene()?;
        let path = PathBuf::from(format!("{}.pbrt", self.stem()));
        let written = pbrt_text(&scene, &path);
        let (text, notes) =
            written.map_err(|e| AskError::new(format!("the scene cannot be written: {e}")))?;
        let notes: String = notes.iter().map(|note| format!("# {note}\n")).collect();
        Ok(notes + &text)
    }

    /// The command line of this render; a camera cannot be said in it.
    fn command(&self) -> String {
        let changes = &self.changes;
        let mut words = vec!["specula".to_owned(), "render".to_owned()];
        let mut note = String::new();
        match self.scene.from {
            SceneFrom::BuiltIn if self.scene.name == super::scenes::ORBS => {}
            SceneFrom::BuiltIn => {
                let file = format!("{}.pbrt", self.stem());
                note += &format!("# {file}: the scene as pbrt-v4 has it.\n");
                words.push(quoted(&file));
            }
            _ => words.push(quoted(&self.scene.name)),
        }
        for (&id, text) in &changes.edits {
            let name = self.scene.given.scene.materials[id].name.as_ref();
            match name {
                Some(name) => words.push(format!(
                    "--material {}",
                    quoted(&format!("{}={text}", pattern(name)))
                )),
                None => {
                    note +=
                        &format!("# Material {id} has no name: it is changed in the studio only.\n")
                }
            }
        }
        let [width, height] = self.resolution();
        if changes.width.is_some() || changes.height.is_some() {
            words.push(format!("--resolution {width}x{height}"));
        }
        if let Some(energy) = changes.energy {
            words.push(format!("--energy {energy}"));
        }
        if let Some(sampler) = changes.sampler {
            words.push(format!("--sampler {sampler}"));
        }
        if let Some(depth) = changes.max_depth {
            words.push(format!("--max-depth {depth}"));
        }
        if changes.seed != 0 {
            words.push(format!("--seed {}", changes.seed));
        }
        if changes.camera.is_some() {
            note +=
                "# The camera was moved: the scene as pbrt-v4 has it, a command line does not.\n";
        }
        note + &words.join(" ")
    }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

/// A name as a pattern that matches it alone.
fn pattern(name: &str) -> String {
    let escaped = |c: char| match c {
        '*' | '?' | '[' | ']' | '{' | '}' => format!("[{c}]"),
        '\\' => "\\\\".to_owned(),
        _ => c.to_string(),
    };
    name.chars().map(escaped).collect()
}
