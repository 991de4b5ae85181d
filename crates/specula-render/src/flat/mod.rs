//! A prepared scene as arrays of words, for devices that have no pointers.
//!
//! Nodes and packets of the trees are the bytes that rays walk over here. All else is one array of
//! 32-bit words, `f32` as its bits, in which every part writes itself beside its own definition
//! (`flatten`); the places where parts begin, and counts, are named constants, which shaders are
//! compiled with. What has no twin in shaders yet is named in [`FlatScene::missing`].

mod groups;

use core::fmt::Write as _;

pub use groups::{FlatGroup, FlatInstance};

use crate::codes;
use crate::integrator::estimator;
use crate::layout;
use crate::material::MaterialShader;
use crate::offset;
use crate::prepared::PreparedScene;
use crate::words::Words;

/// A prepared scene as arrays.
#[derive(Clone, Debug)]
pub struct FlatScene<'a> {
    /// 8-wide nodes, 64 words each: `min x, max x, min y, max y, min z, max z` of 8 children each,
    /// then the children: two bits of kind (node, packet, quadric, placement), 30 of index.
    pub nodes: &'a [u8],
    /// Packets of 8 triangles, 80 words each: `corner, axis, triangle` of the vertices, then the
    /// triangles' numbers in their group.
    pub packets: &'a [u8],
    /// Everything else.
    pub words: Vec<u32>,
    /// Places within `words`, counts, codes and flags, by the names that shaders use.
    pub constants: Vec<(&'static str, u32)>,
    /// Numbers that shaders share with the renderer, by their names there.
    pub floats: Vec<(&'static str, f32)>,
    /// What the scene's materials need of shaders, each once.
    pub shaders: Vec<MaterialShader>,
    /// Features of the scene that shaders do not know, in a person's words; none: all is known.
    pub missing: Vec<String>,
}

impl FlatScene<'_> {
    /// A constant by its name.
    #[must_use]
    pub fn constant(&self, name: &str) -> Option<u32> {
        let found = self.constants.iter().find(|constant| constant.0 == name);
        found.map(|constant| constant.1)
    }

    /// All constants as declarations in WGSL, which stand in front of the shader of the scene.
    #[must_use]
    pub fn declarations(&self) -> String {
        let mut text = String::new();
        for (name, value) in &self.constants {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        for (name, value) in &self.floats {
            // Rust writes as many digits as tell the number from all others.
            let _ = writeln!(text, "const {name}: f32 = {value:?}f;");
        }
        text
    }
}

impl PreparedScene {
    /// The scene as arrays of words.
    pub fn flatten(&self) -> FlatScene<'_> {
        let mut words = Words::default();
        for &(name, value) in codes::ALL.iter().chain(layout::ALL) {
            words.constant(name, value);
        }
        estimator::flatten(&mut words);
        crate::sampler::flatten(&mut words);
        self.camera.flatten(&mut words);
        self.filter.flatten(&mut words);
        self.develop.flatten(&mut words);
        let (nodes, packets) = self.geometry.flatten(&mut words);
        let mut missing = self.textures.flatten(&mut words);
        let shaders = self.materials.flatten(&self.textures, &mut words);
        if shaders.contains(&MaterialShader::Hair) {
            missing.push("hair".to_owned());
        }
        if self.moves {
            missing.push("motion blur".to_owned());
        }
        if self.camera.has_lenses() {
            missing.push("camera lenses".to_owned());
        }
        if self.geometry.has_exact_shapes() {
            let what = "parts of quadrics, bilinear patches or curves, prepared without `triangulate_exact_shapes`";
            missing.push(what.to_owned());
        }
        if self.lights.has_portals() {
            missing.push("portals".to_owned());
        }
        self.lights.flatten(&mut words);
        let [width, height] = self.resolution;
        words.constant("WIDTH", width);
        words.constant("HEIGHT", height);
        words.constant("HIDES_EMITTERS", u32::from(self.hide_emitters));
        words.float_constant("RELATIVE_ERROR", offset::RELATIVE_ERROR);
        let (words, (constants, floats)) = words.finish();
        FlatScene {
            nodes,
            packets,
            words,
            constants,
            floats,
            shaders,
            missing,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_constants_are_unique() {
        let all = codes::ALL.iter().chain(layout::ALL);
        let mut names: Vec<&str> = all.map(|(name, _)| *name).collect();
        names.sort_unstable();
        let repeated = names.windows(2).find(|pair| pair[0] == pair[1]);
        assert_eq!(repeated, None);
    }
}
