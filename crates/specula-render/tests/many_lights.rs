//! Scenes where the choice of the light matters: strategies agree, and noise stays low.

mod common;

use common::*;
use glam::DMat4;
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_scene::scene::*;

fn floor() -> Scene {
    let mut scene = empty(look([3.0, 0.0, 3.0], [0.0; 3], 0.05), 8);
    let m = material(&mut scene, diffuse(0.5));
    let floor = square(&mut scene, 50.0, DMat4::IDENTITY, m);
    scene.shapes.push(floor);
    scene
}

/// The far light has 1000 times the power of the near one and a tenth of its irradiance: a choice
/// by power would leave an error of 25 %.
#[test]
fn a_strong_light_far_away_does_not_hide_a_weak_one_nearby() {
    let mut scene = floor();
    for (height, intensity) in [(100.0, 1000.0), (1.0, 1.0)] {
        scene.lights.push(Light::Point {
            position: [0.0, 0.0, height],
            intensity: Rgb::splat(intensity),
        });
    }
    let picture = render(&scene, 256, 1, Strategy::Mis);
    assert_mean(
        "near and far",
        &picture,
        1.1 * 0.5 / core::f64::consts::PI,
        1e-3,
    );
}

/// Above, next to the horizon, and mostly below it: the weights of what a lobe finds depend on the
/// normal at the vertex before.
#[test]
fn strategies_agree_where_the_normal_decides_among_lights() {
    let mut scene = floor();
    let m = MaterialId(0);
    let lamps = [
        (1.0, [0.0, 0.0, 3.0], 1.0),
        (2.0, [6.0, 0.0, 0.5], 8.0),
        (3.0, [0.0, 8.0, -2.0], 10.0),
    ];
    for (radius, centre, radiance) in lamps {
        scene
            .shapes
            .push(emitting(sphere(radius, centre, m), radiance));
    }
    for sky in [None, Some(constant_sky(0.5))] {
        scene.lights.extend(sky);
        let results = [
            (Strategy::Mis, 8192),
            (Strategy::Balance, 8192),
            (Strategy::LightsOnly, 8192),
            (Strategy::BsdfOnly, 16384),
        ]
        .map(|(strategy, spp)| mean(&render(&scene, spp, 1, strategy)));
        assert_agree("where the normal decides", &results, 2, 0.005);
    }
}
