//! Furnaces: closed forms for light that bounces in closed rooms and around lone objects.

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_render::Strategy;
use specula_scene::scene::*;

/// From within a closed sphere, everything looks alike: `L = sum_{i <= depth} a^i`.
#[test]
fn a_closed_sphere_shows_the_truncated_series() {
    for (albedo, depth) in [(0.5_f32, 0), (0.5, 1), (0.5, 4), (0.8, 30)] {
        let mut scene = empty(look([0.1, 0.2, 0.0], [0.0, 0.0, 1.0], 90.0), 8);
        let m = material(&mut scene, diffuse(albedo));
        let mut wall = emitting(sphere(1.0, [0.0; 3], m), 1.0);
        // Its inside sends out light.
        wall.reverse_orientation = true;
        scene.shapes.push(wall);
        let expected: f64 = (0..=depth).map(|i| f64::from(albedo).powi(i)).sum();
        let depth = depth.unsigned_abs();
        assert_mean(
            "sphere",
            &render(&scene, 256, depth, Strategy::Mis),
            expected,
            1e-4,
        );
    }
}

/// The same in a box of triangles, which also has corners.
#[test]
fn a_closed_box_shows_the_truncated_series() {
    let mut scene = empty(look([0.1, 0.2, -0.3], [0.0, 0.1, 1.0], 90.0), 8);
    let m = material(&mut scene, diffuse(0.5));
    let half_turn = core::f64::consts::PI;
    let turns = [
        DMat4::IDENTITY,
        DMat4::from_rotation_x(half_turn),
        DMat4::from_rotation_x(half_turn / 2.0),
        DMat4::from_rotation_x(-half_turn / 2.0),
        DMat4::from_rotation_y(half_turn / 2.0),
        DMat4::from_rotation_y(-half_turn / 2.0),
    ];
    for turn in turns {
        let place = turn * DMat4::from_translation(DVec3::new(0.0, 0.0, -1.0));
        let wall = square(&mut scene, 1.0, place, m);
        scene.shapes.push(emitting(wall, 1.0));
    }
    let expected: f64 = (0..=6).map(|i| 0.5_f64.powi(i)).sum();
    assert_mean(
        "box",
        &render(&scene, 512, 6, Strategy::Mis),
        expected,
        1e-4,
    );
}

fn thin_glass() -> MaterialKind {
    MaterialKind::ThinDielectric {
        eta: 1.5,
        reflection_tint: ColourParam::WHITE,
        transmission_tint: ColourParam::WHITE,
    }
}

/// Objects that absorb nothing vanish in a uniform sky, at every scale and place.
#[test]
fn what_absorbs_nothing_vanishes_in_a_uniform_sky() {
    let kinds = [
        ("diffuse", diffuse(1.0)),
        ("mirror", mirror_metal(0.0)),
        ("rough metal", mirror_metal(0.03)),
        ("glass", glass(0.0)),
        ("thin glass", thin_glass()),
    ];
    for (name, kind) in kinds {
        for (scale, shift) in [(1.0, 0.0), (1e-3, 0.0), (1e4, 0.0), (1.0, 300.0)] {
            let centre = [shift, 0.0, 0.0];
            let from = [shift, 0.0, -4.0 * scale];
            let mut scene = empty(look(from, centre, 35.0), 16);
            let m = material(&mut scene, kind);
            #[allow(
                clippy::cast_possible_truncation,
                reason = "a radius of the list above"
            )]
            scene.shapes.push(sphere(scale as f32, centre, m));
            scene.lights.push(constant_sky(1.0));
            let picture = render(&scene, 64, 100, Strategy::Mis);
            let what = format!("{name} at scale {scale}, shifted {shift}");
            assert_mean(&what, &picture, 1.0, 4e-3);
        }
    }
}

/// Coarse spheres with smooth normals of rough metal: shading normals face away near the
/// silhouettes, yet nothing is black, and nothing is brighter than the sky.
#[test]
fn backfacing_shading_normals_give_no_black_pixels() {
    for a in [0.2_f32, 0.5, 1.0] {
        let mut scene = empty(look([0.0, 0.0, -4.0], [0.0; 3], 32.0), 48);
        let m = material(&mut scene, mirror_metal(a));
        scene.meshes.push(coarse_sphere(2));
        let ball = shape(Geometry::Mesh(MeshId(0)), DMat4::IDENTITY, m);
        scene.shapes.push(ball);
        scene.lights.push(constant_sky(1.0));
        let picture = render(&scene, 64, 1, Strategy::Mis);
        let mut backfacing = 0;
        for (i, c) in picture.colour.iter().enumerate() {
            assert!(c.g > 0.02, "alpha {a}: pixel {i} is black: {}", c.g);
            let error = f64::from(picture.variance[i].g).sqrt();
            assert!(
                f64::from(c.g) < 1.002 + 5.0 * error,
                "alpha {a}: pixel {i}: {}",
                c.g
            );
            let raster = [i % 48, i / 48].map(|v| (v as f32 + 0.5) / 24.0 - 1.0);
            let spread = 16.0_f32.to_radians().tan();
            let n = picture.normal[i];
            let along = n.x * raster[0] * spread - n.y * raster[1] * spread + n.z;
            backfacing += u32::from(picture.depth[i] > 0.0 && along > 0.0);
        }
        assert!(
            backfacing > 5,
            "the scene shows {backfacing} backfacing normals only"
        );
    }
}

/// An octahedron, its faces split in four `levels` times, with the normals of the sphere around it.
fn coarse_sphere(levels: u32) -> Mesh {
    let mut faces = Vec::new();
    for (x, y, z) in [0, 1, 2, 3, 4, 5, 6, 7].map(|i| (i & 1, i >> 1 & 1, i >> 2)) {
        let sign = |bit: i32| f64::from(1 - 2 * bit);
        let [a, b, c] = [DVec3::X * sign(x), DVec3::Y * sign(y), DVec3::Z * sign(z)];
        faces.push(if (x + y + z) % 2 == 0 {
            [a, b, c]
        } else {
            [a, c, b]
        });
    }
    for _ in 0..levels {
        let split = |[a, b, c]: [DVec3; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(split).collect();
    }
    let mut mesh = Mesh::default();
    for (i, corners) in (0_u32..).zip(faces) {
        let corners = corners.map(|p| p.as_vec3().to_array());
        mesh.positions.extend(corners);
        mesh.triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    mesh.normals.clone_from(&mesh.positions);
    mesh
}

/// Glass whose outside the file, a mirror or an instance's mirror turned: energy is conserved, and
/// the slab shifts no light from a uniform sky.
#[test]
fn mirrored_and_instanced_glass_conserves_energy() {
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    for (shape_m, instance_m) in [
        (DMat4::IDENTITY, DMat4::IDENTITY),
        (mirror, DMat4::IDENTITY),
        (DMat4::IDENTITY, mirror),
        (mirror, mirror * DMat4::from_rotation_y(0.4)),
    ] {
        let mut scene = empty(look([0.0, 0.0, -4.0], [0.0; 3], 35.0), 12);
        let m = material(&mut scene, glass(0.0));
        scene.meshes.push(coarse_sphere(0));
        scene.meshes[0].normals.clear();
        scene.objects.push(Object {
            name: "gem".into(),
            shapes: vec![shape(Geometry::Mesh(MeshId(0)), shape_m, m)],
        });
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: instance_m,
            motion: None,
        });
        scene.lights.push(constant_sky(1.0));
        assert_mean("gem", &render(&scene, 64, 200, Strategy::Mis), 1.0, 4e-3);
    }
}
