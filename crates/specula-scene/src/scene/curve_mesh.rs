//! Curves: cubic Bezier segments of some width.

use glam::DVec3;

use super::Mesh;
use super::tube::{self, Bezier, Station, join, tube};
use crate::num::f32_of;

/// Sides of a tube that shades like one.
const ROUND_SIDES: u32 = 12;

/// Sides of a tube that shades like a strip.
const FLAT_SIDES: u32 = 4;

/// Sines of angles between a ribbon's normals below which they are interpolated linearly.
const PARALLEL: f64 = 1e-6;

/// What a curve looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CurveKind {
    /// A strip that faces every ray.
    #[default]
    Flat,
    /// The same outline, with the normals of a cylinder.
    Cylinder,
    /// A strip across normals of its own, narrower where it is seen from its edge.
    Ribbon,
}

/// Curves of one kind: segments, each a cubic Bezier curve whose width grows evenly.
///
/// ```text
/// c(u) = (1 - u)^3 p0 + 3 (1 - u)^2 u p1 + 3 (1 - u) u^2 p2 + u^3 p3,   w(u) = (1 - u) w0 + u w1,   u in [0, 1]
/// ```
///
/// A ray with the unit direction `d` meets a segment where its distance from `c`, seen along the ray, has a minimum of
/// at most `w / 2`; of a ribbon with the normal `n(u)`, at most `|n . d| w / 2`. Where a transform is no similarity,
/// this holds in the curves' own space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveMesh {
    /// What they look like.
    pub kind: CurveKind,
    /// Control points of each segment.
    pub segments: Vec<[[f32; 3]; 4]>,
    /// Width at both ends of each segment.
    pub width_at_ends: Vec<[f32; 2]>,
    /// Unit normals at both ends of each segment of ribbons; else empty.
    pub normals: Vec<[[f32; 3]; 2]>,
    /// Whether they are fibres of hair, and no ribbons. Triangles of these are round tubes.
    pub is_fibre: bool,
}

impl CurveMesh {
    /// Whether a segment has a length and a width.
    pub(crate) fn has_area(&self, segment: usize) -> bool {
        let [first, others @ ..] = self.segments[segment];
        others.iter().any(|p| *p != first) && self.width_at_ends[segment].iter().any(|w| *w > 0.0)
    }

    /// How many triangles [`Self::mesh`] has at most.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        let steps = (0..self.segments.len()).map(|i| u64::from(self.steps(i)));
        2 * u64::from(self.sides()) * steps.sum::<u64>()
    }

    /// Its triangles: tubes of 4 sides, of cylinders and fibres 12, whose mean width from all around is the curve's;
    /// ribbons become strips. The centre line is nowhere further from its chords than 1/20 of the width.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let stations = self.stations();
        let mut mesh = Mesh::default();
        if self.kind == CurveKind::Ribbon {
            self.strip(&stations, &mut mesh);
            return mesh;
        }
        tube(&stations, self.sides(), &mut mesh);
        if self.is_fibre {
            mesh.tangents = tube::tangents(&stations, self.sides());
            mesh.is_fibre = true;
        }
        mesh
    }

    fn sides(&self) -> u32 {
        match self.kind {
            CurveKind::Ribbon => 1,
            CurveKind::Flat if !self.is_fibre => FLAT_SIDES,
            CurveKind::Flat | CurveKind::Cylinder => ROUND_SIDES,
        }
    }

    fn bezier(&self, segment: usize) -> Bezier {
        self.segments[segment].map(|p| DVec3::from(p.map(f64::from)))
    }

    /// Chords of a segment.
    fn steps(&self, segment: usize) -> u32 {
        let [from, to] = self.width_at_ends[segment];
        tube::steps(&self.bezier(segment), f64::from(from.max(to)))
    }

    fn stations(&self) -> Vec<Station> {
        let segments: Vec<Bezier> = (0..self.segments.len()).map(|i| self.bezier(i)).collect();
        // pbrt-v4's normals do not lean where the width grows.
        tube::stations(
            &segments,
            |segment| self.steps(segment),
            |segment, u| {
                let [from, to] = self.width_at_ends[segment].map(f64::from);
                [from + u * (to - from), 0.0]
            },
        )
    }

    /// A strip along the stations, across their normals.
    fn strip(&self, stations: &[Station], mesh: &mut Mesh) {
        for (row, station) in stations.iter().enumerate() {
            let normal = ribbon_normal(self.normals[station.segment], station.u);
            let across = normal
                .cross(station.tangent)
                .try_normalize()
                .unwrap_or_else(|| normal.any_orthonormal_vector());
            for v in [0.0, 1.0] {
                let point = station.point + across * ((v - 0.5) * station.width);
                mesh.positions.push(point.to_array().map(f32_of));
                mesh.normals.push(normal.to_array().map(f32_of));
                mesh.uvs.push([f32_of(station.u), f32_of(v)]);
            }
            join(stations, row, 1, mesh);
        }
    }
}

/// The unit normal of a ribbon at `u` of a segment: it turns evenly (Shoemake 1985, "Animating Rotation with Quaternion
/// Curves", 3.3). Between opposite ones it stays with the nearer.
///
/// * `ends`: unit.
#[must_use]
pub fn ribbon_normal(ends: [[f32; 3]; 2], u: f64) -> DVec3 {
    let [from, to] = ends.map(|n| DVec3::from(n.map(f64::from)));
    let angle = from.angle_between(to);
    let sin = angle.sin();
    let nearer = if u < 0.5 { from } else { to };
    let mixed = match sin > PARALLEL {
        true => (from * ((1.0 - u) * angle).sin() + to * (u * angle).sin()) / sin,
        false => from.lerp(to, u),
    };
    mixed.normalize_or(nearer)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DMat4;

    use super::*;
    use crate::mesh::{area, clean};

    /// Two segments along the axis x.
    fn straight(kind: CurveKind) -> CurveMesh {
        let at = |x: f32| [x, 0.0, 0.0];
        let segment = |x: f32| [0.0, 2.0, 4.0, 6.0].map(|i| at(x + i / 3.0));
        CurveMesh {
            kind,
            segments: vec![segment(0.0), segment(2.0)],
            width_at_ends: vec![[0.2; 2]; 2],
            normals: match kind {
                CurveKind::Ribbon => vec![[[0.0, 0.0, 1.0]; 2]; 2],
                CurveKind::Flat | CurveKind::Cylinder => Vec::new(),
            },
            is_fibre: false,
        }
    }

    #[test]
    fn tubes_have_the_width_of_the_curve_and_point_outwards() {
        for kind in [CurveKind::Flat, CurveKind::Cylinder] {
            let curves = straight(kind);
            let mut mesh = curves.mesh();
            assert_eq!(clean(&mut mesh).unwrap(), Default::default());
            assert_eq!(curves.triangle_count(), mesh.triangles.len() as u64);
            // A convex tube's mean width from all around is its girth over pi.
            let girth = area(&mesh, &DMat4::IDENTITY) / 4.0;
            assert!((girth / PI - 0.2).abs() < 1e-6, "{girth}");
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
                let middle = (a + b + c) / 3.0;
                let outwards = DVec3::new(0.0, middle.y, middle.z);
                assert!((b - a).cross(c - a).dot(outwards) > 0.0);
            }
        }
    }

    #[test]
    fn ribbons_lie_across_their_normals() {
        let mut mesh = straight(CurveKind::Ribbon).mesh();
        assert_eq!(clean(&mut mesh).unwrap(), Default::default());
        assert!((area(&mesh, &DMat4::IDENTITY) - 0.8).abs() < 1e-6);
        let winding = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
            (b - a).cross(c - a).z
        };
        assert!(mesh.triangles.iter().all(|t| winding(t).abs() > 0.0));
        assert!(
            mesh.positions
                .iter()
                .all(|p| p[2] == 0.0 && p[1].abs() <= 0.1 + 1e-6)
        );
    }

    #[test]
    fn normals_of_ribbons_turn_evenly() {
        let ends = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for u in [0.0, 0.2, 0.5, 1.0] {
            let (sin, cos) = (0.5 * PI * u).sin_cos();
            let expected = DVec3::new(cos, sin, 0.0);
            assert!(ribbon_normal(ends, u).distance(expected) < 1e-12);
        }
        let parallel = ribbon_normal([[0.0, 0.6, 0.8]; 2], 0.3);
        assert!(parallel.distance(DVec3::new(0.0, 0.6, 0.8)) < 1e-7);
        let opposite = ribbon_normal([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], 0.5);
        assert!(opposite.is_finite() && (opposite.length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn chords_stay_near_the_curve() {
        let p = |x: f32, y: f32| [x, y, 0.0];
        let curves = CurveMesh {
            segments: vec![[p(0.0, 0.0), p(0.0, 4.0), p(4.0, 4.0), p(4.0, 0.0)]],
            width_at_ends: vec![[0.1; 2]],
            ..CurveMesh::default()
        };
        let stations = curves.stations();
        let [a, b, c, d] = curves.bezier(0);
        for pair in stations.windows(2) {
            let u = 0.5 * (pair[0].u + pair[1].u);
            let v = 1.0 - u;
            let exact =
                a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u);
            let chord = pair[0].point.midpoint(pair[1].point);
            assert!(exact.distance(chord) <= tube::TOLERANCE * 0.1, "{u}");
        }
    }

    #[test]
    fn segments_without_length_or_width_have_no_area() {
        let mut curves = straight(CurveKind::Flat);
        curves.width_at_ends[0] = [0.0, 0.1];
        assert!(curves.has_area(0) && curves.has_area(1));
        curves.width_at_ends[0] = [0.0; 2];
        curves.segments[1] = [[1.0, 2.0, 3.0]; 4];
        assert!(!curves.has_area(0) && !curves.has_area(1));
    }
}
