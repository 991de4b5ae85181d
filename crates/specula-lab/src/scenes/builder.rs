//! Scenes from quads, boxes, spheres and surfaces of revolution. Lengths in metres, z is up.

use std::f64::consts::TAU;

use glam::{DMat4, DVec3, dvec3};
use specula_bsdf::{Rgb, metals};
use specula_scene::scene::{
    Camera, ColourParam, ConductorFresnel, Emission, Film, Filter, FloatParam, Geometry, Material,
    MaterialId, MaterialKind, Mesh, MeshId, Roughness, RoughnessMapping, Settings, Shape,
};
use specula_scene::{Energy, Scene};

/// Adds parts to a scene.
pub(super) struct Builder {
    scene: Scene,
}

impl Builder {
    /// An empty scene.
    ///
    /// * `fov_deg`: over the shorter side of the picture.
    pub(super) fn new(resolution: [u32; 2], eye: DVec3, target: DVec3, fov_deg: f64) -> Self {
        let film = Film::new(resolution, Filter::Box { radius: [0.5; 2] });
        let camera = Camera::look_at(eye, target, DVec3::Z, fov_deg, &film);
        let settings = Settings {
            max_depth: 64,
            samples_per_pixel: 64,
            energy: Energy::None,
            ..Settings::default()
        };
        Self {
            scene: Scene::empty(camera, film, settings),
        }
    }

    /// The scene.
    pub(super) fn finish(self) -> Scene {
        self.scene
    }

    /// A material of any kind.
    pub(super) fn material(&mut self, name: &str, kind: MaterialKind) -> MaterialId {
        self.scene.materials.push(Material {
            name: Some(name.to_owned()),
            ..Material::new(kind)
        });
        MaterialId(self.scene.materials.len() - 1)
    }

    /// Lambert.
    pub(super) fn diffuse(&mut self, name: &str, albedo: [f32; 3]) -> MaterialId {
        let kind = MaterialKind::Diffuse {
            reflectance: ColourParam::Value(Rgb::from(albedo)),
            roughness: FloatParam::Value(0.0),
        };
        self.material(name, kind)
    }

    /// Rough metal by its reflectance along the normal.
    pub(super) fn tinted(&mut self, name: &str, colour: [f32; 3], alpha: f32) -> MaterialId {
        let colour = ColourParam::Value(Rgb::from(colour));
        self.metal_of(name, ConductorFresnel::Reflectance(colour), alpha)
    }

    /// A measured metal by its chemical symbol.
    pub(super) fn metal(&mut self, symbol: &str, alpha: f32) -> MaterialId {
        let index = |v: [f64; 3]| ColourParam::Value(Rgb::from(v).cast());
        let fresnel = match metals::by_symbol(symbol) {
            Some(metal) => ConductorFresnel::Index {
                eta: index(metal.eta),
                k: index(metal.k),
            },
            None => ConductorFresnel::Mirror,
        };
        self.metal_of(&format!("{symbol} {alpha}"), fresnel, alpha)
    }

    fn metal_of(&mut self, name: &str, fresnel: ConductorFresnel, alpha: f32) -> MaterialId {
        let kind = MaterialKind::Conductor {
            fresnel,
            roughness: Roughness::isotropic(FloatParam::Value(alpha), RoughnessMapping::Alpha),
            tint: ColourParam::WHITE,
        };
        self.material(name, kind)
    }

    /// Rough glass of index 1.5.
    pub(super) fn glass(&mut self, name: &str, alpha: f32) -> MaterialId {
        let kind = MaterialKind::Dielectric {
            eta: 1.5,
            roughness: Roughness::isotropic(FloatParam::Value(alpha), RoughnessMapping::Alpha),
            reflection_tint: ColourParam::WHITE,
            transmission_tint: ColourParam::WHITE,
        };
        self.material(name, kind)
    }

    fn shape(&mut self, geometry: Geometry, to_world: DMat4, material: MaterialId) {
        self.scene
            .shapes
            .push(Shape::new(geometry, to_world, material));
    }

    fn mesh(&mut self, mesh: Mesh, to_world: DMat4, material: MaterialId) {
        self.scene.meshes.push(mesh);
        let id = MeshId(self.scene.meshes.len() - 1);
        self.shape(Geometry::Mesh(id), to_world, material);
    }

    /// A parallelogram at `corner`; its normal is `u x v`.
    pub(super) fn quad(&mut self, corner: DVec3, u: DVec3, v: DVec3, material: MaterialId) {
        let positions = [corner, corner + u, corner + u + v, corner + v];
        let mesh = Mesh {
            positions: positions.map(|p| p.as_vec3().to_array()).to_vec(),
            uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        self.mesh(mesh, DMat4::IDENTITY, material);
    }

    /// A box between two corners.
    pub(super) fn cuboid(&mut self, low: DVec3, high: DVec3, material: MaterialId) {
        self.turned_cuboid(DMat4::IDENTITY, low, high, material);
    }

    /// A box between two corners, moved.
    pub(super) fn turned_cuboid(
        &mut self,
        to_world: DMat4,
        low: DVec3,
        high: DVec3,
        material: MaterialId,
    ) {
        self.mesh(cuboid(low, high), to_world, material);
    }

    /// A sphere.
    pub(super) fn sphere(&mut self, centre: DVec3, radius: f64, material: MaterialId) {
        let geometry = Geometry::Sphere {
            radius: narrow(radius),
        };
        self.shape(geometry, DMat4::from_translation(centre), material);
    }

    /// A profile of `(distance from the axis, height)` turned about the vertical through `foot`.
    /// Corners of the profile are rounded off by its shading normals.
    pub(super) fn lathe(&mut self, foot: DVec3, profile: &[[f64; 2]], material: MaterialId) {
        self.mesh(lathe(profile), DMat4::from_translation(foot), material);
    }

    /// Makes the shape that was added last emit light, on the side of its normal.
    pub(super) fn glow(&mut self, radiance: [f32; 3]) {
        if let Some(shape) = self.scene.shapes.last_mut() {
            shape.emission = Some(Emission {
                radiance: ColourParam::Value(Rgb::from(radiance)),
                two_sided: false,
            });
        }
    }
}

/// Twelve triangles, normals outwards.
fn cuboid(low: DVec3, high: DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [low, high] {
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            let is_high = side == high;
            let first = narrow_index(mesh.positions.len());
            for [a, b] in [[0, 0], [1, 0], [1, 1], [0, 1]] {
                let mut p = DVec3::ZERO;
                p[axis] = side[axis];
                // Counterclockwise from outside.
                let [a, b] = if is_high { [a, b] } else { [b, a] };
                p[u] = if a == 1 { high[u] } else { low[u] };
                p[v] = if b == 1 { high[v] } else { low[v] };
                mesh.positions.push(p.as_vec3().to_array());
            }
            mesh.triangles.push([first, first + 1, first + 2]);
            mesh.triangles.push([first, first + 2, first + 3]);
        }
    }
    mesh
}

fn lathe(profile: &[[f64; 2]]) -> Mesh {
    const SEGMENTS: u32 = 48;
    let mut mesh = Mesh::default();
    let last = profile.len().saturating_sub(1);
    for (row, &[r, z]) in profile.iter().enumerate() {
        let (p, q) = (profile[row.saturating_sub(1)], profile[(row + 1).min(last)]);
        // To the right of an upward profile is outside.
        let normal = dvec3(q[1] - p[1], 0.0, p[0] - q[0]).normalize_or(DVec3::Z);
        for segment in 0..SEGMENTS {
            let (sin, cos) = (TAU * f64::from(segment) / f64::from(SEGMENTS)).sin_cos();
            mesh.positions
                .push(dvec3(r * cos, r * sin, z).as_vec3().to_array());
            let turned = dvec3(normal.x * cos, normal.x * sin, normal.z);
            mesh.normals.push(turned.as_vec3().to_array());
        }
    }
    for row in 0..narrow_index(last) {
        for segment in 0..SEGMENTS {
            let [a, b] = [segment, (segment + 1) % SEGMENTS].map(|s| row * SEGMENTS + s);
            mesh.triangles.push([a, b, b + SEGMENTS]);
            mesh.triangles.push([a, b + SEGMENTS, a + SEGMENTS]);
        }
    }
    mesh
}

#[expect(clippy::cast_possible_truncation, reason = "lengths of furniture")]
fn narrow(value: f64) -> f32 {
    value as f32
}

#[expect(clippy::cast_possible_truncation, reason = "meshes are small")]
fn narrow_index(value: usize) -> u32 {
    value as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn geometric(mesh: &Mesh, triangle: [u32; 3]) -> (Vec3, Vec3) {
        let [a, b, c] = triangle.map(|i| Vec3::from(mesh.positions[i as usize]));
        ((a + b + c) / 3.0, (b - a).cross(c - a))
    }

    #[test]
    fn boxes_and_turned_profiles_face_outwards() {
        let boxed = cuboid(dvec3(1.0, 2.0, 3.0), dvec3(2.0, 4.0, 6.0));
        assert_eq!(boxed.triangles.len(), 12);
        for &t in &boxed.triangles {
            let (centre, normal) = geometric(&boxed, t);
            assert!((centre - Vec3::new(1.5, 3.0, 4.5)).dot(normal) > 0.0);
        }
        let turned = lathe(&[[0.1, 0.0], [0.4, 0.3], [0.2, 0.9]]);
        for &t in &turned.triangles {
            let (centre, normal) = geometric(&turned, t);
            let axis = Vec3::new(0.0, 0.0, centre.z);
            assert!((centre - axis).dot(normal) > 0.0);
            for i in t {
                assert!(Vec3::from(turned.normals[i as usize]).dot(normal) > 0.0);
            }
        }
    }
}
