//! Graphs of texture nodes: folded once, evaluated at every hit.

use specula_bsdf::{Rgb, Vec3};
use specula_scene::scene::{Channel, FloatParam, NoiseKind, Texture, TextureId};

use super::mapping::Mapping;
use super::raster::Lookup;
use super::{Place, Textures, finite, noise};
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

/// A picture and what is done to its values.
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
                lookup: Lookup { wrap, filter },
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
    /// The node, given those before it: the input that it always shows, or a constant where all that
    /// it shows is one.
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

    /// The value of a node at a place.
    pub(super) fn node(&self, index: usize, place: &Place) -> Rgb<f32> {
        self.value(index, place, |id| self.node(id.0, place))
    }

    /// The value of a node whose inputs have values.
    #[inline(always)]
    fn value(
        &self,
        index: usize,
        place: &Place,
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

    /// [`Textures::node`] with every node evaluated once, in order: what many nodes refer to takes no
    /// longer than what one does.
    ///
    /// * `first`: the first of the nodes that it depends on.
    pub(super) fn in_order(&self, first: usize, last: usize, place: &Place) -> Rgb<f32> {
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

    fn picture(&self, p: &Picture, place: &Place) -> Rgb<f32> {
        let c = self.rasters[p.image].at(p.mapping.at(place), p.lookup);
        let c = match p.channel {
            Channel::Rgb => c,
            Channel::Mean => Rgb::splat(c.mean()),
            Channel::Luminance => Rgb::splat(c.luminance()),
            Channel::Red => Rgb::splat(c.r),
            Channel::Green => Rgb::splat(c.g),
            Channel::Blue => Rgb::splat(c.b),
        };
        let c = if p.invert {
            c.map(|v| (1.0 - v).max(0.0))
        } else {
            c
        };
        c * p.scale
    }
}

/// Whether the floors of the coordinates have an even sum.
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
mod tests {
    use super::*;
    use glam::{DMat4, DVec3};
    use specula_bsdf::math::{rgb, vec3};
    use specula_scene::scene::{
        ColourParam, ImageId, Interpolation, TextureMapping, UvMapping, Wrap,
    };
    use specula_scene::{Image, builtin};

    fn textures(nodes: Vec<Texture>) -> Textures {
        let mut scene = builtin::orbs();
        scene.textures = nodes;
        scene.lights.clear();
        scene.images = vec![Image {
            name: "pixels".into(),
            width: 2,
            height: 1,
            pixels: vec![[0.1, 0.4, 0.7], [0.25, 0.5, 2.0]].into(),
        }];
        Textures::new(&mut scene)
    }

    fn image(channel: Channel, invert: bool, scale: f32) -> Texture {
        Texture::Image {
            image: ImageId(0),
            mapping: TextureMapping::default(),
            wrap: [Wrap::Clamp; 2],
            filter: Interpolation::Nearest,
            invert,
            scale,
            channel,
        }
    }

    fn constant(v: f32) -> Texture {
        Texture::Constant(Rgb::splat(v))
    }

    fn at(t: &Textures, index: usize, place: Place) -> Rgb<f32> {
        t.colour(ColourParam::Texture(TextureId(index)), &place)
    }

    fn uv(u: f32, v: f32) -> Place {
        Place {
            uv: [u, v],
            ..Place::default()
        }
    }

    const A: TextureId = TextureId(0);
    const B: TextureId = TextureId(1);

    #[test]
    fn channels_inversion_and_scale_apply_in_this_order() {
        let second = |channel| at(&textures(vec![image(channel, false, 1.0)]), 0, uv(0.9, 0.5));
        assert_eq!(second(Channel::Rgb).to_array(), [0.25, 0.5, 2.0]);
        for (channel, value) in [
            (Channel::Red, 0.25),
            (Channel::Green, 0.5),
            (Channel::Blue, 2.0),
            (Channel::Mean, 2.75 / 3.0),
            (Channel::Luminance, rgb(0.25, 0.5, 2.0).luminance()),
        ] {
            let found = second(channel).to_array();
            assert!(found.iter().all(|v| (v - value).abs() < 1e-6), "{found:?}");
        }
        let inverted = textures(vec![image(Channel::Rgb, true, 10.0)]);
        let found = at(&inverted, 0, uv(0.9, 0.5)).to_array();
        assert_eq!(found, [7.5, 5.0, 0.0]);
    }

    #[test]
    fn sums_products_and_mixes_combine() {
        let t = textures(vec![
            image(Channel::Red, false, 4.0),
            constant(6.0),
            Texture::Scale { a: A, b: B },
            Texture::Sum { a: A, b: B },
            Texture::Mix {
                a: A,
                b: B,
                amount: FloatParam::Value(0.25),
            },
            Texture::Mix {
                a: B,
                b: A,
                amount: FloatParam::Texture(A),
            },
            Texture::Threshold {
                texture: A,
                cutoff: 1.0,
            },
        ]);
        // The picture's red times 4: 0.4 on the left, 1 on the right.
        let both = |i| [0.2, 0.8].map(|u| at(&t, i, uv(u, 0.5)).g);
        let near = |found: [f32; 2], expected: [f32; 2]| {
            for (f, e) in found.into_iter().zip(expected) {
                assert!((f - e).abs() < 1e-6, "{found:?} instead of {expected:?}");
            }
        };
        near(both(2), [2.4, 6.0]);
        near(both(3), [6.4, 7.0]);
        near(both(4), [1.8, 2.25]);
        near(both(5), [0.6 * 6.0 + 0.4 * 0.4, 1.0]);
        near(both(6), [0.0, 1.0]);
    }

    #[test]
    fn checks_alternate_in_two_and_three_dimensions() {
        let t = textures(vec![
            constant(2.0),
            constant(6.0),
            Texture::Checkerboard {
                even: A,
                odd: B,
                mapping: TextureMapping::Uv(UvMapping::scaled([2.0; 2], [0.0; 2])),
            },
            Texture::Checkerboard3d {
                even: A,
                odd: B,
                to_texture: DMat4::from_scale(DVec3::splat(0.5)),
            },
        ]);
        let flat = |u, v| at(&t, 2, uv(u, v)).g;
        assert_eq!(
            [
                flat(0.1, 0.1),
                flat(0.6, 0.1),
                flat(-0.1, 0.1),
                flat(-0.1, 0.6)
            ],
            [2.0, 6.0, 6.0, 2.0]
        );
        for (p, even) in [
            ([0.1, 0.1, 0.1], true),
            ([2.1, 0.1, 0.1], false),
            ([2.1, -0.1, 0.1], true),
            ([2.1, -0.1, -1.9], false),
        ] {
            let place = Place {
                position: Vec3::from(p),
                ..Place::default()
            };
            assert_eq!(at(&t, 3, place).g == 2.0, even, "{p:?}");
        }
    }

    #[test]
    fn places_that_are_not_coordinates_count() {
        let t = textures(vec![
            constant(0.2),
            constant(0.8),
            Texture::DirectionMix {
                a: A,
                b: B,
                axis: [0.0, 0.0, 1.0],
            },
            Texture::VertexColour,
            Texture::Bilinear {
                corners: [1.0, 2.0, 3.0, 8.0].map(Rgb::splat),
                mapping: TextureMapping::default(),
            },
            Texture::Noise {
                kind: NoiseKind::Fbm,
                octaves: 1,
                roughness: 0.5,
                to_texture: DMat4::from_scale(DVec3::splat(2.0)),
            },
        ]);
        let place = Place {
            uv: [0.25, 0.5],
            position: vec3(0.4, 0.3, 0.2),
            normal: vec3(0.8, 0.0, -0.6),
            colour: rgb(0.1, 0.2, 0.3),
            ..Place::default()
        };
        assert!((at(&t, 2, place).g - (0.6 * 0.2 + 0.4 * 0.8)).abs() < 1e-6);
        assert_eq!(at(&t, 3, place), place.colour);
        // By hand: s = 1/4 between the corners of either row, then t = 1/2.
        assert!((at(&t, 4, place).g - 0.5 * (1.5 + 3.5)).abs() < 1e-6);
        let expected = noise::noise(vec3(0.8, 0.6, 0.4));
        assert_eq!(at(&t, 5, place).g, expected);
        assert!(t.shows_vertex_colours());
    }

    #[test]
    fn what_is_the_same_everywhere_is_folded() {
        let mapping = TextureMapping::default();
        let t = textures(vec![
            constant(0.5),
            constant(0.25),
            Texture::Scale { a: A, b: B },
            Texture::Sum { a: A, b: B },
            Texture::Mix {
                a: A,
                b: B,
                amount: FloatParam::Texture(A),
            },
            Texture::Threshold {
                texture: A,
                cutoff: 0.5,
            },
            Texture::Bilinear {
                corners: [Rgb::splat(3.0); 4],
                mapping,
            },
            Texture::Checkerboard {
                even: A,
                odd: A,
                mapping,
            },
            // Not folded.
            Texture::Checkerboard {
                even: A,
                odd: B,
                mapping,
            },
            image(Channel::Rgb, false, 1.0),
            Texture::Mix {
                a: TextureId(9),
                b: A,
                amount: FloatParam::Value(1.0),
            },
        ]);
        let fold = |i| t.fold_float(FloatParam::Texture(TextureId(i)));
        for (i, value) in [
            (2, 0.125),
            (3, 0.75),
            (4, 0.375),
            (5, 1.0),
            (6, 3.0),
            (7, 0.5),
            (10, 0.5),
        ] {
            assert_eq!(fold(i), FloatParam::Value(value), "{i}");
        }
        for i in [8, 9] {
            assert_eq!(fold(i), FloatParam::Texture(TextureId(i)));
        }
        let colour = t.fold_colour(ColourParam::Texture(TextureId(2)));
        assert_eq!(colour, ColourParam::Value(Rgb::splat(0.125)));
        assert!(!t.shows_vertex_colours());
    }

    #[test]
    fn graphs_that_share_their_nodes_take_no_longer_than_they_are_long() {
        let half = TextureId(0);
        let mut nodes = vec![image(Channel::Red, false, 1.0), constant(1.0)];
        let check = |even, odd| Texture::Checkerboard {
            even,
            odd,
            mapping: TextureMapping::default(),
        };
        for i in 0..40 {
            let a = TextureId(if i == 0 { 0 } else { i + 1 });
            nodes.push(match i % 4 {
                0 => Texture::Mix {
                    a,
                    b: a,
                    amount: FloatParam::Texture(a),
                },
                1 => check(a, half),
                _ => Texture::Mix {
                    a,
                    b: a,
                    amount: FloatParam::Value(0.5),
                },
            });
        }
        let t = textures(nodes);
        // As a tree it would have more than 2^30 nodes.
        let place = uv(0.2, 0.5);
        assert!((at(&t, 41, place).g - 0.1).abs() < 1e-6);
        // Small graphs go both ways to the same bits.
        for index in [2, 5, 8] {
            let tree = t.node(index, &place);
            assert_eq!(tree, t.in_order(0, index, &place), "{index}");
        }
    }

    #[test]
    fn long_chains_do_not_exhaust_the_stack() {
        let mut nodes = vec![image(Channel::Red, false, 4.0), constant(1.0)];
        for i in 0..200_000 {
            let a = TextureId(if i == 0 { 0 } else { i + 1 });
            nodes.push(Texture::Scale { a, b: B });
        }
        let t = textures(nodes);
        assert!((at(&t, 200_001, uv(0.2, 0.5)).g - 0.4).abs() < 1e-6);
    }
}
