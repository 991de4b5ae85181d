//! Media of pbrt and Mitsuba: boundaries that name what absorbs on either side.
#![allow(
    clippy::cast_possible_truncation,
    reason = "scenes are in single precision"
)]

mod common;

use common::*;
use core::f64::consts::PI;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_scene::scene::*;

/// A boundary without surface, or another, between two media.
fn bounding(scene: &mut Scene, kind: MaterialKind, [inside, around]: [f32; 2]) -> MaterialId {
    let id = absorbing(scene, kind, inside);
    scene.materials[id.0].around = Some(Rgb::splat(around));
    id
}

/// Media between interfaces, a medium within another, and a bubble of empty space, whose outside
/// the file may turn inwards: absorption depends on where the path is and not on how it got there.
#[test]
fn interfaces_bound_what_absorbs() {
    for (inner, expected) in [(0.5_f32, -0.2 * 3.0 - 0.5), (0.0, -0.2 * 3.0)] {
        for turned in [false, true] {
            let mut scene = empty(look([0.0, 0.0, 9.0], [0.0; 3], 0.05), 8);
            let outer = bounding(&mut scene, MaterialKind::Interface, [0.2, 0.0]);
            body(&mut scene, 20.0, [0.0, 4.0], outer);
            let first = scene.shapes.len();
            let sides = if turned { [0.2, inner] } else { [inner, 0.2] };
            let inner = bounding(&mut scene, MaterialKind::Interface, sides);
            body(&mut scene, 20.0, [1.0, 2.0], inner);
            for shape in &mut scene.shapes[first..] {
                shape.reverse_orientation = turned;
            }
            scene.lights.push(constant_sky(1.0));
            // Interfaces do not count as bounces.
            let picture = render(&scene, 4, 1, Strategy::Mis);
            assert_mean("interfaces", &picture, f64::exp(expected), 1e-4);
        }
    }
}

/// A lit floor below a slab of absorption without surface: lights are seen through it, dimmed by
/// the part of their way that is in it.
#[test]
fn shadow_rays_pass_interfaces_and_are_dimmed_between_them() {
    let sigma = 0.4_f32;
    let mut scene = empty(look([1.5, 0.0, 9.0], [1.5, 0.0, 0.0], 0.05), 8);
    let m = bounding(&mut scene, MaterialKind::Interface, [sigma, 0.0]);
    body(&mut scene, 8.0, [1.0, 2.5], m);
    let white = material(&mut scene, diffuse(0.5));
    let floor = square(&mut scene, 4.0, DMat4::IDENTITY, white);
    scene.shapes.push(floor);
    let centre = [0.0, 0.0, 4.0];
    // A point above the slab: 1.5 of the view's way and 1.5 / cos of the light's are in it.
    let mut point = scene.clone();
    point.lights.push(Light::Point {
        position: centre,
        intensity: Rgb::splat(1.0),
    });
    let distance = DVec3::from(centre).distance(DVec3::new(1.5, 0.0, 0.0));
    let cosine = 4.0 / distance;
    let expected = 0.5 / PI * cosine / (distance * distance)
        * (-f64::from(sigma) * 1.5 * (1.0 + 1.0 / cosine)).exp();
    let picture = render(&point, 64, 1, Strategy::Mis);
    assert_mean("point above", &picture, expected, 1e-3);
    // A lamp there, hit by directions of lobes as well.
    let lamp = material(&mut scene, diffuse(0.0));
    scene.shapes.push(emitting(sphere(0.5, centre, lamp), 3.0));
    let results = [
        (Strategy::Mis, 1024),
        (Strategy::LightsOnly, 1024),
        (Strategy::BsdfOnly, 16384),
    ]
    .map(|(strategy, spp)| mean(&render(&scene, spp, 2, strategy)));
    assert_agree("lamp above", &results, 0, 0.02);
}

/// A lamp within a body of rough, absorbing glass, seen from outside: what the lobe and the light
/// find is dimmed by the same way within.
#[test]
fn lights_beyond_a_rough_boundary_are_dimmed_within_it() {
    let mut scene = empty(look([0.0, 0.0, 9.0], [0.0; 3], 10.0), 8);
    let m = bounding(&mut scene, glass(0.5), [0.6, 0.0]);
    scene.shapes.push(sphere(2.0, [0.0; 3], m));
    let lamp = material(&mut scene, diffuse(0.0));
    scene
        .shapes
        .push(emitting(sphere(0.5, [0.0; 3], lamp), 3.0));
    let results = [
        (Strategy::Mis, 1024),
        (Strategy::LightsOnly, 4096),
        (Strategy::BsdfOnly, 4096),
    ]
    .map(|(strategy, spp)| mean(&render(&scene, spp, 3, strategy)));
    assert_agree("lamp in rough glass", &results, 0, 0.02);
}

/// Panes and translucent sheets bound media too; opaque surfaces and boundaries of a world in which
/// nothing absorbs change nothing.
#[test]
fn panes_bound_media() {
    let pane = MaterialKind::ThinDielectric {
        eta: 1.0,
        reflection_tint: ColourParam::WHITE,
        transmission_tint: ColourParam::WHITE,
    };
    for (inside, expected) in [(0.3_f32, f64::exp(-0.3 * 2.0)), (0.0, 1.0)] {
        let mut scene = empty(look([0.0, 0.0, 9.0], [0.0; 3], 0.05), 8);
        let m = bounding(&mut scene, pane, [inside, 0.0]);
        body(&mut scene, 20.0, [0.0, 2.0], m);
        scene.lights.push(constant_sky(1.0));
        let picture = render(&scene, 16, 8, Strategy::Mis);
        assert_mean("panes", &picture, expected, 1e-4);
    }
}
