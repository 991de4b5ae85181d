//! Filtered normals beside sums over footprints.

use specula_bsdf::math::Stream;
use specula_scene::Image;
use specula_scene::scene::*;

use super::*;
use crate::texture::Footprint;

const SIDE: u32 = 64;

/// A normal map of waves of eight pixels and more.
fn scene(filter: Interpolation) -> Scene {
    let colours = (0..SIDE * SIDE).map(|i| {
        let [x, y] = [i % SIDE, i / SIDE].map(|k| k as f32 / SIDE as f32);
        let wave = |a: f32, b: f32| (core::f32::consts::TAU * (a * x + b * y)).sin();
        let p = 0.3 * wave(7.0, 1.0) + 0.2 * wave(3.0, -5.0);
        let q = 0.15 * wave(2.0, 6.0) + 0.5 * p;
        [0.5 + 0.5 * p, 0.5 + 0.5 * q, 1.0]
    });
    let mut scene = specula_scene::builtin::orbs();
    scene.images = vec![Image {
        name: "normals".into(),
        width: SIDE,
        height: SIDE,
        pixels: colours.collect(),
    }];
    scene.textures = vec![Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Repeat; 2],
        filter,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    }];
    let bump = Bump::Normal {
        map: TextureId(0),
        scale: 1.0,
    };
    scene.materials[0].bump = Some(bump);
    scene
}

fn textures(filter: Interpolation) -> Textures {
    let mut scene = scene(filter);
    let mut textures = Textures::new(&mut scene);
    textures.filter_normal_maps(&scene);
    textures
}

/// A place with a footprint of these half axes, in pixels.
fn place(uv: [f32; 2], axes: [[f32; 2]; 2]) -> TextureCoordinates {
    let uv_axes = axes.map(|a| a.map(|x| x / SIDE as f32));
    TextureCoordinates {
        uv,
        footprint: Some(Footprint {
            uv: uv_axes,
            ..Footprint::default()
        }),
        ..TextureCoordinates::default()
    }
}

fn moments(textures: &Textures, place: &TextureCoordinates) -> NormalMoments {
    let (_, moments) = textures.normal(TextureId(0), place);
    moments.expect("the footprint is larger than a pixel")
}

/// Moments of slopes of interpolated normals, by many points of the map: each weighs what the pixels weigh that have a
/// share in it, Gaussian weights over the ellipse, to whose matrix 1 is added.
fn brute_force(textures: &Textures, at: [f32; 2], axes: [[f32; 2]; 2]) -> [f64; 5] {
    const POINTS: i16 = 12;
    let map = textures
        .filtered_normal_map(TextureId(0))
        .expect("filtered");
    let side = SIDE as f32;
    let middle = [side * at[0], side * (1.0 - at[1])];
    // Rows run downwards.
    let sum = |i: usize, j: usize| axes[0][i] * axes[0][j] + axes[1][i] * axes[1][j];
    let (xx, xy, yy) = (sum(0, 0) + 1.0, -sum(0, 1), sum(1, 1) + 1.0);
    let of_pixel = |[x, y]: [f32; 2]| {
        let (dx, dy) = (x + 0.5 - middle[0], y + 0.5 - middle[1]);
        let squared = (yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
        ((-2.0 * squared).exp() - (-2.0_f32).exp()).max(0.0)
    };
    let reach = POINTS * 11;
    let (mut sums, mut total) = ([0.0; 5], 0.0);
    for i in -reach..=reach {
        for j in -reach..=reach {
            let offset = [i, j].map(|k| f32::from(k) / f32::from(POINTS));
            let [x, y] = [0, 1].map(|c| middle[c] + offset[c]);
            let [left, above] = [x, y].map(|c| (c - 0.5).floor());
            let (u, v) = (x - 0.5 - left, y - 0.5 - above);
            let row = |y: f32| of_pixel([left, y]) * (1.0 - u) + of_pixel([left + 1.0, y]) * u;
            let weight = f64::from(row(above) * (1.0 - v) + row(above + 1.0) * v);
            let there = TextureCoordinates {
                uv: [x / side, 1.0 - y / side],
                ..TextureCoordinates::default()
            };
            let c = textures.colour(ColourParam::Texture(map.normals), &there);
            let [p, q] = slope_of(normal_of(c)).map(f64::from);
            for (sum, v) in sums.iter_mut().zip([p, q, p * p, p * q, q * q]) {
                *sum += weight * v;
            }
            total += weight;
        }
    }
    sums.map(|sum| sum / total)
}

/// What EWA finds in the pictures of moments against sums over footprints, of circles and of ellipses that are turned,
/// where it takes the pictures of full size.
#[test]
fn moments_over_footprints_are_those_of_brute_force() {
    let textures = textures(Interpolation::EWA);
    let mut places = Stream::new(2);
    for axes in [
        [[1.0, 0.0], [0.0, 1.0]],
        [[6.0, 4.5], [-0.6, 0.8]],
        [[0.0, 3.0], [1.0, 0.0]],
    ] {
        for _ in 0..4 {
            let at = [places.next(), places.next()];
            let NormalMoments { mean, squares } = moments(&textures, &place(at, axes));
            let found = [mean[0], mean[1], squares[0], squares[1], squares[2]].map(f64::from);
            let expected = brute_force(&textures, at, axes);
            // Slopes are up to 0.5.
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 2e-3,
                    "{axes:?}: {found} {expected}"
                );
            }
        }
    }
}

/// What footprints under half a pixel see are the interpolated normals, without moments; from there on variances grow
/// without a step.
#[test]
fn magnified_maps_do_not_get_rougher() {
    for filter in [Interpolation::EWA, Interpolation::Trilinear] {
        let textures = textures(filter);
        let mut places = Stream::new(9);
        for _ in 0..50 {
            let at = [places.next(), places.next()];
            let circle = |radius| place(at, [[radius, 0.0], [0.0, radius]]);
            let map = textures
                .filtered_normal_map(TextureId(0))
                .expect("filtered");
            let c = textures.colour(ColourParam::Texture(map.normals), &circle(0.49));
            let expected = (normal_of(c), None);
            assert_eq!(textures.normal(TextureId(0), &circle(0.49)), expected);
            assert_eq!(textures.normal(TextureId(0), &circle(0.0)), expected);
            let nowhere = TextureCoordinates {
                footprint: None,
                ..circle(5.0)
            };
            assert_eq!(textures.normal(TextureId(0), &nowhere), expected);
            let NormalMoments { mean, squares } = moments(&textures, &circle(0.501));
            let [p, q] = slope_of(normal_of(c));
            let off = (mean[0] - p).abs().max((mean[1] - q).abs());
            assert!(off < 0.004, "{filter:?}: {off}");
            let variance = squares[0] - mean[0] * mean[0];
            assert!(variance.abs() < 1e-3, "{filter:?}: {variance}");
        }
    }
}

/// Bilinear maps are filtered by EWA, trilinear ones as they are, nearest pixels not at all.
#[test]
fn filters_are_those_of_the_map() {
    let at = place([0.3, 0.6], [[20.0, 0.0], [0.0, 2.0]]);
    let [ewa, bilinear, trilinear] = [
        Interpolation::EWA,
        Interpolation::Bilinear,
        Interpolation::Trilinear,
    ]
    .map(|filter| moments(&textures(filter), &at));
    assert_eq!(ewa, bilinear);
    assert_ne!(ewa, trilinear);
    let nearest = textures(Interpolation::Nearest);
    assert!(!nearest.is_filtered());
    assert_eq!(nearest.normal(TextureId(0), &at).1, None);
    let mut scene = scene(Interpolation::EWA);
    let without = Textures::new(&mut scene);
    assert_eq!(without.normal(TextureId(0), &at).1, None);
}

/// Two textures of one picture share its moments, unless they read it otherwise.
#[test]
fn moments_of_a_picture_are_made_once() {
    let mut scene = scene(Interpolation::EWA);
    let pixels = |scene: &Scene| moment_pixels(scene);
    let one = pixels(&scene);
    assert_eq!(one, 4096 + 1024 + 256 + 64 + 16 + 4 + 1);
    scene.textures.push(scene.textures[0].clone());
    let bump = Bump::Normal {
        map: TextureId(1),
        scale: 0.5,
    };
    scene.materials[1].bump = Some(bump);
    assert_eq!(pixels(&scene), one);
    let count = |scene: &Scene| {
        let mut textures = Textures::new(&mut scene.clone());
        textures.filter_normal_maps(scene);
        textures.rasters.len()
    };
    assert_eq!(count(&scene), 3);
    if let Texture::Image { wrap, .. } = &mut scene.textures[1] {
        *wrap = [Wrap::Clamp; 2];
    }
    assert_eq!(pixels(&scene), 2 * one);
    assert_eq!(count(&scene), 5);
}
