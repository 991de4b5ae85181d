//! Cylinders and parts of spheres and disks: furnaces, and pictures beside those of their triangles.

mod common;

use std::sync::atomic::AtomicBool;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::scene::*;

fn parts() -> [(&'static str, QuadricPart); 4] {
    [
        (
            "bowl",
            QuadricPart::Sphere {
                radius: 1.0,
                z: [-1.0, 0.2],
                phi_max: QuadricPart::TURN,
            },
        ),
        (
            "slice of a sphere",
            QuadricPart::Sphere {
                radius: 1.0,
                z: [-0.6, 0.7],
                phi_max: 4.5,
            },
        ),
        (
            "cylinder",
            QuadricPart::Cylinder {
                radius: 0.8,
                z: [-0.9, 0.8],
                phi_max: QuadricPart::TURN,
            },
        ),
        (
            "ring",
            QuadricPart::Disk {
                radius: 1.0,
                inner: 0.4,
                height: 0.1,
                phi_max: 5.0,
            },
        ),
    ]
}

/// White parts vanish in a uniform sky, inside and outside, at every scale and place: no ray is lost at the surface it
/// leaves.
#[test]
fn white_parts_vanish_in_a_uniform_sky() {
    for (name, part) in parts() {
        for (kind, kind_name) in [(diffuse(1.0), "diffuse"), (mirror_metal(0.0), "mirror")] {
            for (scale, shift) in [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (1.0, 300.0)] {
                let centre = [shift, 0.0, 0.0];
                let from = [shift + scale, -3.0 * scale, 2.5 * scale];
                let mut scene = empty(look(from, centre, 35.0), 12);
                let m = material(&mut scene, kind);
                let place = DMat4::from_translation(centre.into())
                    * DMat4::from_rotation_y(0.4)
                    * DMat4::from_scale(DVec3::splat(scale));
                scene
                    .shapes
                    .push(shape(Geometry::QuadricPart(part), place, m));
                scene.lights.push(constant_sky(1.0));
                let picture = render(&scene, 32, 200, Strategy::Mis);
                let what = format!("{kind_name} {name} at scale {scale}, shifted {shift}");
                assert_mean(&what, &picture, 1.0, 2e-3);
            }
        }
    }
}

/// Textured, cut out by alpha, reversed, instanced and moving parts.
fn gallery(moves: bool) -> Scene {
    let mut scene = empty(look([0.5, -7.0, 4.0], [0.0; 3], 45.0), 64);
    scene.textures.extend([
        Texture::Constant(Rgb::splat(0.9)),
        Texture::Constant(Rgb::splat(0.1)),
        Texture::Constant(Rgb::BLACK),
        Texture::Constant(Rgb::WHITE),
    ]);
    let checks = |even, odd| Texture::Checkerboard {
        even: TextureId(even),
        odd: TextureId(odd),
        mapping: TextureMapping::Uv(UvMapping::scaled([8.0, 4.0], [0.0; 2])),
    };
    scene.textures.extend([checks(0, 1), checks(2, 3)]);
    let checked = MaterialKind::Diffuse {
        reflectance: ColourParam::Texture(TextureId(4)),
        roughness: FloatParam::Value(0.0),
    };
    let checked = material(&mut scene, checked);
    let brushed = material(&mut scene, brushed());
    let mut object = Object::default();
    for (i, (_, part)) in (0..).zip(parts()) {
        let at = |x: f64, z: f64| {
            DMat4::from_translation(DVec3::new(x, 0.0, z)) * DMat4::from_rotation_x(0.5)
        };
        let x = 2.2 * f64::from(i) - 3.3;
        let mut whole = shape(Geometry::QuadricPart(part), at(x, 1.2), checked);
        whole.reverse_orientation = i % 2 == 0;
        if i == 2 {
            whole.alpha = FloatParam::Texture(TextureId(5));
        }
        if moves {
            whole.motion = Some(Motion {
                end: at(x + 0.5, 1.2),
                times: [0.0, 1.0],
            });
        }
        scene.shapes.push(whole);
        object
            .shapes
            .push(shape(Geometry::QuadricPart(part), at(x, 0.0), brushed));
    }
    scene.objects.push(object);
    scene.instances.push(ObjectInstance {
        object: ObjectId(0),
        to_world: DMat4::from_translation(DVec3::new(0.0, 0.0, -1.2)) * DMat4::from_rotation_z(0.1),
        motion: None,
    });
    let lamp = QuadricPart::Cylinder {
        radius: 0.3,
        z: [-1.0, 1.0],
        phi_max: QuadricPart::TURN,
    };
    let place = DMat4::from_translation(DVec3::new(0.0, -3.0, 4.0));
    let lamp = shape(Geometry::QuadricPart(lamp), place, checked);
    scene.shapes.push(emitting(lamp, 20.0));
    scene.lights.push(constant_sky(0.3));
    scene
}

/// The mean absolute difference of the same samples by the exact shapes and by their triangles, and the mean.
#[test]
fn pictures_are_those_of_the_triangles() {
    for moves in [false, true] {
        let scene = gallery(moves);
        let [exact, triangles] = [false, true].map(|triangulate_exact_shapes| {
            let options = RenderOptions {
                samples_per_pixel: 16,
                max_depth: 4,
                triangulate_exact_shapes,
                ..RenderOptions::default()
            };
            let prepared = PreparedScene::new(&scene, &options).unwrap();
            assert!(prepared.light_count() > 500, "triangles of the lamp");
            let mut renderer = Renderer::new(&prepared, options);
            renderer.render_pass(16, &AtomicBool::new(false));
            renderer.film().picture()
        });
        let [(a, a_error), (b, b_error)] = [&exact, &triangles].map(mean);
        let z = (a - b) / a_error.hypot(b_error);
        assert!(
            z.abs() < 3.0 && (a / b - 1.0).abs() < 2e-3,
            "{a} +- {a_error}, {b} +- {b_error}"
        );
        // Of 8x8 tiles, whose errors are mostly common: nothing is inside out, turned or left out.
        for tile in 0..64_usize {
            let pixels = (0..64_usize).map(|i| (tile / 8 * 8 + i / 8) * 64 + tile % 8 * 8 + i % 8);
            let (mut sums, mut variance) = ([0.0; 2], 0.0);
            for i in pixels {
                for (sum, picture) in sums.iter_mut().zip([&exact, &triangles]) {
                    *sum += f64::from(picture.colour[i].g);
                    variance += f64::from(picture.variance[i].g);
                }
            }
            let difference = sums[0] - sums[1];
            assert!(
                difference.abs() < 4.5 * variance.sqrt() + 0.002 * sums[1],
                "{moves}, tile {tile}: {sums:?} +- {}",
                variance.sqrt()
            );
        }
    }
}
