//! Textures for shaders.
//!
//! A node is a record that begins with its kind; its inputs are the places of other records, which
//! come before it. Shaders follow them without recursion (`texture_graph.wgsl`).

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{
    Channel, ColourParam, FloatParam, Interpolation, NoiseKind, TextureId, Wrap,
};

use super::graph::{Node, Picture};
use super::{TextureCoordinates, Textures, finite, noise};
use crate::convert::id;
use crate::flat::{Flattening, Words};
use crate::prepared::PreparedScene;

/// No texture: a value stands beside it.
const NONE: u32 = u32::MAX;

/// Nodes that may wait for their inputs at the same time in a shader.
const MOST_WAITING: u32 = 32;

/// Most nodes that a shader evaluates for one value, each as often as others refer to it.
const MOST_VISITS: u32 = 4096;

/// 4 words: the texture's number, or [`NONE`] and the value.
pub(crate) fn colour_parameter(to: &mut Words, parameter: ColourParam) {
    let (texture, value) = match parameter {
        ColourParam::Value(c) => (NONE, c.map(finite)),
        ColourParam::Texture(texture) => (id(texture.0), Rgb::BLACK),
    };
    to.id(texture);
    to.colour(value);
}

/// 2 words: the texture's number, or [`NONE`] and the value.
pub(crate) fn float_parameter(to: &mut Words, parameter: FloatParam) {
    let (texture, value) = match parameter {
        FloatParam::Value(v) => (NONE, finite(v)),
        FloatParam::Texture(texture) => (id(texture.0), 0.0),
    };
    to.id(texture);
    to.number(value);
}

impl PreparedScene {
    /// The value of a texture, for twins of shaders.
    ///
    /// * `place`: coordinates, second coordinates, position, normal, colour.
    #[doc(hidden)]
    pub fn probe_texture(&self, texture: usize, place: [f32; 13]) -> [f32; 3] {
        let three = |i: usize| [place[i], place[i + 1], place[i + 2]];
        let place = TextureCoordinates {
            uv: [place[0], place[1]],
            second_uv: [place[2], place[3]],
            position: Vec3::from(three(4)),
            normal: Vec3::from(three(7)),
            colour: Rgb::from(three(10)),
        };
        let parameter = ColourParam::Texture(TextureId(texture));
        self.textures.colour(parameter, &place).to_array()
    }
}

impl Textures {
    /// Pictures, nodes, then a table of the nodes' places.
    ///
    /// What shaders can leave out is named: `TEXTURE_COUNT`, `TEXTURE_HAS_INPUTS`,
    /// `TEXTURE_HAS_NOISE`, and `TEXTURE_WAITING`, the length of their stack.
    pub(crate) fn flatten(&self, to: &mut Flattening) {
        let rasters: Vec<u32> = self
            .rasters
            .iter()
            .map(|raster| raster.flatten(&mut to.words))
            .collect();
        let mut records = Records::default();
        for node in &self.nodes {
            records.add(node, &rasters, &mut to.words);
        }
        to.words.begin("TEXTURES");
        to.words.ids(records.places);
        let waiting = records.waiting.iter().copied().max().unwrap_or(0);
        if waiting > MOST_WAITING {
            to.lacks(format!(
                "textures that are nested more than {MOST_WAITING} deep"
            ));
        }
        if self.extents.iter().any(|e| e.visits > MOST_VISITS) {
            to.lacks(format!(
                "textures that share inputs so often that they unfold to more than {MOST_VISITS}"
            ));
        }
        let has_noise = self
            .nodes
            .iter()
            .any(|n| matches!(n, Node::Noise { .. } | Node::Dots { .. }));
        if has_noise {
            noise::flatten(&mut to.words);
        } else {
            noise::leave_out(&mut to.words);
        }
        for (name, value) in [
            ("TEXTURE_COUNT", id(self.nodes.len())),
            (
                "TEXTURE_HAS_INPUTS",
                u32::from(self.nodes.iter().any(Node::has_inputs)),
            ),
            ("TEXTURE_HAS_NOISE", u32::from(has_noise)),
            ("TEXTURE_WAITING", waiting.clamp(1, MOST_WAITING)),
        ] {
            to.words.constant(name, value);
        }
    }
}

/// Nodes that were written.
#[derive(Default)]
struct Records {
    places: Vec<u32>,
    /// How many nodes wait for their inputs at the same time while one is evaluated, by node.
    waiting: Vec<u32>,
}

impl Records {
    fn add(&mut self, node: &Node, rasters: &[u32], to: &mut Words) {
        let [first, second] = node.inputs();
        let deepest = node.all_inputs().map(|input| self.waiting[input.0]).max();
        self.waiting
            .push(deepest.unwrap_or(0) + u32::from(node.waits()));
        let place = |input: TextureId| self.places[input.0];
        let here = to.place();
        to.id(node.kind());
        to.ids([first, second].into_iter().flatten().map(place));
        match node {
            Node::Constant(c) => to.colour(*c),
            Node::Image(picture) => picture.flatten(rasters, to),
            Node::Scale(..) | Node::Sum(..) | Node::VertexColour => {}
            Node::Mix { amount, .. } => match *amount {
                FloatParam::Texture(texture) => to.ids([place(texture), 0]),
                value @ FloatParam::Value(_) => float_parameter(to, value),
            },
            Node::Checkerboard { mapping, .. } | Node::Dots { mapping, .. } => mapping.flatten(to),
            Node::Checkerboard3d { to_texture, .. } => to.affine(to_texture),
            Node::Bilinear { corners, mapping } => {
                for corner in corners {
                    to.colour(*corner);
                }
                mapping.flatten(to);
            }
            Node::Noise {
                kind,
                octaves,
                roughness,
                to_texture,
            } => {
                let (kind, [scale, variation]) = match *kind {
                    NoiseKind::Fbm => (0, [1.0, 0.0]),
                    NoiseKind::Turbulence => (1, [1.0, 0.0]),
                    NoiseKind::Windy => (2, [1.0, 0.0]),
                    NoiseKind::Marble { scale, variation } => (3, [scale, variation]),
                };
                to.ids([kind, *octaves]);
                to.floats([*roughness, scale, variation]);
                to.affine(to_texture);
            }
            Node::Threshold { cutoff, .. } => to.number(*cutoff),
            Node::DirectionMix { axis, .. } => to.vector(*axis),
        }
        self.places.push(here);
    }
}

impl Node {
    /// As in `texture_graph.wgsl`: first those without inputs, then those that show one of two, then
    /// those that wait for theirs.
    fn kind(&self) -> u32 {
        match self {
            Self::Constant(_) => 0,
            Self::Image(_) => 1,
            Self::Bilinear { .. } => 2,
            Self::Noise { .. } => 3,
            Self::VertexColour => 4,
            Self::Checkerboard { .. } => 5,
            Self::Checkerboard3d { .. } => 6,
            Self::Dots { .. } => 7,
            Self::Scale(..) => 8,
            Self::Sum(..) => 9,
            Self::Mix { .. } => 10,
            Self::Threshold { .. } => 11,
            Self::DirectionMix { .. } => 12,
        }
    }

    /// Its inputs, the one that is evaluated first in front.
    fn inputs(&self) -> [Option<TextureId>; 2] {
        match *self {
            Self::Constant(_)
            | Self::Image(_)
            | Self::Bilinear { .. }
            | Self::Noise { .. }
            | Self::VertexColour => [None; 2],
            Self::Threshold { texture, .. } => [Some(texture), None],
            Self::Checkerboard { even, odd, .. } | Self::Checkerboard3d { even, odd, .. } => {
                [Some(even), Some(odd)]
            }
            Self::Dots {
                inside, outside, ..
            } => [Some(inside), Some(outside)],
            Self::Scale(a, b) | Self::Sum(a, b) | Self::Mix { a, b, .. } => [Some(a), Some(b)],
            // Between b across the axis and a along it.
            Self::DirectionMix { a, b, .. } => [Some(b), Some(a)],
        }
    }

    /// The texture that it mixes by.
    fn amount(&self) -> Option<TextureId> {
        match *self {
            Self::Mix {
                amount: FloatParam::Texture(texture),
                ..
            } => Some(texture),
            _ => None,
        }
    }

    /// All that it refers to.
    pub(super) fn all_inputs(&self) -> impl Iterator<Item = TextureId> {
        let [first, second] = self.inputs();
        [first, second, self.amount()].into_iter().flatten()
    }

    fn has_inputs(&self) -> bool {
        self.inputs()[0].is_some()
    }

    /// Whether it does something to its inputs' values.
    fn waits(&self) -> bool {
        self.kind() >= 8
    }
}

impl Picture {
    /// Its raster's place, channel, whether it is inverted, factor, wraps, filter, mapping.
    fn flatten(&self, rasters: &[u32], to: &mut Words) {
        to.id(rasters[self.image]);
        to.id(match self.channel {
            Channel::Rgb => 0,
            Channel::Mean => 1,
            Channel::Luminance => 2,
            Channel::Red => 3,
            Channel::Green => 4,
            Channel::Blue => 5,
        });
        to.flag(self.invert);
        to.number(self.scale);
        to.ids(self.lookup.wrap.map(|wrap| match wrap {
            Wrap::Repeat => 0,
            Wrap::Black => 1,
            Wrap::Clamp => 2,
            Wrap::Mirror => 3,
        }));
        to.flag(self.lookup.filter == Interpolation::Nearest);
        self.mapping.flatten(to);
    }
}
