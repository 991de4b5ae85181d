//! Parts that the scenes have in common.

use glam::{DMat4, DVec3};
use specula_bsdf::{Rgb, metals};
use specula_scene::Scene;
use specula_scene::scene::{
    Camera, ColourParam, ConductorFresnel, Emission, Film, Filter, FloatParam, Geometry, Light,
    Material, MaterialId, MaterialKind, Mesh, MeshId, Roughness, Settings, Shape,
};

/// A scene with a camera that looks from `eye` to `target`, z up.
pub(super) fn scene(resolution: [u32; 2], eye: DVec3, target: DVec3, fov_deg: f64) -> Scene {
    let filter = Filter::Gaussian {
        radius: [1.5; 2],
        sigma: 0.5,
    };
    let film = Film::new(resolution, filter);
    let camera = Camera::look_at(eye, target, DVec3::Z, fov_deg, &film);
    let settings = Settings {
        max_depth: 8,
        samples_per_pixel: 64,
        ..Settings::default()
    };
    Scene::empty(camera, film, settings)
}

pub(super) fn material(scene: &mut Scene, name: &str, kind: MaterialKind) -> MaterialId {
    scene.materials.push(Material {
        name: Some(name.to_owned()),
        ..Material::new(kind)
    });
    MaterialId(scene.materials.len() - 1)
}

pub(super) fn diffuse(reflectance: f32) -> MaterialKind {
    MaterialKind::Diffuse {
        reflectance: ColourParam::Value(Rgb::splat(reflectance)),
        roughness: FloatParam::Value(0.0),
    }
}

/// A metal by its symbol; one that reflects everything by none.
pub(super) fn conductor(symbol: &str, alpha: f32) -> MaterialKind {
    let index = |channel: [f64; 3]| ColourParam::Value(Rgb::from(channel).cast());
    let fresnel = match metals::by_symbol(symbol) {
        Some(metal) => ConductorFresnel::Index {
            eta: index(metal.eta),
            k: index(metal.k),
        },
        None => ConductorFresnel::Reflectance(ColourParam::WHITE),
    };
    let width = FloatParam::Value(alpha);
    MaterialKind::Conductor {
        fresnel,
        roughness: Roughness {
            u: width,
            v: width,
            ..Roughness::smooth()
        },
        tint: ColourParam::WHITE,
    }
}

/// A ball of radius 1.
pub(super) fn ball(scene: &mut Scene, centre: DVec3, material: MaterialId) {
    let sphere = Geometry::Sphere { radius: 1.0 };
    let to_world = DMat4::from_translation(centre);
    scene.shapes.push(Shape::new(sphere, to_world, material));
}

/// A floor at z = 0.
pub(super) fn floor(scene: &mut Scene, material: MaterialId) {
    let disk = Geometry::Disk {
        radius: 60.0,
        height: 0.0,
    };
    scene
        .shapes
        .push(Shape::new(disk, DMat4::IDENTITY, material));
}

/// A rectangle of light at `centre` that faces `target`.
pub(super) fn lamp(
    scene: &mut Scene,
    material: MaterialId,
    [centre, target]: [DVec3; 2],
    half: [f64; 2],
    radiance: Rgb<f32>,
) {
    let forward = (target - centre).normalize();
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    let corner = |[x, y]: [f64; 2]| (centre + right * (x * half[0]) + up * (y * half[1])).as_vec3();
    // In this order about the normal that faces the target.
    let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    scene.meshes.push(Mesh {
        positions: corners.map(|c| corner(c).to_array()).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    });
    let mesh = Geometry::Mesh(MeshId(scene.meshes.len() - 1));
    let mut shape = Shape::new(mesh, DMat4::IDENTITY, material);
    shape.emission = Some(Emission {
        radiance: ColourParam::Value(radiance),
        two_sided: false,
    });
    scene.shapes.push(shape);
}

/// Even light from all directions.
pub(super) fn surround(scene: &mut Scene, radiance: f32) {
    scene.lights.push(Light::Infinite {
        radiance: Rgb::splat(radiance),
        image: None,
        to_world: DMat4::IDENTITY,
    });
}
