//! Hair in pictures: white fibres vanish in a uniform sky, light takes a fibre once, strategies agree, from both sides.

mod common;

use core::f64::consts::TAU;

use common::*;
use glam::{DMat4, DVec3};
use specula_bsdf::fresnel::dielectric;
use specula_render::{PreparedScene, RenderOptions, Strategy};
use specula_scene::scene::*;

const SIDES: u32 = 12;

/// A fibre of radius 1 about x, from -1 to 1: a tube of 12 sides.
fn tube() -> Mesh {
    let mut mesh = Mesh {
        is_fibre: true,
        ..Mesh::default()
    };
    for (row, x) in [-1.0, 1.0].into_iter().enumerate() {
        for side in 0..=SIDES {
            let share = f64::from(side) / f64::from(SIDES);
            let (sin, cos) = (TAU * share).sin_cos();
            #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
            let narrow = |v: [f64; 3]| v.map(|x| x as f32);
            mesh.positions.push(narrow([x, cos, sin]));
            mesh.normals.push(narrow([0.0, cos, sin]));
            mesh.tangents.push([1.0, 0.0, 0.0, 1.0]);
            #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
            mesh.uvs.push([row as f32, share as f32]);
        }
    }
    for i in 0..SIDES {
        let (a, b) = (i, i + SIDES + 1);
        mesh.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    }
    mesh
}

/// A fibre through a point.
fn fibre(scene: &mut Scene, centre: DVec3, turn_rad: f64, [half, radius]: [f64; 2], m: MaterialId) {
    if scene.meshes.is_empty() {
        scene.meshes.push(tube());
    }
    let to_world = DMat4::from_translation(centre)
        * DMat4::from_rotation_z(turn_rad)
        * DMat4::from_scale(DVec3::new(half, radius, radius));
    let place = shape(Geometry::Mesh(MeshId(0)), to_world, m);
    scene.shapes.push(place);
}

/// A lock of crossing fibres.
fn lock(scene: &mut Scene, m: MaterialId) {
    for i in 0..24 {
        let i = f64::from(i);
        let centre = DVec3::new((1.7 * i).sin(), (2.3 * i).cos(), (0.9 * i).sin()) * 0.5;
        fibre(scene, centre, 0.8 * i, [1.2, 0.06], m);
    }
}

/// A ball, a ribbon seen from both sides, and fibres, all white: every path ends in the sky with a throughput of 1.
#[test]
fn white_hair_vanishes_in_a_uniform_sky() {
    for (what, eye) in [
        ("ball", 1.0),
        ("ribbon", 1.0),
        ("ribbon", -1.0),
        ("lock", 1.0),
    ] {
        let mut scene = empty(look([0.3, 0.4, 4.0 * eye], [0.0; 3], 40.0), 16);
        let m = material(&mut scene, hair([0.0; 3]));
        match what {
            "ball" => scene.shapes.push(sphere(1.0, [0.0; 3], m)),
            "ribbon" => {
                let ribbon = square(&mut scene, 1.0, DMat4::IDENTITY, m);
                scene.shapes.push(ribbon);
            }
            _ => lock(&mut scene, m),
        }
        scene.lights.push(constant_sky(1.0));
        let by_lobe = render(&scene, 16, 200, Strategy::BsdfOnly);
        for c in &by_lobe.colour {
            assert!((c.g - 1.0).abs() < 1e-3, "{what}: {c:?}");
        }
        assert_mean(what, &render(&scene, 64, 200, Strategy::Mis), 1.0, 1e-3);
    }
}

/// Light that a fibre at right angles takes from a uniform sky, on average over its width.
fn taken(sigma: f64) -> f64 {
    let n = 1000;
    let at = |i: i32| {
        let h = (f64::from(i) + 0.5) / f64::from(n);
        let f = dielectric((1.0 - h * h).sqrt(), 1.55).reflectance;
        let cos_t = (1.0 - (h / 1.55).powi(2)).sqrt();
        let t = (-2.0 * sigma * cos_t).exp();
        1.0 - f - (1.0 - f).powi(2) * t / (1.0 - f * t)
    };
    (0..n).map(at).sum::<f64>() / f64::from(n)
}

/// What passes a tube is scattered once, by the lobe of the whole fibre: its darkness is that of one passage.
#[test]
fn light_takes_a_fibre_once() {
    let mut scene = empty(look([0.0, 0.0, 60.0], [0.0; 3], 2.5), 16);
    let m = material(&mut scene, hair([0.0, 0.6, 1e6]));
    fibre(&mut scene, DVec3::ZERO, 0.3, [20.0, 1.0], m);
    scene.lights.push(constant_sky(1.0));
    let dark = |scene: &Scene, strategy| {
        let picture = render(scene, 256, 8, strategy);
        let mut dark = [0.0; 3];
        for c in &picture.colour {
            for (sum, v) in dark.iter_mut().zip(c.to_array()) {
                *sum += 1.0 - f64::from(v);
            }
        }
        dark
    };
    let expected = taken(0.6) / taken(1e6);
    for strategy in [Strategy::Mis, Strategy::BsdfOnly] {
        let [clear, dyed, black] = dark(&scene, strategy);
        assert!(clear.abs() < 0.01 * black, "{clear} {black}");
        let found = dyed / black;
        assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
    }
    // Were it an ordinary mesh, light would be scattered where it leaves, too.
    scene.meshes[0].is_fibre = false;
    let [_, dyed, black] = dark(&scene, Strategy::Mis);
    let found = dyed / black;
    assert!((found / expected - 1.0).abs() > 0.1, "{found} {expected}");
}

/// A dyed lock between a lamp behind it and a dim sky: light comes through fibres, and each strategy knows how much.
#[test]
fn strategies_agree_on_hair() {
    assert_strategies_agree_on_hair(lock);
}

#[test]
fn shaders_are_told_to_lack_it() {
    let mut scene = empty(look([0.0, 0.0, 5.0], [0.0; 3], 40.0), 8);
    let m = material(&mut scene, hair([0.0; 3]));
    lock(&mut scene, m);
    scene.lights.push(constant_sky(1.0));
    let prepared = PreparedScene::new(&scene, &RenderOptions::default()).unwrap();
    assert_eq!(prepared.flatten().missing, ["hair"]);
    assert_eq!(prepared.lobe(0, true), None);
}
