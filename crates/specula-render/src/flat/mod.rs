//! A prepared scene as arrays of words, for devices that have no pointers.
//!
//! Nodes and packets of the trees are the bytes that rays walk over here. All else is one array of
//! 32-bit words, `f32` as its bits, in which every part writes itself beside its own definition
//! (`flatten`); the places where parts begin, and counts, are named constants, which shaders are
//! compiled with. What has no twin in shaders yet is named in [`FlatScene::missing`].

mod groups;
mod lobe_kind;
mod words;

pub use groups::{FlatGroup, FlatInstance};
pub use lobe_kind::LobeKind;
pub(crate) use words::Words;

use crate::prepared::PreparedScene;

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
    /// Places within `words`, counts and flags, by the name that shaders use.
    pub constants: Vec<(&'static str, u32)>,
    /// Kinds of the scene's materials, each once.
    pub lobes: Vec<LobeKind>,
    /// Features of the scene that shaders do not know, in a person's words; none: all is known.
    pub missing: Vec<String>,
}

/// What a flattened scene gathers on the way.
#[derive(Default)]
pub(crate) struct Flattening {
    pub(crate) words: Words,
    lobes: Vec<LobeKind>,
    missing: Vec<String>,
}

impl Flattening {
    /// Notes a kind of material that is used.
    pub(crate) fn uses(&mut self, kind: LobeKind) {
        if !self.lobes.contains(&kind) {
            self.lobes.push(kind);
        }
    }

    /// Notes a feature that shaders do not know, once.
    pub(crate) fn lacks(&mut self, feature: impl Into<String>) {
        let feature = feature.into();
        if !self.missing.contains(&feature) {
            self.missing.push(feature);
        }
    }
}

impl PreparedScene {
    /// The scene as arrays of words.
    pub fn flatten(&self) -> FlatScene<'_> {
        let mut to = Flattening::default();
        crate::sampler::flatten(&mut to.words);
        self.camera.flatten(&mut to.words);
        self.filter.flatten(&mut to.words);
        self.develop.flatten(&mut to.words);
        let (nodes, packets) = self.geometry.flatten(&mut to);
        self.textures.flatten(&mut to);
        self.materials.flatten(&mut to);
        self.lights.flatten(&mut to.words);
        let [width, height] = self.resolution;
        to.words.constant("WIDTH", width);
        to.words.constant("HEIGHT", height);
        to.words
            .constant("HIDES_EMITTERS", u32::from(self.hide_emitters));
        let (words, constants) = to.words.finish();
        FlatScene {
            nodes,
            packets,
            words,
            constants,
            lobes: to.lobes,
            missing: to.missing,
        }
    }
}
