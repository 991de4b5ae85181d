//! `curve`: Bezier curves and B-splines of some width.
//!
//! pbrt-v4's `flat` curves face every ray and its `cylinder` curves shade like tubes; both become
//! tubes here, of 4 and of 12 sides, whose mean width from all around is the curve's. Ribbons
//! become strips. The centre line is nowhere further from its chords than 1/20 of the width.

use glam::DVec3;

use super::{bounded, mesh_error};
use crate::Limits;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::pbrt::token::shorten;
use crate::scene::Mesh;

/// How far chords may lie from the curve, over its width.
const TOLERANCE: f64 = 0.05;

/// Most chords of one segment.
const MOST_STEPS: u32 = 64;

/// What a curve looks like.
enum CurveForm {
    /// A tube of so many sides.
    Tube(u32),
    /// A strip, its normals at the ends of the segments.
    Ribbon(Vec<DVec3>),
}

/// A curve of several segments.
pub(in crate::pbrt) struct Curve {
    /// Cubic Bezier segments.
    segments: Vec<[DVec3; 4]>,
    /// Width at the beginning and at the end.
    width_at_ends: [f64; 2],
    look: CurveForm,
}

/// Reads the shape `curve`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<Curve, SceneError> {
    let params = &entity.params;
    params.ignore(&["splitdepth"]);
    let width = params.float_from_zero("width", 1.0)?;
    let width_at_ends = [
        params.float_from_zero("width0", width)?,
        params.float_from_zero("width1", width)?,
    ];
    let points: Vec<DVec3> = match params.numbers("P", &["point3"])? {
        Some(numbers) => numbers
            .as_chunks::<3>()
            .0
            .iter()
            .map(|p| (*p).into())
            .collect(),
        None => Vec::new(),
    };
    let degree = params.integer_within("degree", 3, 2..=3)? as usize;
    let basis = params.string("basis")?;
    let (segments, expected) = match basis {
        None | Some(("bezier", _)) => {
            let whole = points.len() > degree && (points.len() - 1).is_multiple_of(degree);
            let groups = points.windows(degree + 1).step_by(degree);
            let segments: Vec<_> = if whole {
                groups.map(bezier).collect()
            } else {
                Vec::new()
            };
            (segments, format!("{} + n * {degree} points", degree + 1))
        }
        Some(("bspline", _)) => (
            points.windows(degree + 1).map(spline).collect(),
            format!("at least {} points", degree + 1),
        ),
        Some((other, place)) => {
            let message = format!(
                "expected basis \"bezier\" or \"bspline\", found \"{}\"",
                shorten(other)
            );
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
    };
    if segments.is_empty() {
        let found = points.len();
        let message = format!("\"P\": a curve of degree {degree} needs {expected}, found {found}");
        return Err(mesh_error(entity, "P", message));
    }
    let look = look(context, entity, segments.len())?;
    Ok(Curve {
        segments,
        width_at_ends,
        look,
    })
}

fn look(context: &mut Context, entity: &Entity, segments: usize) -> Result<CurveForm, SceneError> {
    let params = &entity.params;
    let normals = params.numbers("N", &["normal"])?;
    let kind = params.string("type")?;
    let tube = match kind {
        None | Some(("flat", _)) => 4,
        Some(("cylinder", _)) => 12,
        Some(("ribbon", _)) => {
            let normals: Vec<DVec3> = normals
                .unwrap_or_default()
                .as_chunks::<3>()
                .0
                .iter()
                .map(|n| (*n).into())
                .collect();
            if normals.len() != segments + 1 {
                let message = format!(
                    "\"N\": a ribbon of {segments} segments needs {} normals, found {}",
                    segments + 1,
                    normals.len()
                );
                return Err(mesh_error(entity, "N", message));
            }
            return Ok(CurveForm::Ribbon(normals));
        }
        Some((other, place)) => {
            let message = format!(
                "expected type \"flat\", \"cylinder\" or \"ribbon\", found \"{}\"",
                shorten(other)
            );
            return Err(SceneError::new(ErrorKind::Parameter, place, message));
        }
    };
    if normals.is_some() {
        let message = "\"N\" has a meaning for curves of type \"ribbon\" alone";
        context.warn(&params.place_of("N"), message);
    }
    Ok(CurveForm::Tube(tube))
}

/// A Bezier segment of degree 2 or 3 as a cubic one.
fn bezier(p: &[DVec3]) -> [DVec3; 4] {
    match *p {
        [a, b, c] => [a, a.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c],
        [a, b, c, d, ..] => [a, b, c, d],
        _ => [DVec3::ZERO; 4],
    }
}

/// A segment of a uniform B-spline of degree 2 or 3 as a cubic Bezier segment.
fn spline(p: &[DVec3]) -> [DVec3; 4] {
    match *p {
        [a, b, c] => bezier(&[a.midpoint(b), b, b.midpoint(c)]),
        [a, b, c, d, ..] => {
            let (bc, cb) = (b.lerp(c, 1.0 / 3.0), c.lerp(b, 1.0 / 3.0));
            let (ba, cd) = (b.lerp(a, 1.0 / 3.0), c.lerp(d, 1.0 / 3.0));
            [ba.midpoint(bc), bc, cb, cb.midpoint(cd)]
        }
        _ => [DVec3::ZERO; 4],
    }
}

/// A point of the centre line.
struct CurvePoint {
    point: DVec3,
    tangent: DVec3,
    width: f64,
    /// Along the segment it belongs to.
    u: f64,
    /// Number of the segment.
    segment: usize,
}

impl Curve {
    /// Shapes that pbrt-v4 makes of it without splitting.
    pub(super) fn pieces(&self) -> usize {
        self.segments.len()
    }

    pub(super) fn build(self, limits: &Limits) -> Result<Mesh, String> {
        let sides = match self.look {
            CurveForm::Tube(sides) => sides as usize,
            CurveForm::Ribbon(_) => 1,
        };
        let steps: usize = self.segments.iter().map(|s| self.steps(s) as usize).sum();
        bounded((), 2 * sides * (steps + self.segments.len()), limits)?;
        let stations = self.stations();
        let mut mesh = Mesh::default();
        match &self.look {
            CurveForm::Tube(sides) => tube(&stations, *sides, &mut mesh),
            CurveForm::Ribbon(normals) => ribbon(&stations, normals, &mut mesh),
        }
        Ok(mesh)
    }

    /// Chords of a segment: `|p - chord| <= max|p''| / (8 n^2)`, `max|p''| <= 6 max|second difference|`.
    fn steps(&self, [a, b, c, d]: &[DVec3; 4]) -> u32 {
        let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        let width = self.width_at_ends[0].max(self.width_at_ends[1]).max(1e-30);
        let steps = (6.0 * bend / (8.0 * TOLERANCE * width)).sqrt().ceil();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to small numbers"
        )]
        let steps = steps.clamp(1.0, f64::from(MOST_STEPS)) as u32;
        steps
    }

    fn stations(&self) -> Vec<CurvePoint> {
        let count = self.segments.len() as f64;
        let mut stations: Vec<CurvePoint> = Vec::new();
        let mut last = DVec3::X;
        for (segment, control) in self.segments.iter().enumerate() {
            let [a, b, c, d] = *control;
            let n = self.steps(control);
            for i in 0..=n {
                let u = f64::from(i) / f64::from(n);
                let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
                let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
                // Where control points coincide the chord has the direction.
                let tangent = (bcd - abc)
                    .try_normalize()
                    .or_else(|| (d - a).try_normalize())
                    .unwrap_or(last);
                last = tangent;
                let along = (segment as f64 + u) / count;
                stations.push(CurvePoint {
                    point: abc.lerp(bcd, u),
                    tangent,
                    width: self.width_at_ends[0]
                        + along * (self.width_at_ends[1] - self.width_at_ends[0]),
                    u,
                    segment,
                });
            }
        }
        stations
    }
}

/// A tube around the stations; its frame turns no more than it must (Wang et al. 2008 by projection).
fn tube(stations: &[CurvePoint], sides: u32, mesh: &mut Mesh) {
    use std::f64::consts::PI;
    // A polygon of n sides and circumradius R has the mean width 2 n R sin(pi / n) / pi.
    let n = f64::from(sides);
    let fit = PI / (n * (PI / n).sin());
    let Some(first) = stations.first() else {
        return;
    };
    let mut across = first.tangent.any_orthonormal_vector();
    for (row, station) in stations.iter().enumerate() {
        let t = station.tangent;
        across = (across - t * t.dot(across))
            .try_normalize()
            .unwrap_or_else(|| t.any_orthonormal_vector());
        let up = t.cross(across);
        for side in 0..=sides {
            let share = f64::from(side) / n;
            let (sin, cos) = (2.0 * PI * share).sin_cos();
            let normal = across * cos + up * sin;
            let point = station.point + normal * (0.5 * station.width * fit);
            mesh.positions.push(point.to_array().map(f32_of));
            mesh.normals.push(normal.to_array().map(f32_of));
            mesh.uvs.push([f32_of(station.u), f32_of(share)]);
        }
        join(stations, row, sides, mesh);
    }
}

/// A strip along the stations, across their normals.
fn ribbon(stations: &[CurvePoint], normals: &[DVec3], mesh: &mut Mesh) {
    for (row, station) in stations.iter().enumerate() {
        let (from, to) = (normals[station.segment], normals[station.segment + 1]);
        let normal = from.lerp(to, station.u).normalize_or(DVec3::Z);
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

/// Triangles between a row of `columns + 1` vertices and the one before, where both belong to one
/// segment.
fn join(stations: &[CurvePoint], row: usize, columns: u32, mesh: &mut Mesh) {
    if row == 0 || stations[row].segment != stations[row - 1].segment {
        return;
    }
    // Within the limit of vertices, which fits 32 bits.
    let Ok(row) = u32::try_from(row) else { return };
    let width = columns + 1;
    for i in 0..columns {
        let a = (row - 1) * width + i;
        let (b, c, d) = (a + 1, a + width, a + width + 1);
        for triangle in [[a, b, d], [a, d, c]] {
            let [p, q, r] = triangle.map(|i| mesh.positions[i as usize]);
            // Where the width is 0 a side has no length.
            if p != q && q != r && r != p {
                mesh.triangles.push(triangle);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::DMat4;

    use super::*;
    use crate::mesh::{area, clean};

    fn straight(look: CurveForm) -> Curve {
        let at = |x: f64| DVec3::new(x, 0.0, 0.0);
        Curve {
            segments: vec![
                bezier(&[at(0.0), at(1.0), at(2.0)]),
                bezier(&[at(2.0), at(3.0), at(4.0)]),
            ],
            width_at_ends: [0.2, 0.2],
            look,
        }
    }

    #[test]
    fn tubes_have_the_width_of_the_curve_and_point_outwards() {
        for sides in [4, 12] {
            let mut mesh = straight(CurveForm::Tube(sides))
                .build(&Limits::default())
                .unwrap();
            assert_eq!(clean(&mut mesh).unwrap(), Default::default());
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
        let mut mesh = straight(CurveForm::Ribbon(vec![DVec3::Z; 3]))
            .build(&Limits::default())
            .unwrap();
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
    fn splines_become_the_bezier_segments_of_the_same_curve() {
        let points = [0.0, 1.0, 3.0, 2.0].map(|x| DVec3::new(x, x * x, 0.0));
        // De Boor: the ends of a uniform cubic segment are (1, 4, 1)/6.
        let [start, .., end] = spline(&points);
        assert!(start.distance((points[0] + 4.0 * points[1] + points[2]) / 6.0) < 1e-12);
        assert!(end.distance((points[1] + 4.0 * points[2] + points[3]) / 6.0) < 1e-12);
        let [start, .., end] = spline(&points[..3]);
        assert!(start.distance(points[0].midpoint(points[1])) < 1e-12);
        assert!(end.distance(points[1].midpoint(points[2])) < 1e-12);
    }

    #[test]
    fn chords_stay_near_the_curve() {
        let p = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let curve = Curve {
            segments: vec![[p(0.0, 0.0), p(0.0, 4.0), p(4.0, 4.0), p(4.0, 0.0)]],
            width_at_ends: [0.1, 0.1],
            look: CurveForm::Tube(4),
        };
        let stations = curve.stations();
        let [a, b, c, d] = curve.segments[0];
        for pair in stations.windows(2) {
            let u = 0.5 * (pair[0].u + pair[1].u);
            let v = 1.0 - u;
            let exact =
                a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u);
            let chord = pair[0].point.midpoint(pair[1].point);
            assert!(exact.distance(chord) <= TOLERANCE * 0.1, "{u}");
        }
    }
}
