//! Textures against values by hand, and graphs that share their nodes.

use super::*;
use glam::{DMat4, DVec3};
use specula_bsdf::math::{rgb, vec3};
use specula_scene::scene::{ColourParam, ImageId, Interpolation, TextureMapping, UvMapping, Wrap};
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

fn at(t: &Textures, index: usize, place: TextureCoordinates) -> Rgb<f32> {
    t.colour(ColourParam::Texture(TextureId(index)), &place)
}

fn uv(u: f32, v: f32) -> TextureCoordinates {
    TextureCoordinates {
        uv: [u, v],
        ..TextureCoordinates::default()
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
        let place = TextureCoordinates {
            position: Vec3::from(p),
            ..TextureCoordinates::default()
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
    let place = TextureCoordinates {
        uv: [0.25, 0.5],
        position: vec3(0.4, 0.3, 0.2),
        normal: vec3(0.8, 0.0, -0.6),
        colour: rgb(0.1, 0.2, 0.3),
        ..TextureCoordinates::default()
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
