//! Coordinates of parts of quadrics.

use specula_bsdf::Vec3;
use specula_scene::scene::QuadricPart;

use crate::convert::narrow;

/// Texture coordinates at a point of a part.
///
/// Source: pbrt-v4's `Sphere`, `Cylinder` and `Disk`. In doubles: thin parts stretch what is left of the digits.
pub(super) fn uv_of_part(part: &QuadricPart, q: Vec3<f32>) -> [f32; 2] {
    let [x, y, z] = q.to_array().map(f64::from);
    let phi = y.atan2(x);
    let phi = if phi < 0.0 {
        phi + core::f64::consts::TAU
    } else {
        phi
    };
    let (phi_max, v) = match *part {
        QuadricPart::Sphere {
            radius,
            z: heights,
            phi_max,
        } => {
            let angle = |z: f64| (z / f64::from(radius)).clamp(-1.0, 1.0).acos();
            let [low, high] = heights.map(|z| angle(f64::from(z)));
            (phi_max, (low - angle(z)) / (low - high))
        }
        QuadricPart::Cylinder {
            z: heights,
            phi_max,
            ..
        } => {
            let [low, high] = heights.map(f64::from);
            (phi_max, (z - low) / (high - low))
        }
        QuadricPart::Disk {
            radius,
            inner,
            phi_max,
            ..
        } => {
            let [radius, inner] = [radius, inner].map(f64::from);
            (phi_max, (radius - x.hypot(y)) / (radius - inner))
        }
    };
    let u = phi / f64::from(phi_max);
    [u, v].map(|x| narrow(x.clamp(0.0, 1.0)))
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec3};
    use specula_scene::scene::{Geometry as SceneGeometry, Shape};

    use super::*;
    use crate::accel::Ray;
    use crate::options::RenderOptions;
    use crate::prepared::PreparedScene;

    fn parts() -> [QuadricPart; 4] {
        let radius = 0.8;
        let phi_max = 4.0;
        [
            QuadricPart::Sphere {
                radius,
                z: [-0.3, 0.7],
                phi_max,
            },
            QuadricPart::Cylinder {
                radius,
                z: [-0.4, 1.1],
                phi_max,
            },
            QuadricPart::Cylinder {
                radius,
                z: [0.0, 1.0],
                phi_max: QuadricPart::TURN,
            },
            QuadricPart::Disk {
                radius,
                inner: 0.3,
                height: 0.2,
                phi_max,
            },
        ]
    }

    /// Rays along the normals at the vertices of the mesh meet the surface with the vertex's coordinates and normal,
    /// and its derivatives are the differences between vertices.
    #[test]
    fn surfaces_are_those_of_the_meshes_vertices() {
        for (i, part) in (0..).zip(parts()) {
            let place = DMat4::from_translation(DVec3::new(0.3, -0.2, 2.0))
                * DMat4::from_rotation_x(0.7 + f64::from(i))
                * DMat4::from_scale(DVec3::new(1.0, 0.6, 1.4));
            let mut scene = specula_scene::builtin::orbs();
            let material = scene.shapes[0].material;
            let mut shape = Shape::new(SceneGeometry::QuadricPart(part), place, material);
            shape.reverse_orientation = i % 2 == 1;
            let sign = if shape.reverse_orientation { -1.0 } else { 1.0 };
            scene.shapes = vec![shape];
            let prepared = PreparedScene::new(&scene, &RenderOptions::default()).unwrap();
            let geometry = &prepared.geometry;
            let mesh = part.mesh();
            let columns = mesh.uvs.iter().position(|uv| uv[1] > 0.0).unwrap();
            let rows = mesh.uvs.len() / columns;
            let at = |row: usize, column: usize| row * columns + column;
            let moved = |v: usize| {
                let p = DVec3::from(mesh.positions[v].map(f64::from));
                crate::convert::narrow3(place.transform_point3(p))
            };
            let normals = crate::convert::normal_matrix(&place) * sign;
            let turned = |v: usize| {
                let n = DVec3::from(mesh.normals[v].map(f64::from));
                crate::convert::narrow3((normals * n).normalize())
            };
            let mut met = 0;
            for column in (1..columns - 1).step_by(7) {
                let row = rows / 2;
                // Between two rows, as some meshes have no inner ones.
                let (below, above) = (at(row - 1, column), at(row, column));
                let near = if rows > 2 { above } else { below };
                let inward = if rows > 2 { 0.0 } else { 1e-3 };
                let (p, n) = (moved(near), turned(near));
                let target = p + (moved(above) - p) * inward;
                for side in [1.0, -1.0] {
                    let origin = target + n * (0.05 * side);
                    let ray = Ray {
                        origin,
                        direction: n * -side,
                        t_max: f32::INFINITY,
                    };
                    let hit = geometry.accel.intersect(&ray).expect("it is met");
                    let surface = geometry.surface(&ray, &hit, 0.0);
                    assert!((surface.position - target).length() < 1e-5, "{part:?}");
                    assert!((surface.ng - n).length() < 2e-5, "{part:?}");
                    assert_eq!(surface.ng, surface.ns);
                    let uv = mesh.uvs[near];
                    let expected = [uv[0], uv[1] + inward * (mesh.uvs[above][1] - uv[1])];
                    for k in 0..2 {
                        let error = (surface.uv[k] - expected[k]).abs();
                        assert!(error < 1e-5, "{part:?}: {:?} {expected:?}", surface.uv);
                    }
                    let partials = geometry.partials(&surface);
                    let difference = |a: usize, b: usize, k: usize| {
                        let du = mesh.uvs[b][k] - mesh.uvs[a][k];
                        [
                            (moved(b) - moved(a)) * (1.0 / du),
                            (turned(b) - turned(a)) * (1.0 / du),
                        ]
                    };
                    let along = [
                        difference(at(row, column - 1), at(row, column + 1), 0),
                        difference(at(row - 1, column), at((row + 1).min(rows - 1), column), 1),
                    ];
                    for (k, [dp, dn]) in along.into_iter().enumerate() {
                        // On a disk the outer row has a longer dp/du.
                        let is_disk = matches!(part, QuadricPart::Disk { .. });
                        if is_disk && k == 0 {
                            continue;
                        }
                        let slack = 5e-3 * (1.0 + dp.length() + dn.length());
                        assert!((partials.dp[k] - dp).length() < slack, "{part:?} {k}");
                        assert!((partials.dn[k] - dn).length() < slack, "{part:?} {k}");
                    }
                    let unit = partials.dp[0].normalize();
                    assert!((surface.tangent.normalize() - unit).length() < 1e-4);
                    met += 1;
                }
            }
            assert!(met > 40, "{part:?}: {met}");
        }
    }
}
