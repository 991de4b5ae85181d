//! Shapes that no picture needs: without area, on a line, at absurd places.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::scene::*;

/// A ball on a floor under a lamp; `junk`: triangles of the floor's mesh that have no area.
fn plain(junk: &[[[f32; 3]; 3]]) -> Scene {
    let mut scene = empty(look([0.0, 1.5, 5.0], [0.0, 0.5, 0.0], 40.0), 24);
    let grey = material(&mut scene, diffuse(0.6));
    let metal = material(&mut scene, mirror_metal(0.2));
    let up = DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let floor = square(&mut scene, 3.0, up, grey);
    scene.shapes.push(floor);
    let mesh = &mut scene.meshes[0];
    mesh.normals = vec![[0.0, 0.0, 1.0]; mesh.positions.len()];
    mesh.uvs = mesh.positions.iter().map(|p| [p[0], p[1]]).collect();
    for corners in junk {
        let first = u32::try_from(mesh.positions.len()).expect("a small mesh");
        mesh.positions.extend(corners);
        mesh.normals.extend([[0.0; 3]; 3]);
        mesh.uvs.extend([[0.5; 2]; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
        // The same vertex three times, and twice.
        mesh.triangles.push([first; 3]);
        mesh.triangles.push([first, first + 1, first]);
    }
    scene.shapes.push(sphere(0.7, [0.0, 0.7, 0.0], metal));
    let down = DMat4::from_translation(DVec3::new(0.5, 3.0, 1.0))
        * DMat4::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let lamp = square(&mut scene, 0.5, down, grey);
    scene.shapes.push(emitting(lamp, 8.0));
    scene.lights.push(constant_sky(0.1));
    scene
}

const JUNK: [[[f32; 3]; 3]; 7] = [
    // A point, in view of the camera; lines; the last one is as long as `f32` allows.
    [[0.2, 0.1, 0.3]; 3],
    [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]],
    [[-1.0, 0.0, 0.5], [1.0, 0.0, 0.5], [0.0, 0.0, 0.5]],
    [[0.0, 0.0, 0.25], [0.0, 0.0, 0.5], [0.0, 0.0, 0.75]],
    [[1e-40, 0.0, 0.0], [0.0, 1e-40, 0.0], [0.0, 0.0, 0.0]],
    [[1e-20, 0.0, 0.1], [2e-20, 0.0, 0.1], [3e-20, 0.0, 0.1]],
    [[0.0, 0.0, -1e11], [0.0, 0.0, 0.0], [0.0, 0.0, 1e11]],
];

/// A render of which nothing is checked but that all of it is finite.
fn rendered(scene: &Scene) -> Picture {
    let picture = render(scene, 16, 6, Strategy::Mis);
    assert_eq!(picture.non_finite_count(), 0);
    picture
}

#[test]
fn triangles_without_area_change_nothing() {
    let with = rendered(&plain(&JUNK));
    let without = rendered(&plain(&[]));
    // The third is as thin as a line, but floats of 32 bits give it an area.
    assert_eq!(with.colour, without.colour);
    assert_eq!(with.normal, without.normal);
    assert_eq!(with.depth, without.depth);
}

/// Lamps without area send out nothing, and take no samples from the others.
#[test]
fn lamps_without_area_are_dark() {
    let mut scene = plain(&[]);
    let reference = render(&scene, 64, 6, Strategy::Mis);
    for corners in JUNK {
        scene.meshes.push(Mesh {
            positions: corners.to_vec(),
            triangles: vec![[0, 1, 2], [0, 0, 0], [2, 1, 2]],
            ..Mesh::default()
        });
        let geometry = Geometry::Mesh(MeshId(scene.meshes.len() - 1));
        let lamp = shape(geometry, DMat4::IDENTITY, MaterialId(0));
        scene.shapes.push(emitting(lamp, 1e6));
    }
    let picture = render(&scene, 64, 6, Strategy::Mis);
    let results = [mean(&picture), mean(&reference)];
    assert_agree("with dark lamps", &results, 1, 0.02);
}

/// A mesh of nothing but lines, and an object of it that is instanced.
#[test]
fn meshes_without_area_are_nothing() {
    let mut scene = plain(&[]);
    let reference = rendered(&scene);
    scene.meshes.push(Mesh {
        positions: JUNK.concat(),
        triangles: (0..7).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    });
    let geometry = Geometry::Mesh(MeshId(scene.meshes.len() - 1));
    let line = shape(geometry, DMat4::IDENTITY, MaterialId(0));
    scene.shapes.push(line.clone());
    scene.objects.push(Object {
        name: "lines".to_owned(),
        shapes: vec![line],
    });
    scene.instances.push(ObjectInstance {
        object: ObjectId(0),
        to_world: DMat4::from_scale(DVec3::splat(0.5)),
        motion: None,
    });
    // Lines by rounding have instances of their own: the rest of the scene is in a tree then.
    for (a, b) in rendered(&scene).colour.iter().zip(&reference.colour) {
        let apart = (*a - *b).map(f32::abs).max_channel();
        assert!(apart <= 1e-4 * b.max_channel(), "{a:?} {b:?}");
    }
}

/// The error of a scene, or its picture.
fn attempt(scene: &Scene) -> Result<Picture, String> {
    let options = RenderOptions {
        max_depth: 6,
        ..RenderOptions::default()
    };
    match PreparedScene::new(scene, &options) {
        Err(e) => Err(e.to_string()),
        Ok(prepared) => {
            let mut renderer = Renderer::new(&prepared, options);
            let report = renderer.render_pass(16, &Default::default());
            assert_eq!(report.invalid_samples, 0);
            let picture = renderer.film().picture();
            assert_eq!(picture.non_finite_count(), 0);
            Ok(picture)
        }
    }
}

/// A floor that reaches to the horizon is right up to where lengths end, and then an error.
#[test]
fn huge_shapes_are_right_or_refused() {
    let floor = |half: f32, round: bool| {
        let mut scene = empty(look([0.0, 2.0, 0.0], [0.0, 1.0, -1.0], 20.0), 8);
        let grey = material(&mut scene, diffuse(0.5));
        let up = DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
        let ground = if round {
            shape(
                Geometry::Disk {
                    radius: half,
                    height: 0.0,
                },
                up,
                grey,
            )
        } else {
            square(&mut scene, half, up, grey)
        };
        scene.shapes.push(ground);
        scene.lights.push(Light::Distant {
            irradiance: Rgb::splat(2.0),
            to_light: [0.0, 1.0, 0.0],
            half_angle_deg: 0.0,
        });
        scene
    };
    let expected = 0.5 * 2.0 / std::f32::consts::PI;
    for round in [false, true] {
        for exponent in [1, 3, 6, 9, 12, 14] {
            let half = 10.0_f32.powi(exponent);
            let picture = attempt(&floor(half, round)).unwrap();
            // A triangle is known to a ten-millionth of its size: larger ones may miss the camera.
            let known = round || half < 1e7;
            for c in picture.colour {
                let right = (c.g / expected - 1.0).abs() < 1e-3;
                assert!(right || (!known && c.g == 0.0), "{half:e}: {c:?}");
            }
        }
        for half in [1e16, 1e20, 1e30, 1e38] {
            let error = attempt(&floor(half, round)).unwrap_err();
            assert!(error.contains("farther than 1e15 units"), "{error}");
        }
    }
    // A small shape that an instance makes huge, or carries away.
    for to_world in [
        DMat4::from_scale(DVec3::splat(1e30)),
        DMat4::from_translation(DVec3::splat(1e30)),
    ] {
        let mut scene = floor(1.0, true);
        let shapes = std::mem::take(&mut scene.shapes);
        scene.objects.push(Object {
            name: "floor".to_owned(),
            shapes,
        });
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world,
            motion: None,
        });
        assert!(attempt(&scene).unwrap_err().contains("farther"));
    }
}

/// Lights and cameras at the end of the range of `f32`: all values stay finite.
#[test]
fn distant_lights_and_cameras_make_no_nan() {
    for far in [1e12, 1e20, 1e30, 1e38] {
        let mut scene = plain(&[]);
        scene.lights.push(Light::Point {
            position: [far, far, far],
            intensity: Rgb::splat(1e30),
        });
        scene.lights.push(Light::Spot {
            position: [0.0, far, 0.0],
            axis: [0.0, -1.0, 0.0],
            intensity: Rgb::splat(1e30),
            cone_angle_deg: 30.0,
            falloff_start_deg: 20.0,
            falloff: SpotFalloff::SmoothCosine,
        });
        assert!(attempt(&scene).is_ok());
        scene.camera = look([far, far, far], [0.0; 3], 30.0);
        assert!(attempt(&scene).is_ok());
    }
}
