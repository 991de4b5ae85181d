//! Absorption inside and outside of shapes, as homogeneous media.

use std::fmt::Write;

use specula_bsdf::Rgb;

use super::{Writer, rgb_list};
use crate::scene::MaterialId;

/// The name of the medium on a side of a material.
fn name(index: usize, side: &str) -> String {
    format!("\"medium-{index}-{side}\"")
}

impl Writer<'_> {
    /// All media. Where both sides of a boundary had one name, pbrt-v4 would see no boundary: every
    /// side has a medium of its own.
    pub(super) fn media(&mut self) {
        let materials = &self.scene.materials;
        let mut text = String::new();
        let mut make = |name: String, absorption: Rgb<f32>| {
            let _ = writeln!(
                text,
                "MakeNamedMedium {name} \"string type\" [ \"homogeneous\" ] \
                 \"rgb sigma_a\" [ {} ] \"rgb sigma_s\" [ 0 0 0 ]",
                rgb_list(absorption)
            );
        };
        let bounding = materials.iter().enumerate();
        for (i, material) in bounding.filter(|(_, m)| m.bounds_absorption()) {
            make(name(i, "inside"), material.absorption);
            if let Some(around) = material.around.filter(|a| !a.is_black()) {
                make(name(i, "around"), around);
            }
        }
        self.text.push_str(&text);
        let is_relative =
            |m: &&crate::scene::Material| m.around.is_none() && !m.absorption.is_black();
        if materials.iter().filter(is_relative).nth(1).is_some() {
            self.note("around absorbing media there is empty space, also within other media");
        }
    }

    /// The directive that says what is on the sides of a material; empty where nothing absorbs.
    pub(super) fn sides(&self, id: MaterialId) -> String {
        let material = &self.scene.materials[id.0];
        if !material.bounds_absorption() {
            return String::new();
        }
        let around = match material.around.filter(|a| !a.is_black()) {
            Some(_) => name(id.0, "around"),
            None => "\"\"".to_owned(),
        };
        format!("MediumInterface {} {around}\n", name(id.0, "inside"))
    }
}
