//! Surfaces of revolution: the orb and its foot.

use std::f64::consts::{PI, TAU};

use crate::num::f32_of;
use crate::scene::Mesh;

/// Height of the orb's centre above the ground that its foot stands on, in its radii.
pub(super) const ORB_HEIGHT: f64 = 1.19;

/// A sphere of radius 1 about the origin, with two grooves about the pole at +z.
///
/// u runs once about the axis, v along the meridian: dp/du is the direction in which a lathe cuts.
pub(super) fn orb() -> Mesh {
    const ROWS: u32 = 168;
    let profile: Vec<[f64; 2]> = (0..=ROWS)
        .map(|i| {
            // The poles are left open by a hair: at a pole, no tangent is defined.
            let theta = 1e-3 + (PI - 2e-3) * f64::from(i) / f64::from(ROWS);
            let radius = 1.0 - groove(theta, 0.62, 0.035, 0.035) - groove(theta, 2.2, 0.05, 0.03);
            [radius * theta.sin(), radius * theta.cos()]
        })
        .collect();
    revolved(&profile, 192)
}

/// Depth at `theta` of a groove about `at`: flat over `half_width`, with smooth flanks.
fn groove(theta: f64, at: f64, half_width: f64, depth: f64) -> f64 {
    const FLANK: f64 = 0.03;
    let x = ((half_width + FLANK - (theta - at).abs()) / FLANK).clamp(0.0, 1.0);
    depth * x * x * (3.0 - 2.0 * x)
}

/// A rounded ring on the ground, about the z axis, that the orb of [`orb`] rests in.
pub(super) fn foot() -> Mesh {
    const ROWS: u32 = 40;
    let profile: Vec<[f64; 2]> = (0..=ROWS)
        .map(|i| {
            // A superellipse about (0.62, 0.17), closed; clockwise, so that the outside is outside.
            let angle = -TAU * f64::from(i) / f64::from(ROWS);
            let power = |v: f64| v.signum() * v.abs().sqrt();
            [
                0.60 + 0.17 * power(angle.cos()),
                0.171 + 0.17 * power(angle.sin()),
            ]
        })
        .collect();
    revolved(&profile, 96)
}

/// Turns a profile of `(distance from the axis, z)` about the z axis.
///
/// The outside is to the left of the profile's direction when it runs from +z to -z at a positive
/// distance; triangles wind counterclockwise seen from there.
fn revolved(profile: &[[f64; 2]], segments: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let rows = profile.len();
    for (row, [r, z]) in profile.iter().enumerate() {
        let [nr, nz] = profile_normal(profile, row);
        for segment in 0..=segments {
            let u = f64::from(segment) / f64::from(segments);
            // The last column equals the first exactly.
            let (sin, cos) = (TAU * f64::from(segment % segments) / f64::from(segments)).sin_cos();
            let v = row as f64 / (rows - 1) as f64;
            mesh.positions.push([r * cos, r * sin, *z].map(f32_of));
            mesh.normals.push([nr * cos, nr * sin, nz].map(f32_of));
            mesh.uvs.push([u, v].map(f32_of));
        }
    }
    let stride = segments + 1;
    let last_row = u32::try_from(rows - 1).unwrap_or(0);
    for row in 0..last_row {
        for segment in 0..segments {
            let a = row * stride + segment;
            let (b, c, d) = (a + stride, a + stride + 1, a + 1);
            mesh.triangles.push([a, b, c]);
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}

/// Normal of the profile at a row, from the neighbours on both sides; unit.
fn profile_normal(profile: &[[f64; 2]], row: usize) -> [f64; 2] {
    let last = profile.len() - 1;
    let closed = distance(profile[0], profile[last]) < 1e-9;
    let before = match row {
        0 if closed => last - 1,
        0 => 0,
        _ => row - 1,
    };
    let after = match row {
        _ if row < last => row + 1,
        _ if closed => 1,
        _ => last,
    };
    let (p, q) = (profile[before], profile[after]);
    let length = distance(p, q);
    [(p[1] - q[1]) / length, (q[0] - p[0]) / length]
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn windings_agree_with_normals_and_normals_point_out() {
        for (mesh, centre) in [(orb(), 0.0), (foot(), 0.60)] {
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| Vec3::from(mesh.positions[i as usize]));
                let n: Vec3 = t.map(|i| Vec3::from(mesh.normals[i as usize])).iter().sum();
                let geometric = (b - a).cross(c - a);
                assert!(geometric.dot(n) > 0.0, "{t:?}");
            }
            for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
                let (p, n) = (Vec3::from(*p), Vec3::from(*n));
                assert!((n.length() - 1.0).abs() < 1e-5);
                let axis = Vec3::new(p.x, p.y, 0.0).normalize_or_zero() * centre;
                let middle = if centre > 0.0 { 0.171 } else { 0.0 };
                assert!((p - axis - Vec3::new(0.0, 0.0, middle)).dot(n) > 0.0);
            }
        }
    }

    #[test]
    fn the_foot_carries_the_orb_without_piercing_it_deeply() {
        let orb_centre = Vec3::new(0.0, 0.0, f32_of(ORB_HEIGHT));
        let nearest = foot()
            .positions
            .iter()
            .map(|p| (Vec3::from(*p) - orb_centre).length())
            .fold(f32::INFINITY, f32::min);
        assert!((0.97..1.03).contains(&nearest), "{nearest}");
    }
}
