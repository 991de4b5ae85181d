//! One scene in many units and places: the picture must not know them.

#![allow(
    clippy::cast_possible_truncation,
    reason = "scenes hold lengths in f32, places are computed in f64"
)]

mod common;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::Strategy;
use specula_render::picture::Picture;
use specula_scene::scene::*;
use specula_stat::image::{NoisyImage, compare};

/// Chance of a false alarm of each comparison.
const SIGNIFICANCE: f64 = 1e-4;

/// Where a scene of about 4 units is put, and in which unit.
#[derive(Clone, Copy, Debug)]
struct PlaceAndUnit {
    scale: f64,
    shift: [f64; 3],
}

impl PlaceAndUnit {
    const HERE: Self = Self {
        scale: 1.0,
        shift: [0.0; 3],
    };

    fn scaled(scale: f64) -> Self {
        Self {
            scale,
            ..Self::HERE
        }
    }

    /// Away by `distance` units, along no axis.
    fn moved(distance: f64) -> Self {
        Self {
            shift: [0.6, -0.64, 0.48].map(|x| x * distance),
            ..Self::HERE
        }
    }

    fn length(self, x: f64) -> f32 {
        (x * self.scale) as f32
    }

    fn point(self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| p[i] * self.scale + self.shift[i])
    }

    /// A transform of the scene's as one of this place, for geometry that has its own unit.
    fn rigid(self, m: DMat4) -> DMat4 {
        let mut placed = m;
        placed.w_axis = DVec3::from(self.point(m.w_axis.truncate().into())).extend(1.0);
        placed
    }

    fn mesh(self, mut mesh: Mesh) -> Mesh {
        for p in &mut mesh.positions {
            *p = p.map(|x| self.length(f64::from(x)));
        }
        mesh
    }

    fn camera(self, from: [f64; 3], to: [f64; 3], fov_deg: f64) -> Camera {
        // The direction from the scene's own values: far away, a difference would be rounded.
        let mut camera = look(from, to, fov_deg);
        camera.to_world = self.rigid(camera.to_world);
        camera
    }
}

/// A sphere of triangles with vertex normals.
fn ball(radius: f32) -> Mesh {
    let (rows, columns) = (24_u32, 48_u32);
    let mut mesh = Mesh::default();
    for i in 0..=rows {
        for j in 0..=columns {
            let theta = std::f32::consts::PI * i as f32 / rows as f32;
            let phi = std::f32::consts::TAU * j as f32 / columns as f32;
            let n = [
                theta.sin() * phi.cos(),
                theta.cos(),
                -theta.sin() * phi.sin(),
            ];
            mesh.normals.push(n);
            mesh.positions.push(n.map(|x| x * radius));
            mesh.uvs
                .push([j as f32 / columns as f32, i as f32 / rows as f32]);
        }
    }
    let at = |i: u32, j: u32| i * (columns + 1) + j;
    for i in 0..rows {
        for j in 0..columns {
            mesh.triangles
                .push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles
                .push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

fn quad(half: f32) -> Mesh {
    Mesh {
        positions: vec![
            [-half, -half, 0.0],
            [half, -half, 0.0],
            [half, half, 0.0],
            [-half, half, 0.0],
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

fn add_mesh(scene: &mut Scene, mesh: Mesh) -> Geometry {
    scene.meshes.push(mesh);
    Geometry::Mesh(MeshId(scene.meshes.len() - 1))
}

/// Spheres, a disk and meshes, one of them instanced; glass that absorbs, a rough metal; a lamp, a
/// point light and a little sky, seen through a lens.
fn still_life(at: PlaceAndUnit, size: u32) -> Scene {
    let mut camera = at.camera([0.3, 1.6, 4.0], [0.0, 0.4, 0.0], 40.0);
    camera.lens_radius = 0.01 * at.scale;
    camera.focal_distance = 4.0 * at.scale;
    let mut scene = empty(camera, size);
    let floor = material(&mut scene, diffuse(0.6));
    let metal = material(&mut scene, mirror_metal(0.25));
    let clear = material(&mut scene, glass(0.0));
    scene.materials[clear.0].absorption = Rgb::splat((0.8 / at.scale) as f32);
    let red = material(&mut scene, diffuse(0.4));

    let up = DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let ground = add_mesh(&mut scene, at.mesh(quad(2.0)));
    scene.shapes.push(shape(ground, at.rigid(up), floor));
    let wall = DMat4::from_translation(DVec3::new(0.0, 1.0, -1.5));
    let back = add_mesh(&mut scene, at.mesh(quad(2.0)));
    scene.shapes.push(shape(back, at.rigid(wall), floor));
    let of_metal = add_mesh(&mut scene, at.mesh(ball(0.5)));
    let left = DMat4::from_translation(DVec3::new(-0.75, 0.5, 0.0));
    scene.shapes.push(shape(of_metal, at.rigid(left), metal));
    let radius = at.length(0.4);
    scene.shapes.push(shape(
        Geometry::Sphere { radius },
        at.rigid(DMat4::from_translation(DVec3::new(0.5, 0.4, 0.6))),
        clear,
    ));
    let disk = Geometry::Disk {
        radius: at.length(0.35),
        height: at.length(0.05),
    };
    let tilted = DMat4::from_translation(DVec3::new(1.2, 0.4, -0.3)) * DMat4::from_rotation_y(-0.6);
    scene.shapes.push(shape(disk, at.rigid(tilted), red));

    // A pyramid-like pair of triangles, shown twice.
    let card = add_mesh(&mut scene, at.mesh(quad(0.2)));
    scene.objects.push(Object {
        name: "card".to_owned(),
        shapes: vec![shape(card, DMat4::IDENTITY, red)],
    });
    for (x, turn) in [(0.0, 0.3), (0.35, 1.1)] {
        let place =
            DMat4::from_translation(DVec3::new(x, 0.25, 0.9)) * DMat4::from_rotation_y(turn);
        scene.instances.push(ObjectInstance {
            object: ObjectId(0),
            to_world: at.rigid(place),
            motion: None,
        });
    }

    let down = DMat4::from_translation(DVec3::new(0.3, 2.5, 0.5))
        * DMat4::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let lamp = add_mesh(&mut scene, at.mesh(quad(0.4)));
    let lamp = emitting(shape(lamp, at.rigid(down), floor), 9.0);
    scene.shapes.push(lamp);
    let bulb = sphere(at.length(0.1), at.point([-1.4, 1.2, 0.8]), floor);
    scene.shapes.push(emitting(bulb, 20.0));
    scene.lights.push(Light::Point {
        position: at.point([1.5, 1.8, 1.5]),
        intensity: Rgb::splat((2.0 * at.scale * at.scale) as f32),
    });
    scene.lights.push(constant_sky(0.05));
    scene
}

fn assert_same(what: &str, picture: &Picture, reference: &Picture) {
    for channel in 0..3 {
        let of = |layer: &[Rgb<f32>]| -> Vec<f64> {
            let value = |c: &Rgb<f32>| f64::from(c.to_array()[channel]);
            layer.iter().map(value).collect()
        };
        let [a, b] = [picture, reference].map(|p| (of(&p.colour), of(&p.variance)));
        // A few samples may have missed what is rare.
        let floor = b.1.iter().sum::<f64>() / b.1.len() as f64;
        let [va, vb] = [&a.1, &b.1].map(|v| v.iter().map(|x| x.max(floor)).collect::<Vec<_>>());
        let image = |mean, variance| NoisyImage {
            width: picture.width as usize,
            mean,
            variance,
        };
        let report = compare(&image(&a.0, &va), &image(&b.0, &vb), 8, SIGNIFICANCE / 3.0);
        assert!(report.is_pass(), "{what}, channel {channel}: {report:?}");
    }
}

/// A scale by a power of two is exact in every operation: whatever differs has a length in it that
/// the scene does not have.
#[test]
fn pictures_in_other_units_are_equal_bit_for_bit() {
    let reference = render(&still_life(PlaceAndUnit::HERE, 32), 16, 8, Strategy::Mis);
    for exponent in [-40, -20, -1, 7, 20, 40, 48] {
        let scale = 2.0_f64.powi(exponent);
        let picture = render(
            &still_life(PlaceAndUnit::scaled(scale), 32),
            16,
            8,
            Strategy::Mis,
        );
        let differing = picture
            .colour
            .iter()
            .zip(&reference.colour)
            .filter(|(a, b)| a != b)
            .count();
        assert_eq!(differing, 0, "pixels of colour at 2^{exponent}");
        assert_eq!(picture.normal, reference.normal, "at 2^{exponent}");
        assert_eq!(picture.albedo, reference.albedo, "at 2^{exponent}");
        for (a, b) in picture.depth.iter().zip(&reference.depth) {
            assert_eq!(f64::from(*a), f64::from(*b) * scale, "at 2^{exponent}");
        }
    }
}

/// Units that round: a millionth and a million.
#[test]
fn a_millionth_and_a_million_look_like_one() {
    let reference = render(&still_life(PlaceAndUnit::HERE, 32), 256, 8, Strategy::Mis);
    for scale in [1e-6, 1e6] {
        let picture = render(
            &still_life(PlaceAndUnit::scaled(scale), 32),
            256,
            8,
            Strategy::Mis,
        );
        assert_same(&format!("in units of {scale:e}"), &picture, &reference);
    }
}

/// A body in a uniform sky, however small or far: acne would darken it.
fn furnace(at: PlaceAndUnit, of_triangles: bool) -> Scene {
    let mut scene = empty(at.camera([0.0, 0.0, 4.0], [0.0; 3], 8.0), 16);
    let white = material(&mut scene, diffuse(0.8));
    let place = at.rigid(DMat4::IDENTITY);
    let geometry = if of_triangles {
        add_mesh(&mut scene, at.mesh(ball(1.0)))
    } else {
        Geometry::Sphere {
            radius: at.length(1.0),
        }
    };
    scene.shapes.push(shape(geometry, place, white));
    scene.lights.push(constant_sky(1.0));
    scene
}

#[test]
fn no_surface_shadows_itself() {
    let mut worst = Vec::new();
    let places = [1e-6, 1e-3, 1.0, 1e3, 1e6]
        .map(PlaceAndUnit::scaled)
        .into_iter()
        .chain([1e2, 1e3, 1e4, 1e5].map(PlaceAndUnit::moved));
    for at in places {
        for of_triangles in [false, true] {
            let picture = render(&furnace(at, of_triangles), 64, 8, Strategy::Mis);
            let what = format!("{at:?}, triangles: {of_triangles}");
            assert_mean(&what, &picture, 0.8, 0.004);
            let darkest = picture.colour.iter().map(|c| c.g).fold(1.0, f32::min);
            worst.push((what, darkest));
        }
    }
    for (what, darkest) in worst {
        assert!(darkest > 0.6, "{what}: a pixel of {darkest}");
    }
}

/// A dark box in a bright sky, seen from within.
#[test]
fn no_light_leaks_into_a_closed_box() {
    let places = [1e-6, 1.0, 1e6]
        .map(PlaceAndUnit::scaled)
        .into_iter()
        .chain([1e2, 1e3, 1e4].map(PlaceAndUnit::moved));
    for at in places {
        let mut scene = empty(at.camera([0.1, 0.2, 0.7], [-0.9, -1.0, -1.0], 100.0), 24);
        let grey = material(&mut scene, diffuse(0.8));
        // Corners in common: the faces are watertight where their vertices are the same bits.
        let mut mesh = Mesh::default();
        for i in 0..8_u32 {
            let side = |bit: u32| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            mesh.positions.push([side(0), side(1), side(2)]);
        }
        for [a, b, c, d] in [
            [0, 1, 3, 2],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 3, 7, 6],
            [0, 2, 6, 4],
            [1, 3, 7, 5],
        ] {
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
        let geometry = add_mesh(&mut scene, at.mesh(mesh));
        let walls = shape(geometry, at.rigid(DMat4::IDENTITY), grey);
        scene.shapes.push(walls);
        // A body that stands in its floor, and one within the other: surfaces that cross.
        for (radius, centre) in [(0.5, [0.0, -1.0, 0.0]), (0.3, [0.3, -0.8, 0.0])] {
            let body = sphere(at.length(radius), at.point(centre), grey);
            scene.shapes.push(body);
        }
        scene.lights.push(constant_sky(1000.0));
        scene.lights.push(Light::Distant {
            irradiance: Rgb::splat(1000.0),
            to_light: [0.36, 0.48, 0.8],
            half_angle_deg: 1.0,
        });
        let picture = render(&scene, 64, 16, Strategy::Mis);
        let lit = picture.colour.iter().filter(|c| !c.is_black()).count();
        // Far away, a point next to an edge may be rounded to the other side of the next wall.
        let allowed = match at.shift[0].abs() {
            0.0 => 0,
            x if x < 100.0 => 4,
            x if x < 1000.0 => 20,
            _ => 120,
        };
        assert!(lit <= allowed, "{lit} pixels with light, {at:?}");
    }
}

/// Far from the origin coordinates are coarse: shapes and the camera move by a step, pictures stay.
#[test]
fn far_places_degrade_gracefully() {
    let reference = render(&still_life(PlaceAndUnit::HERE, 32), 256, 8, Strategy::Mis);
    let (expected, _) = mean(&reference);
    for (distance, tolerance) in [(4e1, 0.01), (4e2, 0.01), (4e3, 0.015), (4e4, 0.05)] {
        let picture = render(
            &still_life(PlaceAndUnit::moved(distance), 32),
            256,
            8,
            Strategy::Mis,
        );
        let (found, _) = mean(&picture);
        let change = found / expected - 1.0;
        let squares: f64 = picture
            .colour
            .iter()
            .zip(&reference.colour)
            .map(|(a, b)| (f64::from(a.g - b.g) / (f64::from(b.g) + 0.01)).powi(2))
            .sum();
        let relative = (squares / picture.colour.len() as f64).sqrt();
        println!("{distance:e} units away: mean {change:+.4}, relative RMSE {relative:.4}");
        assert!(change.abs() < tolerance, "{distance:e}: {change}");
        if distance <= 4e2 {
            assert_same(&format!("{distance:e} units away"), &picture, &reference);
        }
    }
}
