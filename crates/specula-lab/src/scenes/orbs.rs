//! Lathe-turned orbs of silver, hollow and open towards the viewer: light bounces many times within.
//!
//! Lengths are in radii of an orb, z is up. The light is a picture of all directions without small bright
//! parts, so that what is far too bright in a picture comes from the weights of paths.

use std::f64::consts::PI;

use glam::{DMat4, DVec3};
use specula_bsdf::{Rgb, metals};
use specula_scene::scene::{
    Camera, ColourParam, ConductorFresnel, EnvironmentMapping, FloatParam, Geometry, ImageId,
    Light, Material, MaterialId, MaterialKind, Mesh, MeshId, Projection, Roughness,
    RoughnessMapping, Shape,
};
use specula_scene::{Image, Scene};

/// From orb to orb, and the side of the square that each has in the picture.
pub(crate) const SPACING: f64 = 2.3;

/// How finely orbs are turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tessellation {
    /// Rows of the profile.
    pub(crate) rows: u32,
    /// Segments about the axis.
    pub(crate) segments: u32,
}

impl Tessellation {
    /// Smooth to the eye.
    pub(crate) const FINE: Self = Self {
        rows: 100,
        segments: 96,
    };
    /// Few faces with smooth normals: along their silhouettes, shading normals face away.
    pub(crate) const COARSE: Self = Self {
        rows: 14,
        segments: 10,
    };
}

/// Orbs side by side on a grey floor, each with its alphas, a square of `side` pixels each.
#[must_use]
pub(crate) fn row(alphas: &[(f64, f64)], tessellation: Tessellation, side: u32) -> Scene {
    let mut scene = empty(alphas.len(), side);
    orbs(&mut scene, alphas, tessellation);
    let floor = MaterialKind::Diffuse {
        reflectance: ColourParam::Value(Rgb::splat(0.3)),
        roughness: FloatParam::Value(0.0),
    };
    scene.materials.push(Material::new(floor));
    scene.meshes.push(floor_mesh());
    let (material, mesh) = (scene.materials.len() - 1, scene.meshes.len() - 1);
    push_shape(&mut scene, mesh, DMat4::IDENTITY, material);
    scene
}

/// One orb in the open.
#[must_use]
pub(crate) fn single(alphas: (f64, f64), tessellation: Tessellation, side: u32) -> Scene {
    let mut scene = empty(1, side);
    orbs(&mut scene, &[alphas], tessellation);
    scene
}

/// Towards the viewer of both scenes.
#[must_use]
pub(crate) fn towards_viewer() -> DVec3 {
    DVec3::new(0.0, -0.94, 0.34).normalize()
}

/// Camera, film and light, without shapes.
fn empty(count: usize, side: u32) -> Scene {
    let mut scene = specula_scene::builtin::orbs();
    let columns = u32::try_from(count).unwrap_or(1) * side;
    scene.film.resolution = [columns, side];
    scene.film.crop = [0, columns, 0, side];
    scene.camera = camera(count as f64);
    scene.images = vec![sky()];
    scene.textures.clear();
    scene.materials.clear();
    scene.meshes.clear();
    scene.shapes.clear();
    scene.lights = vec![Light::Infinite {
        radiance: Rgb::splat(1.0),
        image: Some((ImageId(0), EnvironmentMapping::LatitudeLongitude)),
        to_world: DMat4::IDENTITY,
    }];
    scene
}

/// Parallel rays, so that every orb fills its square alike.
fn camera(count: f64) -> Camera {
    let half = 0.5 * SPACING;
    let towards = towards_viewer();
    let eye = DVec3::new(0.0, 0.0, 1.0) + towards * 30.0;
    let forward = -towards;
    let right = forward.cross(DVec3::Z).normalize();
    let up = right.cross(forward);
    Camera {
        to_world: DMat4::from_cols(
            right.extend(0.0),
            up.extend(0.0),
            forward.extend(0.0),
            eye.extend(1.0),
        ),
        projection: Projection::Orthographic,
        lens_radius: 0.0,
        focal_distance: 30.0,
        screen_window: [-half * count, half * count, -half, half],
        motion: None,
    }
}

fn orbs(scene: &mut Scene, alphas: &[(f64, f64)], tessellation: Tessellation) {
    let Tessellation { rows, segments } = tessellation;
    scene.meshes.push(revolved(&shell_profile(rows), segments));
    let middle = 0.5 * (alphas.len() as f64 - 1.0);
    for (i, &alphas) in alphas.iter().enumerate() {
        scene.materials.push(Material::new(silver(alphas)));
        // The opening leans towards the viewer.
        let place = DMat4::from_translation(DVec3::new(SPACING * (i as f64 - middle), 0.0, 1.0))
            * DMat4::from_rotation_z(-0.35)
            * DMat4::from_rotation_x(0.8);
        push_shape(scene, 0, place, i);
    }
}

fn push_shape(scene: &mut Scene, mesh: usize, to_world: DMat4, material: usize) {
    let geometry = Geometry::Mesh(MeshId(mesh));
    scene
        .shapes
        .push(Shape::new(geometry, to_world, MaterialId(material)));
}

fn silver((alpha_x, alpha_y): (f64, f64)) -> MaterialKind {
    let index = |channel: [f64; 3]| ColourParam::Value(Rgb::from(channel).cast());
    let fresnel = match metals::by_symbol("Ag") {
        Some(metal) => ConductorFresnel::Index {
            eta: index(metal.eta),
            k: index(metal.k),
        },
        // Not reached: the table has silver.
        None => ConductorFresnel::Reflectance(ColourParam::Value(Rgb::splat(0.95))),
    };
    let value = |alpha| FloatParam::Value(single_precision(alpha));
    MaterialKind::Conductor {
        fresnel,
        roughness: Roughness {
            v: value(alpha_y),
            ..Roughness::isotropic(value(alpha_x), RoughnessMapping::Alpha)
        },
        tint: ColourParam::WHITE,
    }
}

/// Latitude and longitude: a gradient, and a broad soft light above and to the left of the viewer.
fn sky() -> Image {
    const WIDTH: u32 = 128;
    const HEIGHT: u32 = 64;
    let light = DVec3::new(-0.6, -0.55, 0.58).normalize();
    let mut pixels = Vec::new();
    for row in 0..HEIGHT {
        let theta = PI * (f64::from(row) + 0.5) / f64::from(HEIGHT);
        for column in 0..WIDTH {
            let phi = 2.0 * PI * (f64::from(column) + 0.5) / f64::from(WIDTH);
            let direction = DVec3::new(
                theta.sin() * phi.cos(),
                theta.sin() * phi.sin(),
                theta.cos(),
            );
            let up = 0.5 + 0.5 * direction.z;
            let t = ((direction.dot(light) - 0.85) / 0.1).clamp(0.0, 1.0);
            let soft = 2.0 * t * t * (3.0 - 2.0 * t);
            let gradient = 0.15 + 0.65 * up * up;
            pixels.push(
                [
                    0.95 * gradient + soft,
                    gradient + soft,
                    1.05 * gradient + soft,
                ]
                .map(single_precision),
            );
        }
    }
    Image {
        name: "sky".to_owned(),
        width: WIDTH,
        height: HEIGHT,
        pixels: pixels.into(),
    }
}

/// `(distance from the axis, z)` from the inside of the shell's bottom over its lip to the outside.
fn shell_profile(rows: u32) -> Vec<[f64; 2]> {
    const OPENING: f64 = 1.1;
    const INNER: f64 = 0.82;
    let (middle, lip) = (0.5 * (1.0 + INNER), 0.5 * (1.0 - INNER));
    let arc = PI - OPENING;
    let lengths = [INNER * arc, PI * lip, arc];
    let total: f64 = lengths.iter().sum();
    // The poles are left open by a hair: at a pole, no tangent is defined.
    let on = |radius: f64, theta: f64| {
        let theta = theta.min(PI - 1e-3);
        [radius * theta.sin(), radius * theta.cos()]
    };
    (0..=rows)
        .map(|i| {
            let at = total * f64::from(i) / f64::from(rows);
            if at < lengths[0] {
                on(INNER, PI - at / INNER)
            } else if at < lengths[0] + lengths[1] {
                // Half a circle from the inner to the outer radius, on the side of the opening.
                let turn = (at - lengths[0]) / lip;
                let along = -lip * turn.cos();
                let over = lip * turn.sin();
                let (sine, cosine) = OPENING.sin_cos();
                [
                    (middle + along) * sine - over * cosine,
                    (middle + along) * cosine + over * sine,
                ]
            } else {
                on(1.0, OPENING + at - lengths[0] - lengths[1])
            }
        })
        .collect()
}

/// Turns a profile about the z axis; u runs about the axis, v along the profile. The outside is to the
/// left of the profile's direction when it runs from +z to -z.
fn revolved(profile: &[[f64; 2]], segments: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let last = profile.len() - 1;
    for (row, &[r, z]) in profile.iter().enumerate() {
        let (p, q) = (profile[row.saturating_sub(1)], profile[(row + 1).min(last)]);
        let length = (p[0] - q[0]).hypot(p[1] - q[1]);
        let [nr, nz] = [(p[1] - q[1]) / length, (q[0] - p[0]) / length];
        for segment in 0..=segments {
            // The last column equals the first exactly.
            let turn = 2.0 * PI * f64::from(segment % segments) / f64::from(segments);
            let (sin, cos) = turn.sin_cos();
            let uv = [
                f64::from(segment) / f64::from(segments),
                row as f64 / last as f64,
            ];
            mesh.positions
                .push([r * cos, r * sin, z].map(single_precision));
            mesh.normals
                .push([nr * cos, nr * sin, nz].map(single_precision));
            mesh.uvs.push(uv.map(single_precision));
        }
    }
    let stride = segments + 1;
    for row in 0..u32::try_from(last).unwrap_or(0) {
        for segment in 0..segments {
            let a = row * stride + segment;
            let (b, c, d) = (a + stride, a + stride + 1, a + 1);
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}

fn floor_mesh() -> Mesh {
    let corner = |x: f32, y: f32| [20.0 * x, 20.0 * y, 0.0];
    Mesh {
        positions: vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding is what this function is for"
)]
fn single_precision(x: f64) -> f32 {
    x as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn scenes_are_valid_and_normals_agree_with_windings() {
        for tessellation in [Tessellation::FINE, Tessellation::COARSE] {
            let scene = row(&[(0.2, 0.2), (1.0, 0.5)], tessellation, 16);
            scene.validate().unwrap();
            for mesh in &scene.meshes {
                for t in &mesh.triangles {
                    let [a, b, c] = t.map(|i| Vec3::from(mesh.positions[i as usize]));
                    let n: Vec3 = t.map(|i| Vec3::from(mesh.normals[i as usize])).iter().sum();
                    assert!((b - a).cross(c - a).dot(n) > 0.0, "{t:?}");
                }
            }
        }
        single((0.5, 0.5), Tessellation::COARSE, 16)
            .validate()
            .unwrap();
    }
}
