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

/// Above, next to the horizon, and mostly below it: the weights of lights that a lobe's direction hits depend on the
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

/// Light is a sum over lights: of one light alone one is sampled, of several two where metal is rough.
#[test]
fn lights_of_rough_metal_add_up() {
    let seen = |lights: &[usize], energy: &str, hides: bool| {
        let mut scene = floor();
        scene.materials[0].kind = mirror_metal(0.4);
        scene.materials[0].energy = Some(energy.parse().expect("a known name"));
        // With hidden lights first vertices are shaded singly.
        scene.settings.hide_emitters = hides;
        // In front of the sky, lit or not.
        let mut lamp = sphere(0.7, [-4.0, 0.0, 4.0], MaterialId(0));
        for light in lights {
            match light {
                0 => scene.lights.push(constant_sky(0.3)),
                1 => scene.lights.push(Light::Point {
                    position: [-1.0, 0.5, 1.0],
                    intensity: Rgb::splat(2.0),
                }),
                _ => lamp = emitting(lamp, 3.0),
            }
        }
        scene.shapes.push(lamp);
        mean(&render(&scene, 2048, 1, Strategy::Mis))
    };
    for energy in ["none", "turquin", "multibounce=heitz"] {
        for hides in [false, true] {
            let [sky, point, lamp] = [0, 1, 2].map(|light| seen(&[light], energy, hides));
            let all = seen(&[0, 1, 2], energy, hides);
            let sum = sky.0 + point.0 + lamp.0;
            let error = [sky, point, lamp, all].map(|(_, e)| e * e);
            let error = error.iter().sum::<f64>().sqrt();
            let what = format!("{energy}, {hides}: {sky:?} {point:?} {lamp:?} {all:?}");
            for part in [sky, point, lamp] {
                assert!(part.0 > 0.05 * sum, "{what}");
            }
            assert!(error < 0.01 * sum, "too noisy: {what}");
            assert!((all.0 - sum).abs() < 4.5 * error, "{what}");
        }
    }
}
