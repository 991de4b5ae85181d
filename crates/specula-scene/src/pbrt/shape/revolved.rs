//! pbrt-v3's `cone`, `paraboloid` and `hyperboloid`: a profile turned about z, as triangles.
//!
//! A cone has 256 edges to the full turn: the surface is within 7.6e-5 radii of its triangles. The others have twice as
//! many, for their profiles are not straight: a quarter of that for the turn leaves the rest for the profile.

use std::f64::consts::PI;

use glam::DVec3;

use crate::error::{ErrorKind, SceneError};
use crate::grid;
use crate::num::f32_of;
use crate::pbrt::context::Entity;
use crate::scene::Mesh;

/// Edges to the full turn of a cone.
const TURN: f64 = 256.0;

/// How far the surface may be from its triangles, in radii: half the angle of an edge, squared and halved.
const TOLERANCE: f64 = PI * PI / (2.0 * TURN * TURN);

/// What of it is left for profiles.
const OF_PROFILE: f64 = 0.7 * TOLERANCE;

/// Most edges along a profile.
const MOST_STEPS: f64 = 1024.0;

/// A shape as pbrt-v3 describes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::pbrt) struct Revolved {
    profile: Profile,
    phi_max: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Profile {
    /// From the base at z = 0 to the tip.
    Cone { radius: f64, height: f64 },
    /// `z = zmax r^2 / radius^2` between two heights.
    Paraboloid {
        radius: f64,
        z_max: f64,
        z: [f64; 2],
    },
    /// The segment between two points.
    Hyperboloid { ends: [DVec3; 2] },
}

/// A point of a profile at the azimuth 0, with the coordinate v and the normal there.
struct ProfilePoint {
    v: f64,
    position: DVec3,
    normal: DVec3,
}

impl Revolved {
    /// Reads a shape.
    pub(super) fn read(entity: &Entity) -> Result<Self, SceneError> {
        let params = &entity.params;
        let phi_deg = params.float_above("phimax", 360.0, 0.0)?.min(360.0);
        let wrong = |message: &str| SceneError::new(ErrorKind::Parameter, &entity.place, message);
        let profile = match entity.name.as_str() {
            "cone" => Profile::Cone {
                radius: params.float_above("radius", 1.0, 0.0)?,
                height: params.float_above("height", 1.0, 0.0)?,
            },
            "paraboloid" => {
                let radius = params.float_above("radius", 1.0, 0.0)?;
                let (a, b) = (params.float("zmin", 0.0)?, params.float("zmax", 1.0)?);
                let z = [a.min(b).max(0.0), a.max(b)];
                if z[0] >= z[1] {
                    return Err(wrong("expected \"zmin\" below \"zmax\", and that above 0"));
                }
                Profile::Paraboloid {
                    radius,
                    z_max: z[1],
                    z,
                }
            }
            _ => {
                let point = |name: &str, default: DVec3| {
                    let read = params.array(name, &["point3"])?;
                    Ok::<_, SceneError>(read.map_or(default, DVec3::from))
                };
                let ends = [point("p1", DVec3::ZERO)?, point("p2", DVec3::ONE)?];
                let [p1, p2] = ends;
                if p1 == p2 || p1.truncate().length().max(p2.truncate().length()) == 0.0 {
                    return Err(wrong(
                        "expected \"p1\" and \"p2\" apart, and not both on the axis",
                    ));
                }
                // As pbrt-v3 does.
                let ends = if p2.z == 0.0 { [p2, p1] } else { ends };
                Profile::Hyperboloid { ends }
            }
        };
        Ok(Self {
            profile,
            phi_max: phi_deg.to_radians(),
        })
    }

    /// Its triangles, with pbrt-v3's coordinates.
    pub(super) fn build(&self) -> Mesh {
        let points = self.profile.points();
        let steps = count(self.profile.turn() * self.phi_max / (2.0 * PI) - 1e-9);
        let mut mesh = Mesh::default();
        for point in &points {
            for i in 0..=steps {
                let u = f64::from(i) / f64::from(steps);
                let (sin, cos) = (u * self.phi_max).sin_cos();
                let turned = |p: DVec3| [cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z];
                mesh.positions.push(turned(point.position).map(f32_of));
                mesh.normals.push(turned(point.normal).map(f32_of));
                mesh.uvs.push([f32_of(u), f32_of(point.v)]);
            }
        }
        let rows = u32::try_from(points.len()).unwrap_or(1);
        mesh.triangles = grid::triangles(&mesh.positions, [steps + 1, rows]);
        mesh
    }
}

impl Profile {
    fn points(&self) -> Vec<ProfilePoint> {
        let steps = self.steps();
        let share = |i: u32| f64::from(i) / f64::from(steps);
        (0..=steps).map(|i| self.point(share(i))).collect()
    }

    /// Edges to the full turn.
    fn turn(&self) -> f64 {
        match self {
            Self::Cone { .. } => TURN,
            Self::Paraboloid { .. } | Self::Hyperboloid { .. } => 2.0 * TURN,
        }
    }

    /// Edges along it.
    fn steps(&self) -> u32 {
        match *self {
            // Straight, and between two of them lies a plane.
            Self::Cone { .. } => 1,
            Self::Paraboloid { radius, z_max, z } => {
                // A chord over dr is off by dr^2 z_max / (4 radius^2) in height.
                let across = radius * (1.0 - (z[0] / z_max).sqrt());
                let step = radius * (4.0 * OF_PROFILE * radius / z_max).sqrt();
                count(across / step)
            }
            Self::Hyperboloid { ends: [p1, p2] } => {
                // Between two straight lines that are skew: a quarter of the twist of the four corners.
                let twist = (2.0 * PI / self.turn()) * (p2 - p1).truncate().length();
                let radius = p1.truncate().length().max(p2.truncate().length());
                count(twist / (4.0 * OF_PROFILE * radius))
            }
        }
    }

    /// * `share`: of the way; along v, but of a paraboloid along the radius.
    fn point(&self, share: f64) -> ProfilePoint {
        match *self {
            Self::Cone { radius, height } => ProfilePoint {
                v: share,
                position: DVec3::new(radius * (1.0 - share), 0.0, height * share),
                normal: DVec3::new(height, 0.0, radius).normalize(),
            },
            Self::Paraboloid { radius, z_max, z } => {
                let ratio = (z[0] / z_max).sqrt();
                let r = radius * (ratio + share * (1.0 - ratio));
                let slope = 2.0 * z_max * r / (radius * radius);
                let height = (z_max * r * r / (radius * radius)).clamp(z[0], z[1]);
                ProfilePoint {
                    v: (height - z[0]) / (z[1] - z[0]),
                    position: DVec3::new(r, 0.0, height),
                    normal: DVec3::new(slope, 0.0, -1.0).normalize(),
                }
            }
            Self::Hyperboloid { ends: [p1, p2] } => {
                let along = p2 - p1;
                let normal_at = |p: DVec3| DVec3::new(-p.y, p.x, 0.0).cross(along);
                let position = p1 + along * share;
                // On the axis, where the surface has a tip, that of a point beside it.
                let beside = p1 + along * (0.5 + (share - 0.5) * (1.0 - 1e-6));
                let normal = [position, beside].map(normal_at);
                let normal = if normal[0].length() > 1e-9 * normal[1].length() {
                    normal[0]
                } else {
                    normal[1]
                };
                ProfilePoint {
                    v: share,
                    position,
                    normal: normal.normalize_or(DVec3::Z),
                }
            }
        }
    }
}

fn count(steps: f64) -> u32 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped first"
    )]
    let steps = steps.ceil().clamp(1.0, MOST_STEPS) as u32;
    steps
}

#[cfg(test)]
mod tests {
    use glam::DMat4;

    use super::*;
    use crate::mesh::{area, clean};

    fn shapes() -> [(Revolved, f64); 5] {
        let cone = Profile::Cone {
            radius: 0.7,
            height: 2.0,
        };
        let paraboloid = |z: [f64; 2]| Profile::Paraboloid {
            radius: 1.5,
            z_max: z[1],
            z,
        };
        // Of z = k r^2, per radian: ((1 + 4 k^2 r^2)^(3/2)) / (12 k^2) between its ends.
        let of_paraboloid = |[low, high]: [f64; 2]| {
            let k = high / (1.5 * 1.5);
            let upto = |z: f64| (1.0 + 4.0 * k * z).powf(1.5) / (12.0 * k * k);
            upto(high) - upto(low)
        };
        let waist = Profile::Hyperboloid {
            ends: [DVec3::new(1.0, -0.8, -1.0), DVec3::new(0.9, 1.0, 1.5)],
        };
        let of_waist = {
            let n = 10_000;
            let Profile::Hyperboloid { ends: [p1, p2] } = waist else {
                panic!()
            };
            let at = |i: i32| p1 + (p2 - p1) * ((f64::from(i) + 0.5) / f64::from(n));
            let element = |p: DVec3| DVec3::new(-p.y, p.x, 0.0).cross(p2 - p1).length();
            (0..n).map(|i| element(at(i))).sum::<f64>() / f64::from(n)
        };
        let tip = Profile::Hyperboloid {
            ends: [DVec3::ZERO, DVec3::ONE],
        };
        // A cone of radius sqrt 2 and height 1.
        let of_tip = 0.5 * 2.0_f64.sqrt() * 3.0_f64.sqrt();
        let made = |profile, phi_max, per_radian: f64| {
            (Revolved { profile, phi_max }, per_radian * phi_max)
        };
        [
            made(cone, 2.0 * PI, 0.5 * 0.7 * 2.0_f64.hypot(0.7)),
            made(paraboloid([0.0, 3.0]), 1.5 * PI, of_paraboloid([0.0, 3.0])),
            made(paraboloid([0.5, 2.0]), PI, of_paraboloid([0.5, 2.0])),
            made(waist, 2.0 * PI, of_waist),
            made(tip, 2.0 * PI, of_tip),
        ]
    }

    #[test]
    fn meshes_have_the_area_and_the_outside_of_the_surface() {
        for (shape, expected) in shapes() {
            let mut mesh = shape.build();
            let before = mesh.clone();
            assert_eq!(clean(&mut mesh).unwrap(), Default::default(), "{shape:?}");
            assert_eq!(mesh, before);
            let found = area(&mesh, &DMat4::IDENTITY);
            assert!(
                (found / expected - 1.0).abs() < 2e-4,
                "{shape:?}: {found} and {expected}"
            );
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
                let n = DVec3::from(mesh.normals[t[1] as usize].map(f64::from));
                let winding = (b - a).cross(c - a).normalize();
                assert!(winding.dot(n) > 0.98, "{shape:?}: {winding} {n}");
            }
        }
    }

    /// Points within triangles, by the implicit function of the surface over its slope.
    #[test]
    fn triangles_are_as_near_as_stated() {
        for (shape, _) in shapes() {
            // Distance from the surface, to first order, of a point at a radius and a height.
            let off = |r: f64, z: f64| match shape.profile {
                Profile::Cone { radius, height } => {
                    (r / radius - (1.0 - z / height)) / radius.recip().hypot(height.recip())
                }
                Profile::Paraboloid { radius, z_max, .. } => {
                    let k = z_max / (radius * radius);
                    (z - k * r * r) / 1.0_f64.hypot(2.0 * k * r)
                }
                Profile::Hyperboloid { ends: [p1, p2] } => {
                    let along = (p2 - p1) / (p2.z - p1.z);
                    let at = (p1 + along * (z - p1.z)).truncate();
                    let slope = at.dot(along.truncate()) / at.length();
                    (r - at.length()) / 1.0_f64.hypot(slope)
                }
            };
            let mesh = shape.build();
            let radius = |p: &[f32; 3]| f64::from(p[0]).hypot(f64::from(p[1]));
            let widest = mesh.positions.iter().map(radius).fold(0.0, f64::max);
            for t in &mesh.triangles {
                let corners = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
                for [a, b] in [[0.33, 0.33], [0.5, 0.5], [0.5, 0.0], [0.0, 0.5]] {
                    let p = corners[0] * (1.0 - a - b) + corners[1] * a + corners[2] * b;
                    let distance = off(p.truncate().length(), p.z).abs();
                    assert!(
                        distance < 1.001 * TOLERANCE * widest,
                        "{shape:?}: {distance} at {p}"
                    );
                }
            }
        }
    }
}
