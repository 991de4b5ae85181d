//! The built-in scene: rough metal at a glance.
//!
//! Two rows of lathe-turned orbs, five metals. The back row is isotropic and grows rougher from
//! left to right; the front row is anisotropic, alpha_x around the axis of each orb and alpha_y
//! along its meridians.

mod revolve;
mod stage;
mod studio;

pub(crate) use studio::above_floor as studio_above_floor;

use glam::{DMat4, DVec3};
use specula_bsdf::math::rgb;
use specula_bsdf::{Rgb, metals};

use crate::num::f32_of;
use crate::scene::{
    Camera, CoatMedium, ColourParam, ConductorFresnel, Emission, Film, Filter, FloatParam,
    Geometry, Material, MaterialId, MaterialKind, Mesh, MeshId, Roughness, Scene, Settings, Shape,
};

/// Symbols of the metals, from left to right.
const METALS: [&str; 5] = ["Ag", "Au", "Cu", "Ti", "Fe"];
/// Alphas of the back row.
const ISOTROPIC: [f64; 5] = [0.02, 0.1, 0.25, 0.5, 1.0];
/// Alphas of the front row, `(alpha_x, alpha_y)`.
const ANISOTROPIC: [(f64, f64); 5] = [
    (0.05, 0.4),
    (0.4, 0.05),
    (0.08, 0.5),
    (0.8, 0.1),
    (0.2, 0.8),
];
/// Distance between neighbouring orbs, in radii.
const SPACING: f64 = 2.72;

/// The built-in scene: 960 x 400 pixels, 64 samples per pixel. Lengths are in radii of an orb, z is
/// up.
///
/// The same value at every call; it satisfies [`Scene::validate`].
#[must_use]
pub fn orbs() -> Scene {
    let mut build = SceneBuilder::new();
    build.stage();
    let ball = build.mesh(revolve::orb());
    let foot = build.mesh(revolve::foot());
    let dark = build.material(
        "foot",
        MaterialKind::CoatedDiffuse {
            reflectance: ColourParam::Value(rgb(0.025, 0.026, 0.03)),
            eta: 1.5,
            roughness: alphas(0.15, 0.15),
            medium: CoatMedium::default(),
            lossless: false,
        },
    );
    for (column, symbol) in METALS.iter().enumerate() {
        let x = SPACING * (column as f64 - 2.0);
        let back = (ISOTROPIC[column], ISOTROPIC[column]);
        for ((alpha_x, alpha_y), y, z) in [
            (back, stage::BACK_ROW_Y, stage::STEP_HEIGHT),
            (ANISOTROPIC[column], stage::FRONT_ROW_Y, 0.0),
        ] {
            let metal = build.material(
                &format!("{symbol} {alpha_x} {alpha_y}"),
                conductor(symbol, alpha_x, alpha_y),
            );
            let place = DMat4::from_translation(DVec3::new(x, y, z));
            build.shape(foot, place, dark);
            // The axis leans towards the viewer and to the key light, so that the pole shows.
            let lean = DMat4::from_translation(DVec3::new(0.0, 0.0, revolve::ORB_HEIGHT))
                * DMat4::from_rotation_z(-0.45)
                * DMat4::from_rotation_x(0.9);
            build.shape(ball, place * lean, metal);
        }
    }
    build.scene
}

fn alphas(alpha_x: f64, alpha_y: f64) -> Roughness {
    Roughness {
        u: FloatParam::Value(f32_of(alpha_x)),
        v: FloatParam::Value(f32_of(alpha_y)),
        ..Roughness::smooth()
    }
}

fn conductor(symbol: &str, alpha_x: f64, alpha_y: f64) -> MaterialKind {
    let index = |channel: [f64; 3]| ColourParam::Value(Rgb::from(channel).cast());
    let fresnel = match metals::by_symbol(symbol) {
        Some(metal) => ConductorFresnel::Index {
            eta: index(metal.eta),
            k: index(metal.k),
        },
        // Not reached: a test looks every symbol up.
        None => ConductorFresnel::Reflectance(ColourParam::Value(Rgb::splat(0.9))),
    };
    MaterialKind::Conductor {
        fresnel,
        roughness: alphas(alpha_x, alpha_y),
        tint: ColourParam::WHITE,
    }
}

/// Adds parts to a scene.
struct SceneBuilder {
    scene: Scene,
}

impl SceneBuilder {
    fn new() -> Self {
        let filter = Filter::Gaussian {
            radius: [1.5; 2],
            sigma: 0.5,
        };
        let film = Film::new([960, 400], filter);
        let eye = DVec3::new(0.0, -19.0, 8.2);
        let target = DVec3::new(0.0, 0.35, 1.86);
        let camera = Camera::look_at(eye, target, DVec3::Z, 18.9, &film);
        let settings = Settings {
            max_depth: 8,
            samples_per_pixel: 64,
            ..Settings::default()
        };
        Self {
            scene: Scene::empty(camera, film, settings),
        }
    }

    fn mesh(&mut self, mesh: Mesh) -> MeshId {
        self.scene.meshes.push(mesh);
        MeshId(self.scene.meshes.len() - 1)
    }

    fn material(&mut self, name: &str, kind: MaterialKind) -> MaterialId {
        self.scene.materials.push(Material {
            name: Some(name.to_owned()),
            ..Material::new(kind)
        });
        MaterialId(self.scene.materials.len() - 1)
    }

    fn shape(&mut self, mesh: MeshId, to_world: DMat4, material: MaterialId) {
        let geometry = Geometry::Mesh(mesh);
        self.scene
            .shapes
            .push(Shape::new(geometry, to_world, material));
    }

    fn emitter(&mut self, mesh: Mesh, material: MaterialId, radiance: Rgb<f32>) {
        let mesh = self.mesh(mesh);
        self.shape(mesh, DMat4::IDENTITY, material);
        if let Some(shape) = self.scene.shapes.last_mut() {
            shape.emission = Some(Emission {
                radiance: ColourParam::Value(radiance),
                two_sided: false,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_valid_and_every_metal_is_measured() {
        let scene = orbs();
        scene.validate().unwrap();
        for symbol in METALS {
            assert!(metals::by_symbol(symbol).is_some(), "{symbol}");
        }
    }

    #[test]
    fn orbs_stand_apart() {
        let scene = orbs();
        let balls: Vec<DVec3> = scene
            .shapes
            .iter()
            .filter(|s| {
                matches!(
                    scene.materials[s.material.0].kind,
                    MaterialKind::Conductor { .. }
                )
            })
            .map(|s| s.to_world.transform_point3(DVec3::ZERO))
            .collect();
        assert_eq!(balls.len(), 10);
        for (i, a) in balls.iter().enumerate() {
            for b in &balls[..i] {
                assert!((*a - *b).length() > 2.0, "{a} {b}");
            }
        }
    }
}
