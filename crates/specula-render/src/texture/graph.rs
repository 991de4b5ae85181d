//! Graphs of texture nodes: folded once, evaluated at every hit.

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{Channel, FloatParam, NoiseKind, Texture, TextureId};

use super::mapping::Mapping;
use super::raster::Lookup;
use super::{TextureCoordinates, Textures, finite, noise};
use crate::convert::{Affine, floor_i32};

/// A texture node, its transforms in single precision.
#[derive(Clone, Debug)]
pub(super) enum Node {
    Constant(Rgb<f32>),
    Image(Picture),
    Scale(TextureId, TextureId),
    Sum(TextureId, TextureId),
    Mix {
        a: TextureId,
        b: TextureId,
        amount: FloatParam,
    },
    Checkerboard {
        even: TextureId,
        odd: TextureId,
        mapping: Mapping,
    },
    Checkerboard3d {
        even: TextureId,
        odd: TextureId,
        to_texture: Affine,
    },
    Bilinear {
        corners: [Rgb<f32>; 4],
        mapping: Mapping,
    },
    Dots {
        inside: TextureId,
        outside: TextureId,
        mapping: Mapping,
    },
    Noise {
        kind: NoiseKind,
        octaves: u32,
        roughness: f32,
        to_texture: Affine,
    },
    Threshold {
        texture: TextureId,
        cutoff: f32,
    },
    DirectionMix {
        a: TextureId,
        b: TextureId,
        axis: Vec3<f32>,
    },
    VertexColour,
}

/// An image texture: a picture, and what is done to its values.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    pub(super) image: usize,
    pub(super) mapping: Mapping,
    pub(super) lookup: Lookup,
    pub(super) channel: Channel,
    pub(super) invert: bool,
    pub(super) scale: f32,
}

impl Node {
    pub(super) fn new(texture: &Texture) -> Self {
        match *texture {
            Texture::Constant(c) => Self::Constant(c),
            Texture::Image {
                image,
                ref mapping,
                wrap,
                filter,
                invert,
                scale,
                channel,
            } => Self::Image(Picture {
                image: image.0,
                mapping: Mapping::new(mapping),
                lookup: Lookup {
                    wrap,
                    filter,
                    means_only: false,
                },
                channel,
                invert,
                scale,
            }),
            Texture::Scale { a, b } => Self::Scale(a, b),
            Texture::Sum { a, b } => Self::Sum(a, b),
            Texture::Mix { a, b, amount } => Self::Mix { a, b, amount },
            Texture::Checkerboard {
                even,
                odd,
                ref mapping,
            } => Self::Checkerboard {
                even,
                odd,
                mapping: Mapping::new(mapping),
            },
            Texture::Checkerboard3d {
                even,
                odd,
                ref to_texture,
            } => Self::Checkerboard3d {
                even,
                odd,
                to_texture: Affine::new(to_texture),
            },
            Texture::Bilinear {
                corners,
                ref mapping,
            } => Self::Bilinear {
                corners,
                mapping: Mapping::new(mapping),
            },
            Texture::Dots {
                inside,
                outside,
                ref mapping,
            } => Self::Dots {
                inside,
                outside,
                mapping: Mapping::new(mapping),
            },
            Texture::Noise {
                kind,
                octaves,
                roughness,
                ref to_texture,
            } => Self::Noise {
                kind,
                octaves,
                roughness,
                to_texture: Affine::new(to_texture),
            },
            Texture::Threshold { texture, cutoff } => Self::Threshold { texture, cutoff },
            Texture::DirectionMix { a, b, axis } => Self::DirectionMix {
                a,
                b,
                axis: Vec3::from(axis),
            },
            Texture::VertexColour => Self::VertexColour,
        }
    }
}

impl Textures {
    /// The node, simplified by those before it: its input where that has all the weight, or a constant where it is the
    /// same everywhere.
    pub(super) fn folded(&self, node: Node) -> Node {
        let node = match node {
            Node::Mix { a, b, amount } => match self.fold_float(amount) {
                FloatParam::Value(t) if t <= 0.0 => self.nodes[a.0].clone(),
                FloatParam::Value(t) if t >= 1.0 => self.nodes[b.0].clone(),
                amount => Node::Mix { a, b, amount },
            },
            other => other,
        };
        let constant = |id: TextureId| match self.nodes[id.0] {
            Node::Constant(c) => Some(c),
            _ => None,
        };
        let both = |a, b| Some((constant(a)?, constant(b)?));
        let same = |a, b| both(a, b).filter(|(a, b)| a == b).map(|(a, _)| a);
        let value = match node {
            Node::Scale(a, b) => both(a, b).map(|(a, b)| a * b),
            Node::Sum(a, b) => both(a, b).map(|(a, b)| a + b),
            Node::Mix { a, b, amount } => match amount {
                FloatParam::Value(t) => both(a, b).map(|(a, b)| mixed(a, b, t)),
                FloatParam::Texture(_) => same(a, b),
            },
            Node::Threshold { texture, cutoff } => constant(texture).map(|c| step(c, cutoff)),
            Node::Checkerboard { even, odd, .. } | Node::Checkerboard3d { even, odd, .. } => {
                same(even, odd)
            }
            Node::Dots {
                inside, outside, ..
            } => same(inside, outside),
            Node::DirectionMix { a, b, .. } => same(a, b),
            Node::Bilinear { corners, .. } => {
                Some(corners[0]).filter(|c| corners.iter().all(|x| x == c))
            }
            Node::Constant(_) | Node::Image(_) | Node::Noise { .. } | Node::VertexColour => None,
        };
        value.map_or(node, Node::Constant)
    }

    /// The value of a node at a point, evaluated as a tree.
    pub(super) fn node(&self, index: usize, place: &TextureCoordinates) -> Rgb<f32> {
        self.value(index, place, |id| self.node(id.0, place))
    }

    /// The value of a node at a point.
    ///
    /// * `input`: value of an input.
    #[inline(always)]
    fn value(
        &self,
        index: usize,
        place: &TextureCoordinates,
        input: impl Fn(TextureId) -> Rgb<f32>,
    ) -> Rgb<f32> {
        match &self.nodes[index] {
            Node::Constant(c) => *c,
            Node::Image(picture) => self.picture(picture, place),
            Node::Scale(a, b) => input(*a) * input(*b),
            Node::Sum(a, b) => input(*a) + input(*b),
            Node::Mix { a, b, amount } => {
                let t = finite(match *amount {
                    FloatParam::Value(t) => t,
                    FloatParam::Texture(id) => input(id).r,
                });
                if t <= 0.0 {
                    input(*a)
                } else if t >= 1.0 {
                    input(*b)
                } else {
                    mixed(input(*a), input(*b), t)
                }
            }
            Node::Checkerboard { even, odd, mapping } => input(if is_even(&mapping.at(place)) {
                *even
            } else {
                *odd
            }),
            Node::Checkerboard3d {
                even,
                odd,
                to_texture,
            } => {
                let p = to_texture.point(place.position).to_array();
                input(if is_even(&p) { *even } else { *odd })
            }
            Node::Bilinear { corners, mapping } => {
                let [s, t] = mapping.at(place);
                mixed(
                    mixed(corners[0], corners[2], s),
                    mixed(corners[1], corners[3], s),
                    t,
                )
            }
            Node::Dots {
                inside,
                outside,
                mapping,
            } => input(if noise::in_dot(mapping.at(place)) {
                *inside
            } else {
                *outside
            }),
            Node::Noise {
                kind,
                octaves,
                roughness,
                to_texture,
            } => {
                let p = to_texture.point(place.position);
                match *kind {
                    NoiseKind::Fbm => Rgb::splat(noise::fbm(p, *roughness, *octaves)),
                    NoiseKind::Turbulence => Rgb::splat(noise::turbulence(p, *roughness, *octaves)),
                    NoiseKind::Windy => Rgb::splat(noise::windy(p)),
                    NoiseKind::Marble { scale, variation } => {
                        noise::marble(p * scale, variation, *roughness, *octaves)
                    }
                }
            }
            Node::Threshold { texture, cutoff } => step(input(*texture), *cutoff),
            Node::DirectionMix { a, b, axis } => {
                let t = place.normal.dot(*axis).abs();
                mixed(input(*b), input(*a), t)
            }
            Node::VertexColour => place.colour,
        }
    }

    /// [`Textures::node`], evaluated node by node in order: each once, however many others refer to it.
    ///
    /// * `first`: the first of the nodes that it depends on.
    pub(super) fn in_order(
        &self,
        first: usize,
        last: usize,
        place: &TextureCoordinates,
    ) -> Rgb<f32> {
        let nodes = &self.nodes[first..=last];
        let mut needed = vec![false; nodes.len()];
        needed[last - first] = true;
        for (i, node) in nodes.iter().enumerate().rev() {
            if needed[i] {
                for input in node.all_inputs() {
                    needed[input.0 - first] = true;
                }
            }
        }
        let mut values = vec![Rgb::BLACK; nodes.len()];
        for i in 0..nodes.len() {
            if needed[i] {
                values[i] = self.value(first + i, place, |id| values[id.0 - first]);
            }
        }
        values[last - first]
    }

    fn picture(&self, p: &Picture, place: &TextureCoordinates) -> Rgb<f32> {
        let (raster, st) = (&self.rasters[p.image], p.mapping.at(place));
        let pixel = match &place.footprint {
            Some(footprint) if p.lookup.filter.is_filtered() => {
                raster.filtered(st, p.mapping.axes(place, footprint), p.lookup)
            }
            _ if p.lookup.means_only => Rgb::BLACK,
            _ => raster.at(st, p.lookup),
        };
        p.value(pixel)
    }
}

impl Picture {
    /// The texture's value where the picture has this one.
    #[inline(always)]
    pub(super) fn value(&self, pixel: Rgb<f32>) -> Rgb<f32> {
        let c = self.channel.of(pixel);
        let c = if self.invert {
            c.map(|v| (1.0 - v).max(0.0))
        } else {
            c
        };
        c * self.scale
    }
}

/// Whether the sum of the floors of the coordinates is even.
fn is_even(coordinates: &[f32]) -> bool {
    let sum = coordinates
        .iter()
        .fold(0_i32, |sum, &x| sum.wrapping_add(floor_i32(x)));
    sum & 1 == 0
}

fn mixed(a: Rgb<f32>, b: Rgb<f32>, t: f32) -> Rgb<f32> {
    a * (1.0 - t) + b * t
}

fn step(c: Rgb<f32>, cutoff: f32) -> Rgb<f32> {
    c.map(|v| if finite(v) >= cutoff { 1.0 } else { 0.0 })
}

#[cfg(test)]
mod tests;
