//! Emission that varies over a shape, against closed forms, by every strategy.

mod common;

use common::*;
use core::f64::consts::PI;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_scene::Image;
use specula_scene::scene::*;

const ALBEDO: f64 = 0.5;

const BY_LIGHTS: [(Strategy, u32); 2] = [(Strategy::Mis, 1024), (Strategy::LightsOnly, 1024)];
const BY_LOBES: [(Strategy, u32); 1] = [(Strategy::BsdfOnly, 8192)];

fn check(what: &str, scene: &Scene, irradiance: f64, strategies: &[(Strategy, u32)]) {
    for &(strategy, spp) in strategies {
        let picture = render(scene, spp, 1, strategy);
        let what = format!("{what}, {strategy:?}");
        assert_mean(&what, &picture, irradiance * ALBEDO / PI, 1e-3);
    }
}

fn facing_down(height: f64) -> DMat4 {
    DMat4::from_translation(DVec3::new(0.0, 0.0, height)) * DMat4::from_rotation_x(PI)
}

/// A picture with its value per pixel, in nearest lookup.
fn picture(width: u32, values: &[f32]) -> (Image, Texture) {
    let image = Image {
        name: "lamp".into(),
        width,
        height: u32::try_from(values.len()).expect("it is small") / width,
        pixels: values.iter().map(|&v| [v; 3]).collect(),
    };
    let texture = Texture::Image {
        image: ImageId(0),
        mapping: TextureMapping::default(),
        wrap: [Wrap::Clamp; 2],
        filter: Interpolation::Nearest,
        invert: false,
        scale: 1.0,
        channel: Channel::Rgb,
    };
    (image, texture)
}

/// Half width 1 above the origin, the coordinates of its corners as given.
fn lamp(scene: &mut Scene, to_world: DMat4, values: &[f32], width: u32) -> Shape {
    let (image, texture) = picture(width, values);
    scene.images.push(image);
    scene.textures.push(texture);
    let m = material(scene, diffuse(0.0));
    let square = square(scene, 1.0, to_world, m);
    let mesh = scene.meshes.last_mut().expect("it was just added");
    mesh.uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Shape {
        emission: Some(Emission {
            radiance: ColourParam::Texture(TextureId(0)),
            two_sided: false,
        }),
        ..square
    }
}

/// Irradiance at the origin from the part `[x0, x1] x [y0, y1]` of the plane at height `h`, with
/// radiance 1: by the integral of `h^2 / (x^2 + y^2 + h^2)^2`.
fn patch(x: [f64; 2], y: [f64; 2], h: f64) -> f64 {
    let n = 400;
    let mut sum = 0.0;
    for i in 0..n * n {
        let at = |range: [f64; 2], k: u32| {
            range[0] + (range[1] - range[0]) * (f64::from(k) + 0.5) / f64::from(n)
        };
        let (px, py) = (at(x, i % n), at(y, i / n));
        sum += h * h / (px * px + py * py + h * h).powi(2);
    }
    sum * (x[1] - x[0]) * (y[1] - y[0]) / f64::from(n * n)
}

/// One pixel in 64 emits, at a place that tells every mirror and every order of the axes apart.
#[test]
fn one_bright_pixel_lights_from_where_it_is() {
    let mut values = [0.0_f32; 64];
    // Column 6, row 1 from the top: u in [6/8, 7/8], v in [6/8, 7/8]; and a weaker one.
    values[8 + 6] = 50.0;
    values[8 * 5] = 10.0;
    let u = |k: f64| k / 4.0 - 1.0;
    // The square is turned about the x axis: v runs along -y.
    let bright = patch([u(6.0), u(7.0)], [u(1.0), u(2.0)], 2.0);
    let weak = patch([u(0.0), u(1.0)], [u(5.0), u(6.0)], 2.0);
    let irradiance = 50.0 * bright + 10.0 * weak;
    for mirrored in [false, true] {
        let mut scene = lit_floor();
        let turn = if mirrored {
            DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0))
        } else {
            DMat4::IDENTITY
        };
        let mut shape = lamp(&mut scene, DMat4::IDENTITY, &values, 8);
        if mirrored {
            // The picture is mirrored back by its coordinates.
            for uv in &mut scene.meshes.last_mut().unwrap().uvs {
                uv[0] = 1.0 - uv[0];
            }
        }
        shape.to_world = DMat4::IDENTITY;
        scene.objects.push(Object {
            name: "lamp".into(),
            shapes: vec![shape],
        });
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: facing_down(2.0) * turn,
            motion: None,
        });
        check(
            &format!("mirrored: {mirrored}"),
            &scene,
            irradiance,
            &BY_LIGHTS,
        );
    }
}

/// The table of bright cells pays: without it, 1 sample in 42 would hit the light.
#[test]
fn bright_parts_are_sampled_more() {
    let mut values = [0.0_f32; 64];
    values[8 + 6] = 50.0;
    let mut scene = lit_floor();
    let shape = lamp(&mut scene, facing_down(2.0), &values, 8);
    scene.shapes.push(shape);
    let (mean, error) = mean(&render(&scene, 256, 1, Strategy::LightsOnly));
    // Uniform points: relative variance 63 per sample of 64 pixels.
    let uniform = (63.0_f64 / (256.0 * 64.0)).sqrt();
    assert!(error / mean < 0.25 * uniform, "{mean} {error}");
}

/// Emission by the position in the world: spheres and disks have no table.
#[test]
fn spheres_and_disks_emit_by_the_place_too() {
    // Halves: shining where x > 0 only, of a disk above the origin: half of the whole.
    let mut scene = lit_floor();
    let m = material(&mut scene, diffuse(0.0));
    scene.textures.extend([
        Texture::Constant(Rgb::splat(4.0)),
        Texture::Constant(Rgb::BLACK),
        Texture::Checkerboard3d {
            even: TextureId(0),
            odd: TextureId(1),
            // Checks of 100 in width: 0 <= x < 100 is even.
            to_texture: DMat4::from_scale(DVec3::splat(0.01))
                * DMat4::from_translation(DVec3::new(0.0, 50.0, 50.0)),
        },
    ]);
    let emission = Some(Emission {
        radiance: ColourParam::Texture(TextureId(2)),
        two_sided: false,
    });
    let disk = Geometry::Disk {
        radius: 1.0,
        height: 0.0,
    };
    scene.shapes.push(Shape {
        emission,
        ..shape(disk, facing_down(2.0), m)
    });
    let half = 0.5 * 4.0 * PI / 5.0;
    check("half a disk", &scene, half, &BY_LIGHTS);
    check("half a disk", &scene, half, &BY_LOBES);
    scene.shapes[1] = Shape {
        emission,
        ..sphere(1.0, [0.0, 0.0, 3.0], m)
    };
    let half = 0.5 * 4.0 * PI / 9.0;
    check("half a sphere", &scene, half, &BY_LIGHTS);
    check("half a sphere", &scene, half, &BY_LOBES);
}

/// A veil of opacity 1/4 that emits: a quarter of its light, by every strategy, and what is behind
/// it for the rest.
#[test]
fn partly_transparent_lamps_emit_as_much_as_they_are_there() {
    for textured in [false, true] {
        let mut scene = lit_floor();
        let m = material(&mut scene, diffuse(0.0));
        let disk = Geometry::Disk {
            radius: 1.0,
            height: 0.0,
        };
        let mut veil = emitting(shape(disk, facing_down(2.0), m), 4.0);
        veil.alpha = if textured {
            scene.textures.push(Texture::VertexColour);
            scene.textures.push(Texture::Constant(Rgb::splat(0.25)));
            // 1 times 1/4, yet not folded.
            scene.textures.push(Texture::Scale {
                a: TextureId(0),
                b: TextureId(1),
            });
            FloatParam::Texture(TextureId(2))
        } else {
            FloatParam::Value(0.25)
        };
        scene.shapes.push(veil);
        scene.lights.push(constant_sky(0.5));
        let share = PI / 5.0;
        let irradiance = 0.25 * 4.0 * share + 0.5 * (PI - 0.25 * share);
        for (strategy, spp) in [(Strategy::Mis, 4096), (Strategy::LightsOnly, 4096)] {
            let picture = render(&scene, spp, 1, strategy);
            let expected = irradiance * ALBEDO / PI;
            assert_mean(
                &format!("{textured}, {strategy:?}"),
                &picture,
                expected,
                1e-3,
            );
        }
    }
}

/// The lamp itself, seen: its picture, upright as textures are.
#[test]
fn a_lamp_shows_its_picture() {
    let camera = look([0.0, 0.0, -3.0], [0.0; 3], 20.0);
    let mut scene = empty(camera, 2);
    let shape = lamp(
        &mut scene,
        DMat4::from_rotation_y(PI),
        &[1.0, 2.0, 3.0, 4.0],
        2,
    );
    scene.shapes.push(shape);
    let seen = render(&scene, 4, 0, Strategy::Mis).colour;
    // The camera's x runs along the world's, and the half turn has reversed u against it.
    let found: Vec<f32> = seen.iter().map(|c| c.g).collect();
    assert_eq!(found, [2.0, 1.0, 4.0, 3.0]);
}

/// A quarter of the lamp's picture is NaN and below 0: it is black there.
#[test]
fn broken_values_are_black() {
    let mut scene = lit_floor();
    let shape = lamp(&mut scene, facing_down(2.0), &[f32::NAN, -3.0, 1.0, 1.0], 2);
    scene.shapes.push(shape);
    let picture = render(&scene, 256, 1, Strategy::Mis);
    let half = patch([-1.0, 1.0], [0.0, 1.0], 2.0);
    assert_mean("broken", &picture, half * ALBEDO / PI, 1e-3);
}

/// What Mitsuba 3.9.1 shows: shapes that emit let the camera's rays pass until these have hit
/// something else, light from infinity is black as long as they went straight, and both still light
/// what they lit.
#[test]
fn hidden_lights_light_without_being_seen() {
    let scene = |set: &dyn Fn(&mut Scene)| {
        let mut scene = empty(look([0.0, 0.0, 5.0], [0.0; 3], 1.0), 4);
        material(&mut scene, diffuse(0.5));
        set(&mut scene);
        scene.settings.hide_emitters = true;
        let (found, _) = mean(&render(&scene, 1024, 4, Strategy::Mis));
        scene.settings.hide_emitters = false;
        (found, mean(&render(&scene, 1024, 4, Strategy::Mis)).0)
    };
    let lamp = |scene: &mut Scene| {
        let lamp = square(scene, 1.0, DMat4::IDENTITY, MaterialId(0));
        scene.shapes.push(emitting(lamp, 2.0));
    };
    let sky = |scene: &mut Scene| scene.lights.push(constant_sky(1.0));
    let wall = |scene: &mut Scene, z: f64, kind: MaterialKind, alpha: f32| {
        let m = material(scene, kind);
        let at = DMat4::from_translation(DVec3::new(0.0, 0.0, z));
        let mut wall = square(scene, 4.0, at, m);
        wall.alpha = FloatParam::Value(alpha);
        scene.shapes.push(wall);
    };
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 0.03, "{found} {expected}");
    };
    let (hidden, _) = scene(&|s| {
        lamp(s);
        sky(s);
    });
    assert_eq!(hidden, 0.0);
    let (hidden, shown) = scene(&|s| {
        sky(s);
        wall(s, -1.0, diffuse(0.5), 1.0);
    });
    near(hidden, 0.5);
    assert_eq!(hidden, shown);
    // Behind the lamp's unlit back: the wall under a sky that the lamp covers in part.
    let (hidden, shown) = scene(&|s| {
        lamp(s);
        sky(s);
        wall(s, -1.0, diffuse(0.5), 1.0);
    });
    assert!(
        (0.1..0.5).contains(&hidden) && shown > 2.0,
        "{hidden} {shown}"
    );
    // Through a pane, only what it reflects; through holes, lamps but no sky.
    let pane = MaterialKind::ThinDielectric {
        eta: 1.5,
        reflection_tint: ColourParam::WHITE,
        transmission_tint: ColourParam::WHITE,
    };
    let (hidden, shown) = scene(&|s| {
        sky(s);
        wall(s, 2.0, pane, 1.0);
    });
    near(hidden, 2.0 * 0.04 / 1.04);
    near(shown, 1.0);
    let (hidden, shown) = scene(&|s| {
        sky(s);
        wall(s, 2.0, diffuse(0.0), 0.3);
    });
    assert_eq!(hidden, 0.0);
    near(shown, 0.7);
    let (hidden, _) = scene(&|s| {
        lamp(s);
        wall(s, 2.0, diffuse(0.0), 0.3);
    });
    near(hidden, 1.4);
}
