//! Errors of one coarsely turned orb with smooth normals by sampler, from renders that are independent of
//! each other.

use glam::DVec3;
use specula_bsdf::Rgb;
use specula_bsdf::energy::{EnergyModel, FmsVariant};
use specula_bsdf::vndf::Sampler;
use specula_render::picture::Picture;
use specula_scene::scene::Geometry;
use specula_scene::{Energy, Scene};

use super::orb_render::by_sampler;
use crate::scenes::orbs::{self, Tessellation};
use crate::{Lab, Result};

/// The compensation of the paper's section 6.
pub(super) const ENERGY: Energy =
    Energy::Compensated(EnergyModel::Turquin(FmsVariant::NormalIncidence));

/// Samples per pixel of fig. 6.
pub(super) const SPP: u32 = 16;

/// The orb.
pub(super) fn scene(alphas: (f64, f64), side: u32) -> Scene {
    orbs::single(alphas, Tessellation::COARSE, side)
}

/// So many renders of a scene.
pub(super) fn renders(
    lab: &Lab<'_>,
    scene: &Scene,
    sampler: Sampler,
    count: u32,
) -> Result<Vec<Picture>> {
    (0..count)
        .map(|number| Ok(by_sampler(lab, scene, sampler, ENERGY, SPP, number)?.picture))
        .collect()
}

/// Root mean squared error of one of the renders, from how they differ from their mean: no reference is
/// needed where they are without bias.
pub(super) fn rmse(renders: &[Picture]) -> f64 {
    mean_square(renders, |_| true).sqrt()
}

/// Estimates of the mean squared error from eight stripes of rows each, for their spread.
pub(super) fn squares_by_stripe(renders: &[Picture]) -> Vec<f64> {
    (0..8)
        .map(|stripe| mean_square(renders, |row| row % 8 == stripe))
        .collect()
}

fn mean_square(renders: &[Picture], is_counted: impl Fn(usize) -> bool) -> f64 {
    let Some(first) = renders.first() else {
        return f64::NAN;
    };
    let n = renders.len() as f64;
    let channels = |c: Rgb<f32>| [c.r, c.g, c.b].map(f64::from);
    let (mut sum, mut count) = (0.0, 0.0);
    for i in 0..first.colour.len() {
        if !is_counted(i / first.width.max(1) as usize) {
            continue;
        }
        for k in 0..3 {
            let values = || renders.iter().map(|r| channels(r.colour[i])[k]);
            let mean = values().sum::<f64>() / n;
            sum += values().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0);
            count += 1.0;
        }
    }
    sum / f64::max(count, 1.0)
}

/// Pixels without any light.
pub(super) fn black_pixels(picture: &Picture) -> u32 {
    let is_black = |c: &&Rgb<f32>| c.luminance() <= 0.0;
    u32::try_from(picture.colour.iter().filter(is_black).count()).unwrap_or(u32::MAX)
}

/// Share of the faces towards the viewer, as they are projected, in which the interpolated normal faces
/// away; faces that others hide count too.
pub(super) fn backfacing_share(scene: &Scene) -> f64 {
    const STEPS: u32 = 8;
    let towards = orbs::towards_viewer();
    let (mut away, mut all) = (0.0, 0.0);
    for shape in &scene.shapes {
        let Geometry::Mesh(mesh) = shape.geometry else {
            continue;
        };
        let mesh = &scene.meshes[mesh.0];
        // Rotation and translation: normals turn as vectors do.
        let vector = |v: [f32; 3]| {
            let v = DVec3::from(v.map(f64::from));
            shape.to_world.transform_vector3(v)
        };
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| vector(mesh.positions[i as usize]));
            let normals = triangle.map(|i| vector(mesh.normals[i as usize]));
            let area = (b - a).cross(c - a).dot(towards);
            if area <= 0.0 {
                continue;
            }
            for i in 0..STEPS {
                for j in 0..STEPS - i {
                    let [u, v] = [i, j].map(|n| (f64::from(n) + 1.0 / 3.0) / f64::from(STEPS));
                    let normal = normals[0] * (1.0 - u - v) + normals[1] * u + normals[2] * v;
                    all += area;
                    away += if normal.dot(towards) < 0.0 { area } else { 0.0 };
                }
            }
        }
    }
    away / f64::max(all, f64::MIN_POSITIVE)
}
