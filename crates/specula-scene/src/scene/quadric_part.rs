//! Parts of spheres and disks, and cylinders: shapes about the z axis that are cut off by planes and azimuths.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Mesh;
use crate::num::f32_of;

/// A part of a sphere, of a cylinder or of a disk, from the azimuth 0 to `phi_max` about the z axis.
///
/// Texture coordinates are pbrt-v4's: u runs along the azimuth from 0 to 1, v from the least z to the greatest (along
/// the polar angle on spheres), and on disks from the outline inwards. Normals point away from the axis or the centre,
/// and to +z on disks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QuadricPart {
    /// Of the sphere about the origin.
    Sphere {
        /// Radius.
        radius: f32,
        /// Least and greatest z, within the radius.
        z: [f32; 2],
        /// Greatest azimuth in radians, at most a turn.
        phi_max: f32,
    },
    /// Of the cylinder about the z axis, open at its ends.
    Cylinder {
        /// Radius.
        radius: f32,
        /// Least and greatest z.
        z: [f32; 2],
        /// Greatest azimuth in radians, at most a turn.
        phi_max: f32,
    },
    /// Of a disk perpendicular to z.
    Disk {
        /// Radius.
        radius: f32,
        /// Radius of the hole, below that of the disk; 0: none.
        inner: f32,
        /// Its z.
        height: f32,
        /// Greatest azimuth in radians, at most a turn.
        phi_max: f32,
    },
}

impl QuadricPart {
    /// A full turn as the greatest azimuth.
    pub const TURN: f32 = core::f32::consts::TAU;

    /// What is wrong with its numbers; `None`: nothing.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let (Self::Sphere {
            radius, phi_max, ..
        }
        | Self::Cylinder {
            radius, phi_max, ..
        }
        | Self::Disk {
            radius, phi_max, ..
        }) = *self;
        if !(radius > 0.0 && radius.is_finite()) {
            return Some("its radius is not above 0");
        }
        if !(phi_max > 0.0 && phi_max <= Self::TURN) {
            return Some("its greatest azimuth is not above 0 and at most a turn");
        }
        match *self {
            Self::Sphere { z: [low, high], .. } if !(-radius <= low && high <= radius) => {
                Some("its heights are outside its sphere")
            }
            Self::Sphere { z: [low, high], .. } | Self::Cylinder { z: [low, high], .. } => {
                let is_sound = low < high && low.is_finite() && high.is_finite();
                (!is_sound).then_some("its least height is not below its greatest")
            }
            Self::Disk { inner, height, .. } if height.is_finite() => {
                let is_sound = (0.0..radius).contains(&inner);
                (!is_sound).then_some("its inner radius is not from 0 to below its radius")
            }
            Self::Disk { .. } => Some("its height is not finite"),
        }
    }

    /// Area, in its own space.
    #[must_use]
    pub fn area(&self) -> f64 {
        match *self {
            Self::Sphere { radius, z, phi_max } | Self::Cylinder { radius, z, phi_max } => {
                let [low, high] = z.map(f64::from);
                f64::from(phi_max).min(TAU) * f64::from(radius) * (high - low)
            }
            Self::Disk {
                radius,
                inner,
                phi_max,
                ..
            } => {
                let (radius, inner) = (f64::from(radius), f64::from(inner));
                f64::from(phi_max).min(TAU) * 0.5 * (radius - inner) * (radius + inner)
            }
        }
    }

    /// The least `w . p` over its points: its box under any linear map, row by row.
    ///
    /// With `m` the least of `w.x cos phi + w.y sin phi` over its azimuths, that is the least of `m r + w.z z` over the
    /// profile; for `m < 0` that of a sphere may be where `(r, z)` is opposite to `(m, w.z)`, else it is at an end.
    #[must_use]
    pub fn least_along(&self, w: DVec3) -> f64 {
        let (Self::Sphere { phi_max, .. }
        | Self::Cylinder { phi_max, .. }
        | Self::Disk { phi_max, .. }) = *self;
        let phi_max = f64::from(phi_max);
        let opposite = azimuth(-w.x, -w.y);
        let across = if opposite <= phi_max {
            -w.x.hypot(w.y)
        } else {
            let (sin, cos) = phi_max.sin_cos();
            w.x.min(w.x * cos + w.y * sin)
        };
        match *self {
            Self::Sphere { radius, z, .. } => {
                let (radius, z) = (f64::from(radius), z.map(f64::from));
                let at = |z: f64| {
                    let r = ((radius - z) * (radius + z)).max(0.0).sqrt();
                    across * r + w.z * z
                };
                let length = across.hypot(w.z);
                let inner = -radius * w.z / length;
                let ends = at(z[0]).min(at(z[1]));
                if across < 0.0 && z[0] < inner && inner < z[1] {
                    return ends.min(-radius * length);
                }
                ends
            }
            Self::Cylinder { radius, z, .. } => {
                let [low, high] = z.map(|z| w.z * f64::from(z));
                across * f64::from(radius) + low.min(high)
            }
            Self::Disk {
                radius,
                inner,
                height,
                ..
            } => {
                let [rim, hole] = [radius, inner].map(|r| across * f64::from(r));
                rim.min(hole) + w.z * f64::from(height)
            }
        }
    }

    /// Its triangles, with its coordinates and normals: 256 edges to the full turn of a sphere, within 7.6e-5 radii of
    /// the surface, and 512 to that of cylinders and disks, within 1.9e-5.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        match *self {
            Self::Sphere { radius, z, phi_max } => {
                let (radius, phi_max) = (f64::from(radius), f64::from(phi_max));
                let angle = |z: f32| (f64::from(z) / radius).clamp(-1.0, 1.0).acos();
                let [low, high] = z.map(angle);
                let steps = [phi_max, low - high].map(|a| edges(256.0, a));
                grid(steps, |u, v| {
                    let (sin_phi, cos_phi) = (u * phi_max).sin_cos();
                    let theta = low + v * (high - low);
                    // Exactly 0 at the poles.
                    let pole = theta == 0.0 || theta == PI;
                    let (sin, cos) = if pole {
                        (0.0, theta.cos())
                    } else {
                        theta.sin_cos()
                    };
                    let n = [sin * cos_phi, sin * sin_phi, cos];
                    (n.map(|x| x * radius), n)
                })
            }
            Self::Cylinder { radius, z, phi_max } => {
                let (radius, phi_max) = (f64::from(radius), f64::from(phi_max));
                let [low, high] = z.map(f64::from);
                grid([edges(512.0, phi_max), 1], |u, v| {
                    let (sin, cos) = (u * phi_max).sin_cos();
                    let height = low + v * (high - low);
                    ([radius * cos, radius * sin, height], [cos, sin, 0.0])
                })
            }
            Self::Disk {
                radius,
                inner,
                height,
                phi_max,
            } => {
                let [radius, inner, height, phi_max] =
                    [radius, inner, height, phi_max].map(f64::from);
                grid([edges(512.0, phi_max), 1], |u, v| {
                    let (sin, cos) = (u * phi_max).sin_cos();
                    let r = radius + v * (inner - radius);
                    ([r * cos, r * sin, height], [0.0, 0.0, 1.0])
                })
            }
        }
    }

    /// Its numbers and its kind, by which equal ones are found.
    pub(crate) fn key(&self) -> [u32; 5] {
        let (kind, numbers) = match *self {
            Self::Sphere { radius, z, phi_max } => (0, [radius, z[0], z[1], phi_max]),
            Self::Cylinder { radius, z, phi_max } => (1, [radius, z[0], z[1], phi_max]),
            Self::Disk {
                radius,
                inner,
                height,
                phi_max,
            } => (2, [radius, inner, height, phi_max]),
        };
        let [a, b, c, d] = numbers.map(f32::to_bits);
        [kind, a, b, c, d]
    }
}

/// The azimuth of a point about the z axis, in `[0, 2 pi]`.
fn azimuth(x: f64, y: f64) -> f64 {
    let phi = y.atan2(x);
    if phi < 0.0 { phi + TAU } else { phi }
}

/// Edges along an angle.
///
/// * `turn`: to the full turn.
fn edges(turn: f64, angle: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "angles are at most a turn"
    )]
    let steps = (turn * angle.abs() / TAU - 1e-5).ceil() as u32;
    steps.max(1)
}

/// A mesh over `[0, 1]^2` of points and normals.
fn grid([nu, nv]: [u32; 2], f: impl Fn(f64, f64) -> ([f64; 3], [f64; 3])) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..=nv {
        for i in 0..=nu {
            let (u, v) = (f64::from(i) / f64::from(nu), f64::from(j) / f64::from(nv));
            let (p, n) = f(u, v);
            mesh.positions.push(p.map(f32_of));
            mesh.normals.push(n.map(f32_of));
            mesh.uvs.push([f32_of(u), f32_of(v)]);
        }
    }
    mesh.triangles = crate::grid::triangles(&mesh.positions, [nu + 1, nv + 1]);
    mesh
}

#[cfg(test)]
mod tests {
    use glam::DMat4;

    use super::*;
    use crate::mesh::{area, clean};

    fn parts() -> [QuadricPart; 6] {
        let turn = QuadricPart::TURN;
        let z = [-0.5, 2.0];
        let sphere = |z, phi_max| QuadricPart::Sphere {
            radius: 2.0,
            z,
            phi_max,
        };
        let disk = |inner, phi_max| QuadricPart::Disk {
            radius: 2.0,
            inner,
            height: 1.0,
            phi_max,
        };
        let radius = 0.5;
        [
            sphere(z, 4.7),
            sphere([-2.0, 2.0], 3.1),
            sphere([-1.0, -0.3], 1.0),
            QuadricPart::Cylinder {
                radius,
                z,
                phi_max: turn,
            },
            disk(0.5, turn),
            disk(0.0, 1.0),
        ]
    }

    #[test]
    fn meshes_have_the_area_and_the_outside_of_the_surface() {
        for part in parts() {
            assert_eq!(part.fault(), None);
            let mut mesh = part.mesh();
            let before = mesh.clone();
            let cleaning = clean(&mut mesh).unwrap();
            assert_eq!(cleaning, Default::default(), "{part:?}");
            assert_eq!(mesh, before);
            let found = area(&mesh, &DMat4::IDENTITY);
            let error = found / part.area() - 1.0;
            assert!(error.abs() < 2e-4, "{part:?}: {error}");
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
                let n = DVec3::from(mesh.normals[t[1] as usize].map(f64::from));
                let winding = (b - a).cross(c - a).normalize();
                assert!(winding.dot(n) > 0.99, "{part:?}: {winding} {n}");
            }
        }
    }

    #[test]
    fn chords_are_as_near_as_stated() {
        let sagitta = |turn: f64| 1.0 - (PI / turn).cos();
        assert!(sagitta(256.0) < 7.6e-5 && sagitta(512.0) < 1.9e-5);
    }

    #[test]
    fn coordinates_begin_at_the_bottom() {
        let [sphere, ..] = parts();
        let mesh = sphere.mesh();
        for (uv, p) in mesh.uvs.iter().zip(&mesh.positions) {
            if uv[1] == 0.0 {
                assert!((p[2] + 0.5).abs() < 1e-6);
            }
            if uv[0] == 0.0 {
                assert!(p[0] >= 0.0 && p[1].abs() < 1e-6);
            }
        }
    }

    /// Against all vertices of the meshes, which lie on the surfaces.
    #[test]
    fn least_heights_are_those_of_the_points() {
        for part in parts() {
            let mesh = part.mesh();
            for i in 0..200 {
                let (sin, cos) = (0.731 * f64::from(i)).sin_cos();
                let w =
                    DVec3::new(cos, sin, f64::from(i % 11 - 5) * 0.4) * (1.0 + 0.01 * f64::from(i));
                let along = |p: &[f32; 3]| w.dot(DVec3::from(p.map(f64::from)));
                let found = mesh
                    .positions
                    .iter()
                    .map(along)
                    .fold(f64::INFINITY, f64::min);
                let least = part.least_along(w);
                let slack = w.length() * 2.0;
                assert!(
                    least <= found + 1e-6 * slack && least > found - 2e-4 * slack,
                    "{part:?} {w}: {least} and {found}"
                );
            }
        }
    }

    #[test]
    fn wrong_numbers_are_named() {
        let cylinder = |radius, z, phi_max| QuadricPart::Cylinder { radius, z, phi_max };
        for (part, word) in [
            (cylinder(-1.0, [0.0, 1.0], 1.0), "radius"),
            (cylinder(1.0, [1.0, 1.0], 1.0), "height"),
            (cylinder(1.0, [0.0, f32::NAN], 1.0), "height"),
            (cylinder(1.0, [0.0, 1.0], 6.3), "azimuth"),
            (
                QuadricPart::Sphere {
                    radius: 1.0,
                    z: [-2.0, 0.0],
                    phi_max: 1.0,
                },
                "outside",
            ),
            (
                QuadricPart::Disk {
                    radius: 1.0,
                    inner: 1.0,
                    height: 0.0,
                    phi_max: 1.0,
                },
                "inner",
            ),
        ] {
            let fault = part.fault().unwrap();
            assert!(fault.contains(word), "{fault}");
        }
    }
}
