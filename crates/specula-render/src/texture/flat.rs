//! Textures as words for shaders.
//!
//! A node is a record that begins with its kind. Its inputs are offsets of other records, which come before it. Shaders follow them without recursion (`texture_graph.wgsl`).

use specula_bsdf::Rgb;
use specula_scene::scene::{
    Channel, ColourParam, FloatParam, Interpolation, NoiseKind, TextureId, Wrap,
};

use super::graph::{Node, Picture};
use super::{Textures, finite, noise};
use crate::codes::{self, NONE};
use crate::convert::id;
use crate::words::Words;

/// Nodes that may wait for their inputs at the same time in a shader.
const MOST_WAITING: u32 = 32;

/// Most nodes that a shader evaluates for one value, each as often as others refer to it.
const MOST_VISITS: u32 = 4096;

/// A colour parameter in 4 words: the index of a texture, or [`NONE`] and the value.
pub(crate) fn colour_parameter(to: &mut Words, parameter: ColourParam) {
    let (texture, value) = match parameter {
        ColourParam::Value(c) => (NONE, c.map(finite)),
        ColourParam::Texture(texture) => (id(texture.0), Rgb::BLACK),
    };
    to.id(texture);
    to.colour(value);
}

/// A scalar parameter in 2 words: the index of a texture, or [`NONE`] and the value.
pub(crate) fn float_parameter(to: &mut Words, parameter: FloatParam) {
    let (texture, value) = match parameter {
        FloatParam::Value(v) => (NONE, finite(v)),
        FloatParam::Texture(texture) => (id(texture.0), 0.0),
    };
    to.id(texture);
    to.number(value);
}

impl Textures {
    /// Pictures, nodes, then a table of the nodes' offsets.
    ///
    /// Constants say what shaders can leave out: `TEXTURE_COUNT`, `TEXTURE_HAS_INPUTS`,
    /// `TEXTURE_HAS_NOISE`, `TEXTURES_ARE_FILTERED`, `NORMAL_MAPS_ARE_FILTERED`, and `TEXTURE_WAITING`, the size of
    /// their stack.
    ///
    /// Returns features that shaders do not support, in words for a message.
    pub(crate) fn flatten(&self, to: &mut Words) -> Vec<String> {
        let rasters: Vec<RasterPlace> = self
            .rasters
            .iter()
            .map(|raster| {
                let at = raster.flatten(to);
                RasterPlace {
                    at,
                    pyramid: raster.flatten_pyramid(at, to),
                }
            })
            .collect();
        let mut records = Records::default();
        for node in &self.nodes {
            records.add(node, &rasters, to);
        }
        to.begin("TEXTURES");
        to.ids(records.places);
        let mut missing = Vec::new();
        let waiting = records.waiting.iter().copied().max().unwrap_or(0);
        if waiting > MOST_WAITING {
            missing.push(format!(
                "textures that are nested more than {MOST_WAITING} deep"
            ));
        }
        if self.extents.iter().any(|e| e.visits > MOST_VISITS) {
            missing.push(format!(
                "textures that share inputs so often that they unfold to more than {MOST_VISITS}"
            ));
        }
        let has_noise = self
            .nodes
            .iter()
            .any(|n| matches!(n, Node::Noise { .. } | Node::Dots { .. }));
        if has_noise {
            noise::flatten(to);
        } else {
            noise::leave_out(to);
        }
        for (name, value) in [
            ("TEXTURE_COUNT", id(self.nodes.len())),
            (
                "TEXTURE_HAS_INPUTS",
                u32::from(self.nodes.iter().any(Node::has_inputs)),
            ),
            ("TEXTURE_HAS_NOISE", u32::from(has_noise)),
            ("TEXTURES_ARE_FILTERED", u32::from(self.is_filtered)),
            (
                "NORMAL_MAPS_ARE_FILTERED",
                u32::from(!self.normal_maps.is_empty()),
            ),
            ("TEXTURE_WAITING", waiting.clamp(1, MOST_WAITING)),
        ] {
            to.constant(name, value);
        }
        missing
    }
}

/// Where a picture is.
struct RasterPlace {
    /// Its pixels.
    at: u32,
    /// Its pyramid; [`NONE`] where it has none.
    pyramid: u32,
}

/// Nodes that were written.
#[derive(Default)]
struct Records {
    places: Vec<u32>,
    /// How many nodes wait for their inputs at the same time while one is evaluated, by node.
    waiting: Vec<u32>,
}

impl Records {
    fn add(&mut self, node: &Node, rasters: &[RasterPlace], to: &mut Words) {
        let [first, second] = node.inputs();
        let deepest = node.all_inputs().map(|input| self.waiting[input.0]).max();
        self.waiting
            .push(deepest.unwrap_or(0) + u32::from(node.waits()));
        let place = |input: TextureId| self.places[input.0];
        let here = to.offset();
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
                    NoiseKind::Fbm => (codes::TEXTURE_NOISE_FBM, [1.0, 0.0]),
                    NoiseKind::Turbulence => (codes::TEXTURE_NOISE_TURBULENCE, [1.0, 0.0]),
                    NoiseKind::Windy => (codes::TEXTURE_NOISE_WINDY, [1.0, 0.0]),
                    NoiseKind::Marble { scale, variation } => {
                        (codes::TEXTURE_NOISE_MARBLE, [scale, variation])
                    }
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
    /// Its code.
    fn kind(&self) -> u32 {
        match self {
            Self::Constant(_) => codes::TEXTURE_CONSTANT,
            Self::Image(_) => codes::TEXTURE_IMAGE,
            Self::Bilinear { .. } => codes::TEXTURE_BILINEAR,
            Self::Noise { .. } => codes::TEXTURE_NOISE,
            Self::VertexColour => codes::TEXTURE_VERTEX_COLOUR,
            Self::Checkerboard { .. } => codes::TEXTURE_CHECKERBOARD,
            Self::Checkerboard3d { .. } => codes::TEXTURE_CHECKERBOARD_SOLID,
            Self::Dots { .. } => codes::TEXTURE_DOTS,
            Self::Scale(..) => codes::TEXTURE_SCALE,
            Self::Sum(..) => codes::TEXTURE_SUM,
            Self::Mix { .. } => codes::TEXTURE_MIX,
            Self::Threshold { .. } => codes::TEXTURE_THRESHOLD,
            Self::DirectionMix { .. } => codes::TEXTURE_DIRECTION_MIX,
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

    /// All nodes that it refers to.
    pub(super) fn all_inputs(&self) -> impl Iterator<Item = TextureId> {
        let [first, second] = self.inputs();
        [first, second, self.amount()].into_iter().flatten()
    }

    fn has_inputs(&self) -> bool {
        self.inputs()[0].is_some()
    }

    /// Whether its value is computed from its inputs' values, rather than one of these.
    fn waits(&self) -> bool {
        self.kind() >= codes::TEXTURE_SCALE
    }
}

impl Picture {
    /// Offset of its raster, channel, whether it is inverted, factor, wraps, filter, offset of its pyramid, largest
    /// anisotropy, mapping.
    fn flatten(&self, rasters: &[RasterPlace], to: &mut Words) {
        let RasterPlace { at, pyramid } = rasters[self.image];
        to.id(at);
        to.id(match self.channel {
            Channel::Rgb => codes::TEXTURE_CHANNEL_RGB,
            Channel::Mean => codes::TEXTURE_CHANNEL_MEAN,
            Channel::Luminance => codes::TEXTURE_CHANNEL_LUMINANCE,
            Channel::Red => codes::TEXTURE_CHANNEL_RED,
            Channel::Green => codes::TEXTURE_CHANNEL_GREEN,
            Channel::Blue => codes::TEXTURE_CHANNEL_BLUE,
        });
        to.flag(self.invert);
        to.number(self.scale);
        to.ids(self.lookup.wrap.map(|wrap| match wrap {
            Wrap::Repeat => codes::TEXTURE_RASTER_REPEAT,
            Wrap::Black => codes::TEXTURE_RASTER_BLACK,
            Wrap::Clamp => codes::TEXTURE_RASTER_CLAMP,
            Wrap::Mirror => codes::TEXTURE_RASTER_MIRROR,
        }));
        let (filter, max_anisotropy) = match self.lookup.filter {
            Interpolation::Bilinear => (codes::TEXTURE_FILTER_BILINEAR, 1.0),
            Interpolation::Nearest => (codes::TEXTURE_FILTER_NEAREST, 1.0),
            Interpolation::Trilinear => (codes::TEXTURE_FILTER_TRILINEAR, 1.0),
            Interpolation::Ewa { max_anisotropy } => (codes::TEXTURE_FILTER_EWA, max_anisotropy),
        };
        let means_only = match self.lookup.means_only {
            true => codes::TEXTURE_FILTER_MEANS_ONLY,
            false => 0,
        };
        to.ids([filter + means_only, pyramid]);
        to.number(max_anisotropy);
        self.mapping.flatten(to);
    }
}
