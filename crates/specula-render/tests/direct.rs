//! Direct light on a white Lambert plane, against closed forms, by every strategy.

mod common;

use common::*;
use core::f64::consts::PI;
use core::sync::atomic::AtomicBool;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::Image;
use specula_scene::scene::*;

const ALBEDO: f64 = 0.5;

/// Renders by lights, by lobes and by both; all must be `irradiance * albedo / pi`.
fn check(what: &str, scene: &Scene, irradiance: f64, strategies: &[(Strategy, u32)]) {
    for &(strategy, spp) in strategies {
        let picture = render(scene, spp, 1, strategy);
        let what = format!("{what}, {strategy:?}");
        assert_mean(&what, &picture, irradiance * ALBEDO / PI, 1e-3);
    }
}

const ALL: [(Strategy, u32); 5] = [
    (Strategy::Mis, 1024),
    (Strategy::Balance, 1024),
    (Strategy::Power, 1024),
    (Strategy::LightsOnly, 1024),
    (Strategy::BsdfOnly, 4096),
];

/// A light that the camera does not see, for it lies behind.
fn facing_down(height: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(0.0, 0.0, height)) * DMat4::from_rotation_x(PI)
}

#[test]
fn a_sphere_light_gives_its_configuration_factor() {
    let mut scene = lit_floor();
    scene
        .shapes
        .push(emitting(sphere(1.0, [0.0, 0.0, 3.0], MaterialId(0)), 2.0));
    check("sphere", &scene, 2.0 * PI / 9.0, &ALL);
}

#[test]
fn a_far_small_sphere_light_keeps_its_digits() {
    let mut scene = lit_floor();
    let sun = sphere(10.0, [0.0, 0.0, 4000.0], MaterialId(0));
    scene.shapes.push(emitting(sun, 1e5));
    let irradiance = 1e5 * PI * (10.0_f64 / 4000.0).powi(2);
    check("far sphere", &scene, irradiance, &[(Strategy::Mis, 256)]);
}

#[test]
fn an_ellipsoid_light_gives_the_view_from_its_axis() {
    let mut scene = lit_floor();
    let m = DMat4::from_translation(DVec3::new(0.0, 0.0, 3.0))
        * DMat4::from_scale(DVec3::new(1.0, 1.0, 0.5));
    let light = shape(Geometry::Sphere { radius: 1.0 }, m, MaterialId(0));
    scene.shapes.push(emitting(light, 2.0));
    // The tangent cone of the spheroid: tan^2 = a^2 / (d^2 - c^2); E = pi L sin^2.
    let tan2 = 1.0 / (9.0 - 0.25);
    check("ellipsoid", &scene, 2.0 * PI * tan2 / (1.0 + tan2), &ALL);
}

#[test]
fn a_disk_light_gives_its_configuration_factor_and_no_light_behind_it() {
    let mut scene = lit_floor();
    let disk = Geometry::Disk {
        radius: 1.0,
        height: 0.0,
    };
    let light = emitting(shape(disk, facing_down(2.0), MaterialId(0)), 3.0);
    scene.shapes.push(light.clone());
    check("disk", &scene, 3.0 * PI / 5.0, &ALL);

    scene.shapes[1].reverse_orientation = true;
    let dark = render(&scene, 64, 1, Strategy::Mis);
    assert_eq!(mean(&dark).0, 0.0);
    scene.shapes[1].emission = light.emission.map(|e| Emission {
        two_sided: true,
        ..e
    });
    check("two-sided disk", &scene, 3.0 * PI / 5.0, &ALL[..1]);
}

/// Irradiance from a centred square of half width `a` at height `h`.
fn square_irradiance(a: f64, h: f64) -> f64 {
    let x = a / (a * a + h * h).sqrt();
    4.0 * x * (a / (a * a + h * h).sqrt()).atan()
}

#[test]
fn triangles_light_by_the_side_that_a_mirror_leaves_to_them() {
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    for extra in [DMat4::IDENTITY, mirror] {
        let mut scene = lit_floor();
        let light = square(&mut scene, 1.0, facing_down(2.0) * extra, MaterialId(0));
        scene.shapes.push(emitting(light, 1.0));
        check("square", &scene, square_irradiance(1.0, 2.0), &ALL);
    }
}

#[test]
fn instanced_and_mirrored_lights_emit_like_others() {
    let mirror = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
    for turn in [DMat4::IDENTITY, mirror] {
        let mut scene = lit_floor();
        let light = square(&mut scene, 1.0, DMat4::IDENTITY, MaterialId(0));
        scene.objects.push(Object {
            name: "lamp".into(),
            shapes: vec![emitting(light, 1.0)],
        });
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: facing_down(2.0) * turn,
            motion: None,
        });
        check("lamp", &scene, square_irradiance(1.0, 2.0), &ALL);
    }
}

#[test]
fn vertex_normals_decide_which_side_emits() {
    let mut scene = lit_floor();
    let light = square(&mut scene, 1.0, facing_down(2.0), MaterialId(0));
    // The winding says up, the normals say down.
    let mesh = &mut scene.meshes[1];
    mesh.triangles = vec![[0, 2, 1], [0, 3, 2]];
    mesh.normals = vec![[0.0, 0.0, 2.0]; 4];
    scene.shapes.push(emitting(light, 1.0));
    check("normals", &scene, square_irradiance(1.0, 2.0), &ALL[..1]);
}

#[test]
fn lights_without_extent_follow_their_laws() {
    let cases = [
        (
            Light::Point {
                position: [0.0, 0.0, 2.0],
                intensity: Rgb::splat(3.0),
            },
            3.0 / 4.0,
        ),
        (
            Light::Distant {
                irradiance: Rgb::splat(2.0),
                to_light: [0.6, 0.0, 0.8],
                half_angle_deg: 0.0,
            },
            1.6,
        ),
        (
            Light::Spot {
                position: [0.0, 0.0, 2.0],
                axis: [0.0, 0.0, -1.0],
                intensity: Rgb::splat(3.0),
                cone_angle_deg: 30.0,
                falloff_start_deg: 20.0,
                falloff: SpotFalloff::SmoothCosine,
            },
            3.0 / 4.0,
        ),
        // Halfway through the falloff in cosine: the smoothstep is 1/2.
        (
            Light::Spot {
                position: [0.0, 0.0, 2.0],
                axis: [0.6, 0.0, -0.8],
                intensity: Rgb::splat(3.0),
                cone_angle_deg: 0.7_f64.acos().to_degrees(),
                falloff_start_deg: 0.9_f64.acos().to_degrees(),
                falloff: SpotFalloff::SmoothCosine,
            },
            3.0 / 8.0,
        ),
        // Three quarters of the way out in angle.
        (
            Light::Spot {
                position: [0.0, 0.0, 2.0],
                axis: [0.35_f64.sin(), 0.0, -0.35_f64.cos()],
                intensity: Rgb::splat(3.0),
                cone_angle_deg: 0.4_f64.to_degrees(),
                falloff_start_deg: 0.2_f64.to_degrees(),
                falloff: SpotFalloff::LinearAngle,
            },
            3.0 / 16.0,
        ),
        // A quarter of the way in, in cosine: 1/16.
        (
            Light::Spot {
                position: [0.0, 0.0, 2.0],
                axis: [0.6, 0.0, -0.8],
                intensity: Rgb::splat(3.0),
                cone_angle_deg: 0.75_f64.acos().to_degrees(),
                falloff_start_deg: 0.95_f64.acos().to_degrees(),
                falloff: SpotFalloff::SquaredCosine,
            },
            3.0 / 64.0,
        ),
    ];
    for (light, irradiance) in cases {
        let mut scene = lit_floor();
        scene.lights.push(light);
        check(
            "delta",
            &scene,
            irradiance,
            &[(Strategy::Mis, 16), (Strategy::BsdfOnly, 16)],
        );
    }
}

/// Irradiance on a floor that the sun's disk is wholly above is its own times the cosine; lobes hit
/// it too, and a mirror and the camera see `E / (pi sin^2)`.
#[test]
fn suns_light_by_their_irradiance_and_are_seen() {
    for (half_angle, strategies) in [
        (
            0.5,
            &[(Strategy::Mis, 256), (Strategy::LightsOnly, 256)][..],
        ),
        (20.0, &ALL),
    ] {
        let sun = Light::Distant {
            irradiance: Rgb::splat(2.0),
            to_light: [0.6, 0.0, 0.8],
            half_angle_deg: half_angle,
        };
        let mut scene = lit_floor();
        scene.lights.push(sun.clone());
        check("sun", &scene, 1.6, strategies);

        let sin2 = half_angle.to_radians().sin().powi(2);
        let radiance = 2.0 / (PI * sin2);
        let mut seen = empty(look([0.0; 3], [0.6, 0.0, 0.8], 0.1), 4);
        seen.lights.push(sun.clone());
        assert_mean("seen", &render(&seen, 4, 1, Strategy::Mis), radiance, 1e-4);
        // In a mirror: the view comes down along the sun's reflection.
        let mut mirror = empty(look([-3.0, 0.0, 4.0], [0.0; 3], 0.1), 4);
        let m = material(&mut mirror, mirror_metal(0.0));
        let floor = square(&mut mirror, 5.0, DMat4::IDENTITY, m);
        mirror.shapes.push(floor);
        mirror.lights.push(sun);
        assert_mean(
            "mirrored",
            &render(&mirror, 4, 1, Strategy::Mis),
            radiance,
            1e-3,
        );
    }
}

/// The rim of the disk, by the share of a picture that it fills.
#[test]
fn the_suns_disk_is_as_large_as_it_says() {
    let mut scene = empty(look([0.0; 3], [0.0, 0.0, 1.0], 1.0), 64);
    scene.lights.push(Light::Distant {
        irradiance: Rgb::splat(1.0),
        to_light: [0.0, 0.0, 1.0],
        half_angle_deg: 0.2666,
    });
    let tan = |deg: f64| deg.to_radians().tan();
    let covered = PI * tan(0.2666).powi(2) / (2.0 * tan(0.5)).powi(2);
    let radiance = 1.0 / (PI * 0.2666_f64.to_radians().sin().powi(2));
    let picture = render(&scene, 64, 0, Strategy::Mis);
    assert_mean("disk", &picture, covered * radiance, 2e-3);
}

#[test]
fn several_lights_add_up() {
    let mut scene = lit_floor();
    scene
        .shapes
        .push(emitting(sphere(1.0, [0.0, 0.0, 3.0], MaterialId(0)), 2.0));
    scene.lights.push(Light::Point {
        position: [0.0, 0.0, 1.5],
        intensity: Rgb::splat(1.0),
    });
    scene.lights.push(constant_sky(0.25));
    // The sphere hides its own disk of the sky.
    let irradiance = 2.0 * PI / 9.0 + 1.0 / 2.25 + 0.25 * PI * (1.0 - 1.0 / 9.0);
    check(
        "three lights",
        &scene,
        irradiance,
        &[(Strategy::Mis, 8192), (Strategy::LightsOnly, 8192)],
    );
}

/// A picture with one bright pixel, a gradient and black parts.
fn sky_picture(width: u32, height: u32) -> Image {
    let mut pixels = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let v = match (x, y) {
                (5, 3) => 20.0,
                _ if x % 4 == 0 => 0.0,
                _ => 0.1 * (x + y) as f32,
            };
            pixels.push([v; 3]);
        }
    }
    Image {
        name: "sky".into(),
        width,
        height,
        pixels: pixels.into(),
    }
}

/// Pictures of the sky: the strategies must agree, since their closed form is themselves.
#[test]
fn skies_of_both_mappings_agree_by_all_strategies() {
    let mappings = [
        (EnvironmentMapping::EqualAreaOctahedral, 16, 16),
        (EnvironmentMapping::LatitudeLongitude, 24, 12),
    ];
    for (mapping, width, height) in mappings {
        let mut scene = lit_floor();
        scene.images.push(sky_picture(width, height));
        scene.lights.push(Light::Infinite {
            radiance: Rgb::splat(1.0),
            image: Some((ImageId(0), mapping)),
            to_world: DMat4::from_rotation_y(0.3) * DMat4::from_rotation_z(1.0),
        });
        let results = [
            (Strategy::Mis, 4096),
            (Strategy::LightsOnly, 4096),
            (Strategy::BsdfOnly, 8192),
        ]
        .map(|(strategy, spp)| mean(&render(&scene, spp, 1, strategy)));
        for (m, e) in results {
            assert!(e < 0.01 * m, "{mapping:?}: too noisy, {results:?}");
            let (m0, e0) = results[0];
            let z = (m - m0) / (e * e + e0 * e0).sqrt();
            assert!(z.abs() < 4.5, "{mapping:?}: {results:?}");
        }
    }
}

/// Lights that leave to lobes what is as bright everywhere: the same picture with less noise.
#[test]
fn compensation_takes_noise_off_a_sky_with_a_sun() {
    let mut scene = lit_floor();
    scene.camera = look([0.0, -2.5, 3.0], [0.0; 3], 6.0);
    scene.materials[0].kind = mirror_metal(0.3);
    let (width, height) = (64, 32);
    let mut pixels = vec![[0.5_f32; 3]; 64 * 32];
    pixels[6 * 64 + 20] = [600.0; 3];
    scene.images.push(Image {
        name: "sky".into(),
        width,
        height,
        pixels: pixels.into(),
    });
    scene.lights.push(Light::Infinite {
        radiance: Rgb::splat(1.0),
        image: Some((ImageId(0), EnvironmentMapping::LatitudeLongitude)),
        to_world: DMat4::IDENTITY,
    });
    let render = |mis_compensation: bool, seed: u32| {
        let options = RenderOptions {
            samples_per_pixel: 64,
            max_depth: 1,
            seed,
            mis_compensation,
            ..RenderOptions::default()
        };
        let prepared = PreparedScene::new(&scene, &options).expect("the scene is sound");
        let mut renderer = Renderer::new(&prepared, options);
        renderer.render_pass(64, &AtomicBool::new(false));
        renderer.film().picture()
    };
    let [[with, noise_with], [without, noise_without]] = [true, false].map(|compensated| {
        let [a, b] = [1, 2].map(|seed| render(compensated, seed));
        let apart = a.colour.iter().zip(&b.colour);
        let squares: f64 = apart.map(|(a, b)| f64::from(a.g - b.g).powi(2)).sum();
        [0.5 * (mean(&a).0 + mean(&b).0), squares]
    });
    assert!((with / without - 1.0).abs() < 0.01, "{with}, {without}");
    let ratio = noise_with / noise_without;
    assert!(ratio < 0.7, "{ratio}");
}

/// Strategies on a metal, where lobes and lights differ most; a wrong weight shows here.
#[test]
fn strategies_agree_on_rough_metal() {
    for a in [0.2_f32, 0.6] {
        let mut scene = lit_floor();
        scene.camera = look([0.0, -2.5, 3.0], [0.0; 3], 6.0);
        scene.materials[0].kind = mirror_metal(a);
        let lamp = material(&mut scene, diffuse(0.0));
        scene
            .shapes
            .push(emitting(sphere(0.7, [0.0, 2.5, 3.0], lamp), 2.0));
        let results = [
            (Strategy::Mis, 1024),
            (Strategy::Balance, 1024),
            (Strategy::LightsOnly, 4096),
            (Strategy::BsdfOnly, 16384),
            (Strategy::Power, 1024),
        ]
        .map(|(strategy, spp)| mean(&render(&scene, spp, 3, strategy)));
        assert_agree(&format!("alpha {a}"), &results, 0, 0.01);
        // The tests can tell: without weights, the two strategies together would count twice.
        let (both, e) = (results[2].0 + results[3].0, results[0].1);
        assert!((both - results[0].0) / e > 100.0);
    }
}
