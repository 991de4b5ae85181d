//! Materials as pages see them: kind, and the text by which they are replaced.

use serde_json::{Value, json};
use specula_bsdf::{Rgb, metals};
use specula_scene::Scene;
use specula_scene::material_text::parse_material;
use specula_scene::scene::{
    ColourParam, ConductorFresnel, FloatParam, Material, MaterialKind, Roughness,
};
use specula_scene::summary::material_kind;

use super::changes::Changes;
use crate::AskError;

/// The materials of a scene, with the texts that changed them.
pub(super) fn list(scene: &Scene, changes: &Changes) -> Vec<Value> {
    let describe = |(id, material): (usize, &Material)| {
        let edit = changes.edits.get(&id);
        let kind = edit
            .and_then(|text| parse_material(text).ok())
            .unwrap_or(material.kind);
        json!({
            "id": id,
            "name": name(material, id),
            "kind": material_kind(&kind),
            "text": edit.cloned().or_else(|| text_of(&kind)),
        })
    };
    scene.materials.iter().enumerate().map(describe).collect()
}

/// The file's name for a material, or one by its number.
pub(super) fn name(material: &Material, id: usize) -> String {
    material
        .name
        .clone()
        .unwrap_or_else(|| format!("material {id}"))
}

/// Gives a material of a scene the kind of a text.
pub(super) fn replace(material: &mut Material, text: &str) -> Result<(), AskError> {
    material.kind = parse_material(text).map_err(|e| AskError::new(format!("edits: {e}")))?;
    material.bump = None;
    material.one_sided = false;
    Ok(())
}

/// The text of a material; `None` where there is none that says it exactly.
fn text_of(kind: &MaterialKind) -> Option<String> {
    let text = match kind {
        MaterialKind::Diffuse { reflectance, .. } => format!("diffuse {}", colour(reflectance)?),
        MaterialKind::Conductor {
            fresnel, roughness, ..
        } => {
            format!("conductor {} {}", metal(fresnel)?, width(roughness)?)
        }
        MaterialKind::Dielectric { eta, roughness, .. } => {
            format!("dielectric {eta} {}", width(roughness)?)
        }
        MaterialKind::CoatedDiffuse {
            reflectance,
            eta,
            roughness,
            ..
        } => {
            format!(
                "coateddiffuse {} eta {eta} {}",
                colour(reflectance)?,
                width(roughness)?
            )
        }
        MaterialKind::CoatedConductor {
            coat_eta,
            fresnel,
            roughness,
            ..
        } => {
            format!(
                "coatedconductor {} eta {coat_eta} {}",
                metal(fresnel)?,
                width(roughness)?
            )
        }
        _ => return None,
    };
    parse_material(&text)
        .is_ok_and(|said| said == *kind)
        .then_some(text)
}

fn colour(parameter: &ColourParam) -> Option<String> {
    match parameter {
        ColourParam::Value(Rgb { r, g, b }) if r == g && g == b => Some(r.to_string()),
        ColourParam::Value(Rgb { r, g, b }) => Some(format!("{r} {g} {b}")),
        ColourParam::Texture(_) => None,
    }
}

fn metal(fresnel: &ConductorFresnel) -> Option<String> {
    match fresnel {
        ConductorFresnel::Index {
            eta: ColourParam::Value(eta),
            k: ColourParam::Value(k),
        } => {
            let is_this = |metal: &&metals::Metal| {
                let index = |channel: [f64; 3]| -> Rgb<f32> { Rgb::from(channel).cast() };
                index(metal.eta) == *eta && index(metal.k) == *k
            };
            metals::METALS
                .iter()
                .find(is_this)
                .map(|m| m.symbol.to_owned())
        }
        ConductorFresnel::Reflectance(reflectance) => colour(reflectance),
        _ => None,
    }
}

fn width(roughness: &Roughness) -> Option<String> {
    match (roughness.u, roughness.v) {
        (FloatParam::Value(u), FloatParam::Value(v)) if u == v => Some(format!("alpha {u}")),
        (FloatParam::Value(u), FloatParam::Value(v)) => Some(format!("alpha {u} {v}")),
        _ => None,
    }
}
