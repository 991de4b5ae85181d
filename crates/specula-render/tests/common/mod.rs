//! Small scenes, and their renders as means with errors.
#![allow(dead_code, reason = "every test file uses its own part")]

use core::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use glam::{DMat4, DVec3};
use specula_bsdf::Rgb;
use specula_render::picture::Picture;
use specula_render::{PreparedScene, RenderOptions, Renderer, Strategy};
use specula_scene::Energy;
use specula_scene::scene::*;

/// A camera at `from` that looks at `to`.
pub(crate) fn look(from: [f64; 3], to: [f64; 3], fov_deg: f64) -> Camera {
    let from = DVec3::from(from);
    let forward = (DVec3::from(to) - from).normalize();
    let up = if forward.y.abs() > 0.9 {
        DVec3::Z
    } else {
        DVec3::Y
    };
    let right = up.cross(forward).normalize();
    let up = forward.cross(right);
    Camera {
        to_world: DMat4::from_cols(
            right.extend(0.0),
            up.extend(0.0),
            forward.extend(0.0),
            from.extend(1.0),
        ),
        projection: Projection::Perspective { fov_deg },
        lens_radius: 0.0,
        focal_distance: 1.0,
        screen_window: [-1.0, 1.0, -1.0, 1.0],
        motion: None,
    }
}

/// A scene with nothing in it.
pub(crate) fn empty(camera: Camera, size: u32) -> Scene {
    let film = Film::new([size; 2], Filter::Box { radius: [0.5; 2] });
    let settings = Settings {
        max_depth: 5,
        samples_per_pixel: 1,
        hide_emitters: false,
        energy: Energy::None,
    };
    Scene::empty(camera, film, settings)
}

pub(crate) fn grey(v: f32) -> ColourParam {
    ColourParam::Value(Rgb::splat(v))
}

pub(crate) fn diffuse(albedo: f32) -> MaterialKind {
    MaterialKind::Diffuse {
        reflectance: grey(albedo),
        roughness: FloatParam::Value(0.0),
    }
}

pub(crate) fn alpha(a: f32) -> Roughness {
    Roughness::isotropic(FloatParam::Value(a), RoughnessMapping::Alpha)
}

/// A metal that reflects practically everything at every angle.
pub(crate) fn mirror_metal(a: f32) -> MaterialKind {
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Index {
            eta: grey(1.0),
            k: grey(300.0),
        },
        roughness: alpha(a),
        tint: ColourParam::WHITE,
    }
}

/// Grey metal with grooves.
pub(crate) fn brushed() -> MaterialKind {
    MaterialKind::Conductor {
        fresnel: ConductorFresnel::Index {
            eta: grey(0.2),
            k: grey(3.0),
        },
        roughness: Roughness {
            u: FloatParam::Value(0.4),
            v: FloatParam::Value(0.05),
            ..alpha(0.1)
        },
        tint: ColourParam::WHITE,
    }
}

pub(crate) fn glass(a: f32) -> MaterialKind {
    MaterialKind::Dielectric {
        eta: 1.5,
        roughness: alpha(a),
        reflection_tint: ColourParam::WHITE,
        transmission_tint: ColourParam::WHITE,
    }
}

pub(crate) fn material(scene: &mut Scene, kind: MaterialKind) -> MaterialId {
    scene.materials.push(Material::new(kind));
    MaterialId(scene.materials.len() - 1)
}

pub(crate) fn shape(geometry: Geometry, to_world: DMat4, material: MaterialId) -> Shape {
    Shape {
        geometry,
        to_world,
        material,
        emission: None,
        reverse_orientation: false,
        alpha: FloatParam::Value(1.0),
        motion: None,
    }
}

pub(crate) fn sphere(radius: f32, centre: [f64; 3], material: MaterialId) -> Shape {
    let at = DMat4::from_translation(centre.into());
    shape(Geometry::Sphere { radius }, at, material)
}

pub(crate) fn emitting(shape: Shape, radiance: f32) -> Shape {
    Shape {
        emission: Some(Emission {
            radiance: grey(radiance),
            two_sided: false,
        }),
        ..shape
    }
}

/// A square in the plane z = 0 over `[-half, half]^2`, its outside at +z.
pub(crate) fn square(scene: &mut Scene, half: f32, to_world: DMat4, material: MaterialId) -> Shape {
    scene.meshes.push(Mesh {
        positions: vec![
            [-half, -half, 0.0],
            [half, -half, 0.0],
            [half, half, 0.0],
            [-half, half, 0.0],
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    });
    shape(
        Geometry::Mesh(MeshId(scene.meshes.len() - 1)),
        to_world,
        material,
    )
}

pub(crate) fn constant_sky(radiance: f32) -> Light {
    Light::Infinite {
        radiance: Rgb::splat(radiance),
        image: None,
        to_world: DMat4::IDENTITY,
    }
}

/// Renders in one pass; asserts that every sample was a finite number.
pub(crate) fn render(scene: &Scene, spp: u32, max_depth: u32, strategy: Strategy) -> Picture {
    let options = RenderOptions {
        samples_per_pixel: spp,
        max_depth,
        strategy,
        ..RenderOptions::default()
    };
    let prepared = PreparedScene::new(scene, &options).expect("the scene is sound");
    let mut renderer = Renderer::new(&prepared, options);
    let report = renderer.render_pass(spp, &AtomicBool::new(false));
    assert!(report.complete && report.samples_done_total == spp && report.rays > 0);
    assert_eq!(report.invalid_samples, 0);
    renderer.film().picture()
}

/// Mean of the picture's green, and the standard error of that mean.
pub(crate) fn mean(picture: &Picture) -> (f64, f64) {
    let n = picture.colour.len() as f64;
    let sum: f64 = picture.colour.iter().map(|c| f64::from(c.g)).sum();
    let variance: f64 = picture.variance.iter().map(|c| f64::from(c.g)).sum();
    (sum / n, variance.sqrt() / n)
}

/// Asserts that the picture's mean is `expected`, within 4.5 standard errors and `slack`.
pub(crate) fn assert_mean(what: &str, picture: &Picture, expected: f64, slack: f64) {
    let (found, error) = mean(picture);
    assert!(
        (found - expected).abs() < 4.5 * error + slack * expected.abs(),
        "{what}: {found} +- {error} instead of {expected}"
    );
    // The test must be able to see an error of 3 %.
    assert!(
        error < 0.007 * expected.abs() + 1e-9,
        "{what}: too noisy, {found} +- {error}"
    );
}

/// Asserts that means with their errors agree with the one at `reference`, within 4.5 standard
/// errors, and that each error is below `noise` of its mean.
pub(crate) fn assert_agree(what: &str, results: &[(f64, f64)], reference: usize, noise: f64) {
    let (m0, e0) = results[reference];
    for (m, e) in results {
        assert!(*e < noise * m, "{what}: too noisy, {results:?}");
        let z = (m - m0) / (e * e + e0 * e0).sqrt();
        assert!(z.abs() < 4.5, "{what}: {results:?}");
    }
}

/// A large Lambert plane z = 0 of albedo 1/2 with its outside at +z, seen in one spot next to the
/// origin.
pub(crate) fn lit_floor() -> Scene {
    let mut scene = empty(look([3.0, 0.0, 3.0], [0.0; 3], 0.05), 8);
    let m = material(&mut scene, diffuse(0.5));
    let floor = square(&mut scene, 50.0, DMat4::IDENTITY, m);
    scene.shapes.push(floor);
    scene
}

/// A closed box of `half` sides along x and y, between two heights, its outside outside.
pub(crate) fn body(scene: &mut Scene, half: f64, [low, high]: [f64; 2], material: MaterialId) {
    let side = |scene: &mut Scene, m: DMat4| {
        let s = square(scene, 1.0, m, material);
        scene.shapes.push(s);
    };
    let scale = DMat4::from_scale(DVec3::new(half, half, 0.5 * (high - low)));
    let centre = DMat4::from_translation(DVec3::new(0.0, 0.0, 0.5 * (low + high))) * scale;
    let up = DMat4::from_translation(DVec3::Z);
    let turns = [0.0, 0.5, 1.0, 1.5].map(|t| DMat4::from_rotation_x(t * PI));
    for turn in turns
        .into_iter()
        .chain([0.5, 1.5].map(|t| DMat4::from_rotation_y(t * PI)))
    {
        side(scene, centre * turn * up);
    }
}

/// A material whose media absorb.
pub(crate) fn absorbing(scene: &mut Scene, kind: MaterialKind, absorption: f32) -> MaterialId {
    let id = material(scene, kind);
    scene.materials[id.0].absorption = Rgb::splat(absorption);
    id
}

/// Hair of moderate roughness.
///
/// * `sigma_a`: absorption.
pub(crate) fn hair(sigma_a: [f32; 3]) -> MaterialKind {
    MaterialKind::Hair(HairMaterial {
        pigment: HairPigment::Absorption(ColourParam::Value(Rgb::from(sigma_a))),
        eta: FloatParam::Value(1.55),
        beta_m: FloatParam::Value(0.3),
        beta_n: FloatParam::Value(0.3),
        alpha_deg: FloatParam::Value(2.0),
    })
}

/// Renders dyed hair between a lamp behind it and a dim sky by each strategy: light comes through fibres, and each knows
/// how much.
///
/// * `place`: adds the hair.
pub(crate) fn assert_strategies_agree_on_hair(place: impl FnOnce(&mut Scene, MaterialId)) {
    let mut scene = empty(look([0.0, 0.0, 5.0], [0.0; 3], 40.0), 8);
    let m = material(&mut scene, hair([0.1, 0.3, 0.9]));
    place(&mut scene, m);
    let black = material(&mut scene, diffuse(0.0));
    let lamp = sphere(1.0, [1.0, 1.0, -4.0], black);
    scene.shapes.push(emitting(lamp, 8.0));
    scene.lights.push(constant_sky(0.2));
    let results: Vec<_> = [Strategy::Mis, Strategy::BsdfOnly, Strategy::LightsOnly]
        .into_iter()
        .map(|strategy| mean(&render(&scene, 512, 6, strategy)))
        .collect();
    assert_agree("lock", &results, 0, 0.02);
}
