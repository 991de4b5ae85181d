//! The floor under an object whose file has no light; y is up.

use glam::{DMat4, DVec3, Vec3};
use rayon::prelude::*;
use specula_bsdf::Rgb;

use crate::bounds::{self, BoundingBox, FARTHEST};
use crate::num::f32_of;
use crate::scene::{
    ColourParam, FloatParam, Geometry, Material, MaterialId, MaterialKind, Scene, Shape,
};

/// Albedo of the floor: neutral, and darker than most objects.
pub(super) const ALBEDO: f32 = 0.2;

/// Radius of the floor over that of the object: seen from where the object fills the picture, its
/// rim is a degree below the horizon.
const REACH: f64 = 100.0;

/// Gap between object and floor over the object's radius: a fraction of a pixel, so that what is
/// flat below does not flicker against the floor.
const GAP: f64 = 1e-3;

/// The floor under what a scene shows, with a material of its own; `None` where nothing is shown.
///
/// * `bounds`: of the scene.
pub(super) fn under(scene: &Scene, bounds: BoundingBox) -> Option<(Material, Shape)> {
    let lowest = lowest(scene)?;
    let radius = bounds.radius();
    let farthest = bounds.farthest();
    // Far from the origin, positions are known to a few ulps only.
    let gap = GAP * radius + 4.0 * f64::from(f32::EPSILON) * farthest;
    let reach = (REACH * radius).min(0.9 * (FARTHEST - farthest));
    let centre = bounds.centre().with_y((lowest - gap).max(-FARTHEST));
    if !(reach > 0.0 && centre.is_finite()) {
        return None;
    }
    let material = Material {
        name: Some(unused_name(&scene.materials)),
        ..Material::new(MaterialKind::Diffuse {
            reflectance: ColourParam::Value(Rgb::splat(ALBEDO)),
            roughness: FloatParam::Value(0.0),
        })
    };
    let disk = Geometry::Disk {
        radius: f32_of(reach),
        height: 0.0,
    };
    let to_world = DMat4::from_translation(centre) * super::Z_UP;
    let shape = Shape::new(disk, to_world, MaterialId(scene.materials.len()));
    Some((material, shape))
}

/// `floor`, or `floor-2` and so on where a material of the file is called that.
fn unused_name(materials: &[Material]) -> String {
    let is_taken = |name: &str| materials.iter().any(|m| m.name.as_deref() == Some(name));
    let mut name = "floor".to_owned();
    let mut number = 2;
    while is_taken(&name) {
        name = format!("floor-{number}");
        number += 1;
    }
    name
}

/// The least y of all that a scene shows: of the points themselves, as boxes around turned shapes
/// reach below them.
fn lowest(scene: &Scene) -> Option<f64> {
    let mut placed: Vec<(f64, Geometry, DMat4)> = Vec::new();
    let of =
        |shape: &Shape| bounds::of_geometry(&scene.meshes, scene.exact_meshes(), &shape.geometry);
    for shape in &scene.shapes {
        let low = of(shape).transformed(&shape.to_world).min.y;
        placed.push((low, shape.geometry, shape.to_world));
    }
    let boxes: Vec<Vec<BoundingBox>> = (scene.objects.iter())
        .map(|object| object.shapes.iter().map(of).collect())
        .collect();
    for instance in &scene.instances {
        let object = instance.object.0;
        for (shape, own) in scene.objects[object].shapes.iter().zip(&boxes[object]) {
            let to_world = instance.to_world * shape.to_world;
            placed.push((own.transformed(&to_world).min.y, shape.geometry, to_world));
        }
    }
    // Lowest boxes first: most shapes need no closer look.
    placed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut lowest = f64::INFINITY;
    for (low, geometry, to_world) in &placed {
        if *low >= lowest {
            break;
        }
        lowest = lowest.min(lowest_of(scene, geometry, to_world));
    }
    lowest.is_finite().then_some(lowest)
}

/// The least y of a geometry in the world.
fn lowest_of(scene: &Scene, geometry: &Geometry, to_world: &DMat4) -> f64 {
    let row = to_world.row(1);
    let height = |p: [f32; 3]| row.dot(Vec3::from(p).as_dvec3().extend(1.0));
    match *geometry {
        Geometry::Mesh(id) => {
            let mesh = &scene.meshes[id.0];
            let of_triangle = |triangle: &[u32; 3]| {
                let heights = triangle.map(|i| height(mesh.positions[i as usize]));
                heights.into_iter().fold(f64::INFINITY, f64::min)
            };
            (mesh.triangles.par_iter().with_min_len(1 << 14))
                .map(of_triangle)
                .reduce(|| f64::INFINITY, f64::min)
        }
        Geometry::Sphere { radius } => row.w - f64::from(radius) * row.truncate().length(),
        Geometry::Disk { radius, height } => {
            let centre = row.dot(DVec3::new(0.0, 0.0, f64::from(height)).extend(1.0));
            centre - f64::from(radius) * row.x.hypot(row.y)
        }
        Geometry::QuadricPart(part) => row.w + part.least_along(row.truncate()),
        // At corners.
        Geometry::Patches(id) => {
            let mesh = &scene.patch_meshes[id.0];
            let corners = mesh.patches.iter().flatten();
            let heights = corners.map(|&i| height(mesh.positions[i as usize]));
            heights.fold(f64::INFINITY, f64::min)
        }
        // At the vertices of its triangles.
        Geometry::Curves(id) => {
            let mesh = scene.curve_meshes[id.0].mesh();
            let heights = mesh.positions.iter().map(|p| height(*p));
            heights.fold(f64::INFINITY, f64::min)
        }
    }
}
