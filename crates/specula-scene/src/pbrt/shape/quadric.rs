//! `sphere`, `disk` and `cylinder`, and the meshes of their parts.
//!
//! Whole spheres and disks are shapes of the model. Parts and cylinders become triangles, 256 to
//! the full turn: the surface is nowhere further than 7.6e-5 radii from its chords.

use std::f64::consts::PI;

use super::grid;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::pbrt::context::Entity;
use crate::scene::Mesh;

/// Triangles' edges to the full turn.
pub(super) const TURN: f64 = 256.0;

/// A quadric as pbrt-v4 describes it, its bounds in order and within its reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::pbrt) enum Quadric {
    Sphere {
        radius: f64,
        z: [f64; 2],
        phi_max: f64,
    },
    Disk {
        radius: f64,
        height: f64,
        inner: f64,
        phi_max: f64,
    },
    Cylinder {
        radius: f64,
        z: [f64; 2],
        phi_max: f64,
    },
}

impl Quadric {
    /// Reads a shape, and whether it is whole.
    pub(super) fn read(entity: &Entity) -> Result<(Self, bool), SceneError> {
        let params = &entity.params;
        let radius = params.float_above("radius", 1.0, 0.0)?;
        let phi_deg = params.float_above("phimax", 360.0, 0.0)?.min(360.0);
        let phi_max = phi_deg.to_radians();
        let turn = phi_deg >= 360.0;
        if entity.name == "disk" {
            let height = params.float("height", 0.0)?;
            let inner = params.float_from_zero("innerradius", 0.0)?;
            if inner >= radius {
                let message = format!(
                    "\"innerradius\": expected less than the radius {radius}, found {inner}"
                );
                let place = params.place_of("innerradius");
                return Err(SceneError::new(ErrorKind::Parameter, &place, message));
            }
            let disk = Self::Disk {
                radius,
                height,
                inner,
                phi_max,
            };
            return Ok((disk, turn && inner == 0.0));
        }
        let sphere = entity.name == "sphere";
        let reach = if sphere { radius } else { f64::INFINITY };
        let default = if sphere { radius } else { 1.0 };
        let a = params.float("zmin", -default)?.clamp(-reach, reach);
        let b = params.float("zmax", default)?.clamp(-reach, reach);
        let z = [a.min(b), a.max(b)];
        if z[0] == z[1] {
            let message = "expected \"zmin\" below \"zmax\"";
            return Err(SceneError::new(
                ErrorKind::Parameter,
                &entity.place,
                message,
            ));
        }
        if sphere {
            let whole = turn && z == [-radius, radius];
            return Ok((Self::Sphere { radius, z, phi_max }, whole));
        }
        Ok((Self::Cylinder { radius, z, phi_max }, false))
    }

    /// Shapes of the same key have the same mesh.
    pub(super) fn key(&self) -> [u64; 5] {
        let numbers = match *self {
            Self::Sphere { radius, z, phi_max } => [0.0, radius, z[0], z[1], phi_max],
            Self::Cylinder { radius, z, phi_max } => [1.0, radius, z[0], z[1], phi_max],
            Self::Disk {
                radius,
                height,
                inner,
                phi_max,
            } => [2.0 + phi_max, radius, height, inner, phi_max],
        };
        numbers.map(f64::to_bits)
    }

    /// Area of the exact surface.
    pub(super) fn area(&self) -> f64 {
        match *self {
            Self::Sphere { radius, z, phi_max } | Self::Cylinder { radius, z, phi_max } => {
                phi_max * radius * (z[1] - z[0])
            }
            Self::Disk {
                radius,
                inner,
                phi_max,
                ..
            } => phi_max * 0.5 * (radius * radius - inner * inner),
        }
    }

    /// Its triangles, with pbrt-v4's coordinates.
    pub(super) fn build(&self) -> Mesh {
        match *self {
            Self::Sphere { radius, z, phi_max } => {
                let angle = |z: f64| (z / radius).clamp(-1.0, 1.0).acos();
                let [low, high] = z.map(angle);
                grid([phi_max, low - high], |u, v| {
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
            Self::Cylinder { radius, z, phi_max } => grid([phi_max, 0.0], |u, v| {
                let (sin, cos) = (u * phi_max).sin_cos();
                let height = z[0] + v * (z[1] - z[0]);
                ([radius * cos, radius * sin, height], [cos, sin, 0.0])
            }),
            Self::Disk {
                radius,
                height,
                inner,
                phi_max,
            } => grid([phi_max, 0.0], |u, v| {
                let (sin, cos) = (u * phi_max).sin_cos();
                let r = radius + v * (inner - radius);
                ([r * cos, r * sin, height], [0.0, 0.0, 1.0])
            }),
        }
    }
}

/// A mesh over `[0, 1]^2` of points and normals.
///
/// * `angles`: how far the surface turns along u and v; 0 where it is straight.
fn grid(angles: [f64; 2], f: impl Fn(f64, f64) -> ([f64; 3], [f64; 3])) -> Mesh {
    let steps = angles.map(|a| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "angles are at most a turn"
        )]
        let steps = (TURN * a.abs() / (2.0 * PI) - 1e-9).ceil() as u32;
        steps.max(1)
    });
    let [nu, nv] = steps;
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
    grid::add_triangles(&mut mesh, [nu + 1, nv + 1]);
    mesh
}

#[cfg(test)]
mod tests {
    use glam::{DMat4, DVec3};

    use super::*;
    use crate::mesh::{area, clean};

    fn quadrics() -> [Quadric; 5] {
        let z = [-0.5, 2.0];
        [
            Quadric::Sphere {
                radius: 2.0,
                z,
                phi_max: 1.5 * PI,
            },
            Quadric::Sphere {
                radius: 2.0,
                z: [-2.0, 2.0],
                phi_max: PI,
            },
            Quadric::Cylinder {
                radius: 0.5,
                z,
                phi_max: 2.0 * PI,
            },
            Quadric::Disk {
                radius: 2.0,
                height: 1.0,
                inner: 0.5,
                phi_max: 2.0 * PI,
            },
            Quadric::Disk {
                radius: 2.0,
                height: 1.0,
                inner: 0.0,
                phi_max: 1.0,
            },
        ]
    }

    #[test]
    fn meshes_have_the_area_and_the_outside_of_the_surface() {
        for quadric in quadrics() {
            let mut mesh = quadric.build();
            let before = mesh.clone();
            let cleaning = clean(&mut mesh).unwrap();
            assert_eq!(cleaning, Default::default(), "{quadric:?}");
            assert_eq!(mesh, before);
            let found = area(&mesh, &DMat4::IDENTITY);
            let error = found / quadric.area() - 1.0;
            assert!(error.abs() < 2e-4, "{quadric:?}: {error}");
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
                let n = DVec3::from(mesh.normals[t[1] as usize].map(f64::from));
                let winding = (b - a).cross(c - a).normalize();
                assert!(winding.dot(n) > 0.99, "{quadric:?}: {winding} {n}");
            }
        }
    }

    #[test]
    fn chords_are_as_near_as_stated() {
        let sagitta = 1.0 - (PI / TURN).cos();
        assert!(sagitta < 7.6e-5, "{sagitta}");
    }

    #[test]
    fn coordinates_begin_at_the_bottom() {
        let [sphere, ..] = quadrics();
        let mesh = sphere.build();
        let lowest = mesh.uvs.iter().zip(&mesh.positions);
        for (uv, p) in lowest {
            if uv[1] == 0.0 {
                assert!((p[2] + 0.5).abs() < 1e-6);
            }
            if uv[0] == 0.0 {
                assert!(p[0] >= 0.0 && p[1].abs() < 1e-6);
            }
        }
    }
}
