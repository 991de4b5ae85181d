//! What a session changes of its scene, and the checks of it.

use std::collections::BTreeMap;

use serde::Deserialize;
use specula_bsdf::vndf;
use specula_scene::scene::MaterialKind;
use specula_scene::{Energy, Scene};

use super::materials;
use super::view::View;
use crate::AskError;

/// Most pixels of a picture.
pub(super) const MOST_PIXELS: u64 = 4_000_000;
/// Most scattering events of a path.
const MOST_DEPTH: u32 = 65_535;

/// The treatments of energy that can be asked for.
pub(super) const ENERGIES: [&str; 11] = [
    "none",
    "turquin",
    "turquin-series",
    "kulla-conty",
    "multibounce=specula",
    "multibounce=heitz",
    "multibounce=bitterli",
    "multibounce=wang",
    "multibounce=wang-uncorrelated",
    "multibounce=cui",
    "multibounce=cui-bidirectional",
];

/// Another material for one of the scene's.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialEdit {
    material: MaterialName,
    /// As of `render --material`; empty: the scene's own again.
    text: String,
}

/// A material by its name or its number.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "edits: expected a material's name or number")]
enum MaterialName {
    Number(u64),
    Name(String),
}

/// What a render changes of its scene.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    pub(super) camera: Option<View>,
    /// Texts of materials by their number.
    pub(super) edits: BTreeMap<usize, String>,
    pub(super) energy: Option<Energy>,
    pub(super) sampler: Option<vndf::Sampler>,
    /// Of the picture, where they are not the scene's.
    pub(super) width: Option<u32>,
    pub(super) height: Option<u32>,
    pub(super) seed: u32,
    pub(super) max_depth: Option<u32>,
}

/// Requested changes; what is not said stays as it was.
#[derive(Debug, Default)]
pub(super) struct Asked {
    pub(super) camera: Option<View>,
    pub(super) edits: Vec<MaterialEdit>,
    pub(super) energy: Option<String>,
    pub(super) sampler: Option<String>,
    pub(super) width: Option<u32>,
    pub(super) height: Option<u32>,
}

impl Changes {
    /// These changes and more; all are checked but the camera.
    pub(super) fn with(&self, asked: Asked, scene: &Scene) -> Result<Self, AskError> {
        let mut all = self.clone();
        all.camera = asked.camera.or(all.camera);
        all.width = asked.width.or(all.width);
        all.height = asked.height.or(all.height);
        check_size(all.resolution(scene))?;
        if let Some(energy) = asked.energy {
            let known = energy
                .parse()
                .map_err(|e| AskError::new(format!("energy: {e}")))?;
            all.energy = Some(known);
        }
        if let Some(sampler) = asked.sampler {
            let known = sampler
                .parse()
                .map_err(|e| AskError::new(format!("sampler: {e}")))?;
            all.sampler = Some(known);
        }
        for edit in asked.edits {
            let id = edit.material.number(scene)?;
            if scene.materials[id].kind == MaterialKind::Interface {
                let name = materials::name(&scene.materials[id], id);
                return Err(AskError::new(format!(
                    "edits: '{name}' is the boundary of a medium, not a surface"
                )));
            }
            if edit.text.trim().is_empty() {
                all.edits.remove(&id);
                continue;
            }
            // A trial: what it says is needed later.
            materials::replace(&mut scene.materials[id].clone(), &edit.text)?;
            all.edits.insert(id, edit.text);
        }
        Ok(all)
    }

    /// Whether the scene must be prepared anew for these changes, once it is for the others.
    pub(super) fn differ_in_surfaces(&self, others: &Self) -> bool {
        self.edits != others.edits || self.energy != others.energy || self.sampler != others.sampler
    }

    /// Width and height of the picture; of one that is not said, in the proportions of the scene's.
    pub(super) fn resolution(&self, scene: &Scene) -> [u32; 2] {
        let [width, height] = scene.film.resolution;
        let scaled = |side: u32, by: u32, of: u32| {
            let exact = f64::from(side) * f64::from(by) / f64::from(of.max(1));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturates; sizes are checked"
            )]
            let pixels = exact.round() as u32;
            pixels.max(1)
        };
        match (self.width, self.height) {
            (Some(width), Some(height)) => [width, height],
            (Some(w), None) => [w, scaled(height, w, width)],
            (None, Some(h)) => [scaled(width, h, height), h],
            (None, None) => [width, height],
        }
    }

    /// The scene with its materials changed.
    pub(super) fn apply(&self, scene: &mut Scene) -> Result<(), AskError> {
        for (&id, text) in &self.edits {
            materials::replace(&mut scene.materials[id], text)?;
        }
        Ok(())
    }
}

impl MaterialName {
    fn number(&self, scene: &Scene) -> Result<usize, AskError> {
        let count = scene.materials.len();
        let found = match self {
            Self::Number(id) => usize::try_from(*id).ok().filter(|&id| id < count),
            Self::Name(name) => {
                let is_this = |m: &specula_scene::scene::Material| m.name.as_ref() == Some(name);
                scene.materials.iter().position(is_this)
            }
        };
        let asked = || match self {
            Self::Number(id) => id.to_string(),
            Self::Name(name) => format!("'{name}'"),
        };
        found.ok_or_else(|| {
            AskError::new(format!(
                "edits: no material {} (the scene has {count})",
                asked()
            ))
        })
    }
}

/// A path's length that can be asked for.
pub(super) fn check_depth(depth: Option<u32>) -> Result<Option<u32>, AskError> {
    match depth {
        Some(depth) if depth > MOST_DEPTH => Err(AskError::new(format!(
            "maxDepth: expected at most {MOST_DEPTH}, got {depth}"
        ))),
        depth => Ok(depth),
    }
}

/// The seed of a number as pages have it: itself below 2^32, above mixed of both halves.
pub(super) fn check_seed(seed: Option<u64>) -> Result<u32, AskError> {
    let seed = seed.unwrap_or(0);
    if seed >= 1 << 53 {
        return Err(AskError::new(format!(
            "seed: expected an integer below 2^53, got {seed}"
        )));
    }
    let low = seed & u64::from(u32::MAX);
    let mixed = low ^ (((seed >> 32) * 0x9e37_79b9) & u64::from(u32::MAX));
    Ok(u32::try_from(mixed).unwrap_or_default())
}

fn check_size([width, height]: [u32; 2]) -> Result<(), AskError> {
    let pixels = u64::from(width) * u64::from(height);
    match pixels {
        0 => Err(AskError::new(format!(
            "width, height: {width} x {height} is no picture"
        ))),
        1..=MOST_PIXELS => Ok(()),
        _ => Err(AskError::new(format!(
            "width, height: {width} x {height} are {pixels} pixels; expected at most {MOST_PIXELS}"
        ))),
    }
}
