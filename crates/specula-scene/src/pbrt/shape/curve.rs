//! `curve`: Bezier curves and B-splines of some width.
//!
//! pbrt-v4's `flat` curves face every ray and its `cylinder` curves shade like tubes; both become
//! tubes here, of 4 and of 12 sides, whose mean width from all around is the curve's; those of hair
//! all have 12, and their centre line's direction as tangents. Ribbons become strips. The centre line
//! is nowhere further from its chords than 1/20 of the width.

use glam::DVec3;

use super::{bounded, mesh_error};
use crate::Limits;
use crate::error::{ErrorKind, SceneError};
use crate::num::{f32_of, shorten};
use crate::pbrt::context::{Context, Entity};
use crate::scene::Mesh;
use crate::tube::{self, Bezier, Station, cubic_spline, join, tube};

/// Sides of a tube that shades like one.
const ROUND_SIDES: u32 = 12;

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
    segments: Vec<Bezier>,
    /// Width at the beginning and at the end.
    width_at_ends: [f64; 2],
    look: CurveForm,
    /// Whether its material is hair.
    is_hair: bool,
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
        is_hair: false,
    })
}

fn look(context: &mut Context, entity: &Entity, segments: usize) -> Result<CurveForm, SceneError> {
    let params = &entity.params;
    let normals = params.numbers("N", &["normal"])?;
    let kind = params.string("type")?;
    let tube = match kind {
        None | Some(("flat", _)) => 4,
        Some(("cylinder", _)) => ROUND_SIDES,
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
fn bezier(p: &[DVec3]) -> Bezier {
    match *p {
        [a, b, c] => [a, a.lerp(b, 2.0 / 3.0), c.lerp(b, 2.0 / 3.0), c],
        [a, b, c, d, ..] => [a, b, c, d],
        _ => [DVec3::ZERO; 4],
    }
}

/// A segment of a uniform B-spline of degree 2 or 3 as a cubic Bezier segment.
fn spline(p: &[DVec3]) -> Bezier {
    match *p {
        [a, b, c] => bezier(&[a.midpoint(b), b, b.midpoint(c)]),
        [a, b, c, d, ..] => cubic_spline([a, b, c, d], |a, b, u| a.lerp(b, u)),
        _ => [DVec3::ZERO; 4],
    }
}

impl Curve {
    /// The curve as a fibre of hair, whose lobe takes the offset across it from its normals: tubes are round.
    pub(in crate::pbrt) fn made_of_hair(&mut self) {
        self.is_hair = true;
        if let CurveForm::Tube(sides) = &mut self.look {
            *sides = ROUND_SIDES;
        }
    }

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
        let size = 2 * sides * (steps + self.segments.len());
        bounded((), size as u64, limits)?;
        let stations = self.stations();
        let mut mesh = Mesh::default();
        match &self.look {
            CurveForm::Tube(sides) => {
                tube(&stations, *sides, &mut mesh);
                if self.is_hair {
                    mesh.tangents = tube::tangents(&stations, *sides);
                    mesh.is_fibre = true;
                }
            }
            CurveForm::Ribbon(normals) => ribbon(&stations, normals, &mut mesh),
        }
        Ok(mesh)
    }

    /// Chords of a segment.
    fn steps(&self, control: &Bezier) -> u32 {
        tube::steps(control, self.width_at_ends[0].max(self.width_at_ends[1]))
    }

    fn stations(&self) -> Vec<Station> {
        let count = self.segments.len() as f64;
        let [first, last] = self.width_at_ends;
        // pbrt-v4's normals do not lean where the width grows.
        tube::stations(
            &self.segments,
            |segment| self.steps(&self.segments[segment]),
            |segment, u| [first + (segment as f64 + u) / count * (last - first), 0.0],
        )
    }
}

/// A strip along the stations, across their normals.
fn ribbon(stations: &[Station], normals: &[DVec3], mesh: &mut Mesh) {
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
            is_hair: false,
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
            is_hair: false,
        };
        let stations = curve.stations();
        let [a, b, c, d] = curve.segments[0];
        for pair in stations.windows(2) {
            let u = 0.5 * (pair[0].u + pair[1].u);
            let v = 1.0 - u;
            let exact =
                a * (v * v * v) + b * (3.0 * v * v * u) + c * (3.0 * v * u * u) + d * (u * u * u);
            let chord = pair[0].point.midpoint(pair[1].point);
            assert!(exact.distance(chord) <= tube::TOLERANCE * 0.1, "{u}");
        }
    }
}
