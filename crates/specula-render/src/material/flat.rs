//! Materials for shaders.
//!
//! A record is its head, how many parameters may have a texture, these, then the kind's other words.

use std::sync::Arc;

use specula_bsdf::Rgb;
use specula_bsdf::internal::shader_codes;
use specula_bsdf::measured::Measured;
use specula_scene::Energy;
use specula_scene::scene::BumpRules;

use super::parameters::{ParameterCodes, Parameters};
use super::{Material, MaterialShader, Materials};
use crate::bump;
use crate::codes;
use crate::convert::id;
use crate::layout;
use crate::medium_stack::MOST_MEDIA;
use crate::texture::Textures;
use crate::words::Words;

impl Materials {
    /// Records, then a table of their places.
    ///
    /// Returns what they need of shaders, each once.
    pub(crate) fn flatten(&self, textures: &Textures, to: &mut Words) -> Vec<MaterialShader> {
        let mut shaders = Vec::new();
        let mut places = Vec::with_capacity(self.materials.len());
        let mut codes_of_all = ParameterCodes::default();
        let mut tables = MeasuredPlaces::default();
        for material in &self.materials {
            let mut parameters = material.parameters();
            if let Some(measured) = &material.measured {
                parameters.id(tables.place(measured, to));
            }
            places.push(to.offset());
            let shader = material.shader();
            codes_of_all.add(shader, energy_code(material.models.energy), &parameters);
            material.flatten(&parameters, to);
            if !shaders.contains(&shader) {
                shaders.push(shader);
            }
        }
        codes_of_all.flatten(to);
        to.begin("MATERIALS");
        to.ids(places);
        to.begin("BEHIND_ROUGH");
        to.ids(self.behind_rough.iter().copied());
        to.constant("REGULARIZES", u32::from(self.are_regularized()));
        to.float_constant("BUMP_STEP", bump::STEP);
        to.begin("BUMPS");
        for material in &self.materials {
            material.flatten_bumps(textures, to);
        }
        to.begin("BOUNDARIES");
        for material in &self.materials {
            material.flatten_boundary(to);
        }
        to.constant("MOST_MEDIA", id(MOST_MEDIA));
        to.constant("HAS_BOUNDARIES", u32::from(self.has_boundaries));
        let turns = |m: &Material| m.turn.is_some_and(|t| t.direction.is_some());
        to.constant(
            "HAS_DIRECTIONS",
            u32::from(self.materials.iter().any(turns)),
        );
        let bent = self.materials.iter().filter(|m| m.has_bumps()).count();
        to.constant("BUMP_COUNT", id(bent));
        // A render has one sampler and one density for simulated bounces.
        let models = self.materials.first().map(|m| m.models);
        to.constant(
            "SAMPLER",
            models.map_or(0, |m| shader_codes::sampler(m.sampler)),
        );
        to.constant(
            "BOUNCES_PDF",
            models.map_or(0, |m| shader_codes::mis_pdf(m.mis_pdf)),
        );
        shaders
    }
}

impl Material {
    /// The head: kind, whether it has one side, whether layers let nothing through, rotation, whether
    /// tangents do not matter, model of energy, texture of directions.
    fn flatten(&self, parameters: &Parameters, words: &mut Words) {
        let rotation_rad = self.turn.map_or(0.0, |t| t.rotation_rad);
        let direction = self.turn.and_then(|t| t.direction);
        let kind = self.shader();
        let head = [
            (layout::MATERIAL_KIND, kind as u32),
            (layout::MATERIAL_ONE_SIDED, u32::from(self.one_sided)),
            (layout::MATERIAL_OPAQUE, u32::from(self.opaque_layers)),
            (layout::MATERIAL_ROTATION, rotation_rad.to_bits()),
            (
                layout::MATERIAL_ISOTROPIC,
                u32::from(self.takes_any_tangent),
            ),
            (layout::MATERIAL_ENERGY, energy_code(self.models.energy)),
            (
                layout::MATERIAL_DIRECTION,
                direction.map_or(codes::NONE, |texture| id(texture.0)),
            ),
        ];
        let record = words.offset();
        for (field, word) in head {
            words.field(record, field);
            words.id(word);
        }
        words.field(record, layout::MATERIAL_PARAMETERS);
        parameters.flatten(words);
    }

    /// Which of its sides are known to absorb; then what absorbs inside, and around.
    fn flatten_boundary(&self, to: &mut Words) {
        let known = self
            .boundary
            .map_or(codes::BOUNDARY_NONE, |b| match b.around {
                None => codes::BOUNDARY_INSIDE,
                Some(_) => codes::BOUNDARY_BOTH,
            });
        let colour = |c: Option<Rgb<f32>>| c.unwrap_or(Rgb::BLACK);
        let record = to.offset();
        to.id(known);
        to.colour(colour(self.boundary.map(|b| b.inside)));
        to.colour(colour(self.boundary.and_then(|b| b.around)));
        to.field(record, layout::BOUNDARY_SIZE);
    }

    /// The bump map, whether the clear coat is bent otherwise, its bump.
    fn flatten_bumps(&self, textures: &Textures, to: &mut Words) {
        let record = to.offset();
        bump::flatten(self.bump.as_ref(), self.bump_rules, textures, to);
        to.flag(self.coat.is_some());
        let coat = self.coat.and_then(|c| c.0);
        bump::flatten(coat.as_ref(), BumpRules::Plain, textures, to);
        to.field(record, layout::BUMP_SIZE);
    }

    fn has_bumps(&self) -> bool {
        self.bump.is_some() || self.coat.is_some()
    }
}

/// Where the tables of measured materials are: those of a file once, however many materials have it.
#[derive(Default)]
struct MeasuredPlaces<'a>(Vec<(&'a Arc<Measured<f32>>, u32)>);

impl<'a> MeasuredPlaces<'a> {
    /// The place of the tables, which are written where they are not there yet.
    fn place(&mut self, measured: &'a Arc<Measured<f32>>, to: &mut Words) -> u32 {
        let known = self.0.iter().find(|(m, _)| Arc::ptr_eq(m, measured));
        if let Some(&(_, place)) = known {
            return place;
        }
        let place = to.offset();
        to.floats(measured.packed());
        self.0.push((measured, place));
        place
    }
}

/// The code of a material's model of energy.
fn energy_code(energy: Energy) -> u32 {
    match energy {
        Energy::None => 0,
        Energy::Compensated(model) => shader_codes::energy(model),
        Energy::Multibounce(model) => shader_codes::multibounce(model),
    }
}
