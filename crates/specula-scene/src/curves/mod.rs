//! Files of Mitsuba's `bsplinecurve` and `linearcurve`: a line of text with `x y z radius` for each control point, and
//! an empty line between curves.
//!
//! Both become meshes of 12 sides whose mean width from all around is the curve's. A uniform cubic B-spline is a tube
//! that is open at its ends; its radius is such a spline too. Straight segments are cones that touch the balls around
//! their two control points, and those balls.
//!
//! Transforms move control points and leave radii as they are, so that a mesh is built where it lies.
//!
//! In a check a line with a mistake does not end the reading, but no mesh comes of it.

use std::f64::consts::PI;
use std::path::Path;

use glam::{DMat4, DVec3};

use crate::Limits;
use crate::faults::{Fault, Faults};
use crate::num::{f32_of, parsed_f32, shortened};
use crate::read_file::Files;
use crate::scene::Mesh;
use crate::scene::tube::{self, Bezier, circumradius, cubic_spline, join_rows};

/// Sides of tubes, cones and balls.
const SIDES: u32 = 12;

/// Rows of triangles of a ball.
const BALL_ROWS: u32 = 6;

/// How control points make a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum CurveBasis {
    /// `bsplinecurve`: four points or more.
    Spline,
    /// `linearcurve`: two points or more.
    Linear,
}

/// A control point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ControlPoint {
    point: DVec3,
    radius: f64,
}

impl CurveBasis {
    /// Fewest control points of a curve.
    fn fewest(self) -> usize {
        match self {
            Self::Spline => 4,
            Self::Linear => 2,
        }
    }
}

/// Reads the curves of a file as one mesh.
///
/// * `to_world`: moves its control points.
/// * `is_hair`: whether B-splines are fibres of hair.
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// What is wrong with the file.
pub(crate) fn read(
    path: &Path,
    basis: CurveBasis,
    to_world: &DMat4,
    is_hair: bool,
    files: &Files,
    collects: bool,
) -> Result<Mesh, Vec<Fault>> {
    let bytes = files.unpacked(path).map_err(|m| vec![m.into()])?;
    let mut faults = Faults::new(collects);
    let read = parse(&bytes, basis, files.limits(), &mut faults).and_then(|mut curves| {
        for control in curves.iter_mut().flatten() {
            control.point = to_world.transform_point3(control.point);
        }
        match faults.is_empty() {
            true => mesh(&curves, basis, is_hair, files.limits()),
            false => Ok(Mesh::default()),
        }
    });
    faults.end(read)
}

/// The control points of each curve.
fn parse(
    bytes: &[u8],
    basis: CurveBasis,
    limits: &Limits,
    faults: &mut Faults,
) -> Result<Vec<Vec<ControlPoint>>, Fault> {
    let mut curves: Vec<Vec<ControlPoint>> = Vec::new();
    let mut points = 0;
    let mut is_new = true;
    let mut last_line = 0;
    for (number, line) in bytes.split(|b| *b == b'\n').enumerate() {
        let line = line.trim_ascii();
        if line.is_empty() {
            if !is_new {
                check_length(&curves, basis, last_line, faults)?;
            }
            is_new = true;
            continue;
        }
        if is_new {
            curves.push(Vec::new());
            is_new = false;
        }
        last_line = number + 1;
        points += 1;
        if points > limits.max_vertices {
            let message = format!("more than {} control points", limits.max_vertices);
            return Err(Fault::at_line(last_line, message));
        }
        let point = control_point(line).or_else(|message| {
            faults.record(Fault::at_line(last_line, message))?;
            let (point, radius) = (DVec3::ZERO, 0.0);
            Ok::<_, Fault>(ControlPoint { point, radius })
        })?;
        if let Some(curve) = curves.last_mut() {
            curve.push(point);
        }
    }
    if !is_new {
        check_length(&curves, basis, last_line, faults)?;
    }
    if curves.is_empty() {
        faults.record("expected lines `x y z radius`, found none")?;
    }
    Ok(curves)
}

/// Whether the last curve has points enough.
fn check_length(
    curves: &[Vec<ControlPoint>],
    basis: CurveBasis,
    line: usize,
    faults: &mut Faults,
) -> Result<(), Fault> {
    let (found, fewest) = (curves.last().map_or(0, Vec::len), basis.fewest());
    if found >= fewest {
        return Ok(());
    }
    let message = format!("a curve needs at least {fewest} control points, found {found}");
    faults.record(Fault::at_line(line, message))
}

/// `x y z radius`.
fn control_point(line: &[u8]) -> Result<ControlPoint, String> {
    let mut numbers = [0.0; 4];
    let mut found = 0;
    for word in line.split(u8::is_ascii_whitespace) {
        if word.is_empty() {
            continue;
        }
        // Mitsuba takes no notice of what follows.
        let Some(slot) = numbers.get_mut(found) else {
            break;
        };
        let number = parsed_f32(word)
            .filter(|x| x.is_finite())
            .ok_or_else(|| format!("expected a finite number, found `{}`", shortened(word)))?;
        *slot = f64::from(number);
        found += 1;
    }
    let [x, y, z, radius] = numbers;
    if found < 4 {
        return Err(format!(
            "expected the four numbers `x y z radius`, found {found}"
        ));
    }
    if radius < 0.0 {
        return Err(format!("expected a radius of at least 0, found {radius}"));
    }
    let point = DVec3::new(x, y, z);
    Ok(ControlPoint { point, radius })
}

fn mesh(
    curves: &[Vec<ControlPoint>],
    basis: CurveBasis,
    is_hair: bool,
    limits: &Limits,
) -> Result<Mesh, Fault> {
    let mut mesh = Mesh {
        is_fibre: is_hair && basis == CurveBasis::Spline,
        ..Mesh::default()
    };
    let pieces: usize = curves.iter().map(|c| c.len() + 1 - basis.fewest()).sum();
    let mut piece = 0;
    for curve in curves {
        let along = |at: f64| f32_of((piece as f64 + at) / pieces as f64);
        match basis {
            CurveBasis::Spline => spline(curve, along, limits, &mut mesh)?,
            CurveBasis::Linear => {
                let rows = curve.len() * (BALL_ROWS as usize + 1) + 2 * (curve.len() - 1);
                bounded(&mesh, rows, limits)?;
                polyline(curve, along, &mut mesh);
            }
        }
        piece += curve.len() + 1 - basis.fewest();
    }
    Ok(mesh)
}

/// An error where a mesh with so many more rows of vertices would have too many.
fn bounded(mesh: &Mesh, rows: usize, limits: &Limits) -> Result<(), Fault> {
    let found = mesh.positions.len() as u64 + rows as u64 * (u64::from(SIDES) + 1);
    let most = limits.max_vertices;
    match found <= most {
        true => Ok(()),
        false => Err(Fault::from(format!(
            "its mesh would have {found} vertices and more; at most {most} are made (`max_vertices`)"
        ))),
    }
}

/// A tube around a B-spline.
///
/// * `along`: `v` of a place along the curve, in segments.
fn spline(
    curve: &[ControlPoint],
    along: impl Fn(f64) -> f32,
    limits: &Limits,
    mesh: &mut Mesh,
) -> Result<(), Fault> {
    let segments: Vec<Bezier> = curve
        .windows(4)
        .map(|p| cubic_spline([0, 1, 2, 3].map(|i| p[i].point), |a, b, u| a.lerp(b, u)))
        .collect();
    let width_controls: Vec<[f64; 4]> = curve
        .windows(4)
        .map(|p| cubic_spline([0, 1, 2, 3].map(|i| 2.0 * p[i].radius), mean))
        .collect();
    let steps = |segment: usize| {
        let w = width_controls[segment];
        let widest = w.iter().copied().fold(0.0, f64::max);
        // The outline bends with the width, too.
        let outline = w.map(|w| DVec3::new(0.5 * w, 0.0, 0.0));
        tube::steps(&segments[segment], widest).max(tube::steps(&outline, widest))
    };
    let rows = (0..segments.len()).map(|segment| steps(segment) as usize + 1);
    bounded(mesh, rows.sum(), limits)?;
    let stations = tube::stations(&segments, steps, |segment, u| {
        bezier(width_controls[segment], u)
    });
    let first = mesh.positions.len();
    tube::tube(&stations, SIDES, mesh);
    if mesh.is_fibre {
        mesh.tangents.extend(tube::tangents(&stations, SIDES));
    }
    let rows = mesh.uvs[first..].chunks_exact_mut(SIDES as usize + 1);
    for (row, station) in rows.zip(&stations) {
        let v = along(station.segment as f64 + station.u);
        row.iter_mut().for_each(|uv| *uv = [uv[1], v]);
    }
    Ok(())
}

fn mean(a: f64, b: f64, u: f64) -> f64 {
    a + u * (b - a)
}

/// A cubic Bezier polynomial and its derivative.
fn bezier([a, b, c, d]: [f64; 4], u: f64) -> [f64; 2] {
    let (ab, bc, cd) = (mean(a, b, u), mean(b, c, u), mean(c, d, u));
    let (abc, bcd) = (mean(ab, bc, u), mean(bc, cd, u));
    [mean(abc, bcd, u), 3.0 * (bcd - abc)]
}

/// Cones around straight segments, and balls around control points.
fn polyline(curve: &[ControlPoint], along: impl Fn(f64) -> f32, mesh: &mut Mesh) {
    let mut axis = DVec3::Z;
    for (i, pair) in curve.windows(2).enumerate() {
        let [from, to] = [pair[0], pair[1]];
        let way = to.point - from.point;
        axis = way.try_normalize().unwrap_or(axis);
        let ends = [along(i as f64), along((i + 1) as f64)];
        ball(from, axis, ends[0], mesh);
        cone([from, to], ends, mesh);
        if i + 2 == curve.len() {
            ball(to, axis, ends[1], mesh);
        }
    }
}

/// The cone that touches two balls; none where one holds the other.
fn cone([from, to]: [ControlPoint; 2], ends: [f32; 2], mesh: &mut Mesh) {
    let way = to.point - from.point;
    let length = way.length();
    // The sine of the angle between the cone's normals and the plane across its axis.
    let sin = (from.radius - to.radius) / length;
    if !(length > 0.0 && sin.abs() < 1.0) {
        return;
    }
    let cos = (1.0 - sin * sin).sqrt();
    let axis = way / length;
    for (row, control) in [from, to].into_iter().enumerate() {
        let centre = control.point + axis * (sin * control.radius);
        ring(centre, control.radius, axis, [sin, cos], ends[row], mesh);
    }
    join_rows(SIDES, mesh);
}

/// A ball in rows from pole to pole.
fn ball(control: ControlPoint, axis: DVec3, v: f32, mesh: &mut Mesh) {
    for row in 0..=BALL_ROWS {
        let (sin, cos) = match row {
            0 => (-1.0, 0.0),
            BALL_ROWS => (1.0, 0.0),
            _ => (PI * (f64::from(row) / f64::from(BALL_ROWS) - 0.5)).sin_cos(),
        };
        let fit = circumradius(SIDES);
        let centre = control.point + axis * (sin * fit * control.radius);
        ring(centre, control.radius, axis, [sin, cos], v, mesh);
        if row > 0 {
            join_rows(SIDES, mesh);
        }
    }
}

/// A row of vertices around an axis.
///
/// * `[sin, cos]`: of the angle between the normals and the plane across the axis.
fn ring(centre: DVec3, radius: f64, axis: DVec3, [sin, cos]: [f64; 2], v: f32, mesh: &mut Mesh) {
    let across = axis.any_orthonormal_vector();
    let up = axis.cross(across);
    let fit = circumradius(SIDES);
    for side in 0..=SIDES {
        let share = f64::from(side) / f64::from(SIDES);
        let (s, c) = (2.0 * PI * share).sin_cos();
        let outwards = across * c + up * s;
        let normal = outwards * cos + axis * sin;
        let point = centre + outwards * (cos * fit * radius);
        mesh.positions.push(point.to_array().map(f32_of));
        mesh.normals.push(normal.to_array().map(f32_of));
        mesh.uvs.push([f32_of(share), v]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{area, clean};

    fn parsed(text: &str, basis: CurveBasis) -> Result<Mesh, Vec<Fault>> {
        let mut faults = Faults::new(false);
        let limits = Limits::default();
        let read = parse(text.as_bytes(), basis, &limits, &mut faults)
            .and_then(|curves| mesh(&curves, basis, false, &limits));
        faults.end(read)
    }

    fn area_of(mut mesh: Mesh) -> f64 {
        clean(&mut mesh).unwrap();
        area(&mesh, &DMat4::IDENTITY)
    }

    /// Whether triangles are turned as their normals, and those are what moves from the surface.
    fn points_outwards(mesh: &Mesh) -> bool {
        mesh.triangles.iter().all(|t| {
            let [a, b, c] = t.map(|i| DVec3::from(mesh.positions[i as usize].map(f64::from)));
            let normals = t.map(|i| DVec3::from(mesh.normals[i as usize].map(f64::from)));
            let geometric = (b - a).cross(c - a).normalize();
            normals.iter().all(|n| n.dot(geometric) > 0.8)
        })
    }

    #[test]
    fn a_straight_spline_is_a_cylinder_between_its_inner_points() {
        let text = "0 0 -1 0.2\n0 0 0 0.2\n0 0 1 0.2 ignored\r\n0 0 2 0.2\n\n\n5 0 0 0.1\n6 0 0 0.1\n7 0 0 0.1\n8 0 0 0.1";
        let mesh = parsed(text, CurveBasis::Spline).unwrap();
        assert!(points_outwards(&mesh));
        // The mean width makes the girth that of a circle.
        let expected = 2.0 * PI * (0.2 + 0.1);
        assert!((area_of(mesh) / expected - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_radius_of_a_spline_is_a_spline() {
        // De Boor: values at the ends of a uniform cubic segment are (1, 4, 1) / 6.
        let radii = [0.1, 0.2, 0.4, 0.1];
        let text: Vec<String> = (0..4).map(|i| format!("{i} 0 0 {}", radii[i])).collect();
        let mesh = parsed(&text.join("\n"), CurveBasis::Spline).unwrap();
        let radius = |x: f64| {
            let at_x = mesh
                .positions
                .iter()
                .filter(|p| (f64::from(p[0]) - x).abs() < 1e-6);
            let far = at_x.map(|p| f64::from(p[1]).hypot(f64::from(p[2])));
            far.fold(0.0, f64::max) / circumradius(SIDES)
        };
        assert!((radius(1.0) - (0.1 + 4.0 * 0.2 + 0.4) / 6.0).abs() < 1e-6);
        assert!((radius(2.0) - (0.2 + 4.0 * 0.4 + 0.1) / 6.0).abs() < 1e-6);
        // Where the radius grows, normals lean back: n . (tangent + r' outwards) = 0.
        let slope = 0.5 * (0.4 - 0.1);
        let first = mesh
            .positions
            .iter()
            .position(|p| (p[0] - 1.0).abs() < 1e-6)
            .unwrap();
        let n = mesh.normals[first].map(f64::from);
        assert!((n[0] + slope * n[1].hypot(n[2])).abs() < 1e-6, "{n:?}");
    }

    #[test]
    fn straight_segments_are_cones_that_touch_their_balls() {
        let mesh = parsed("0 0 0 0.5\n0 0 3 0.2\n", CurveBasis::Linear).unwrap();
        assert!(points_outwards(&mesh));
        let fit = circumradius(SIDES);
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            let [p, n] = [p, n].map(|v| DVec3::from(v.map(f64::from)));
            let distance = |centre: f64, radius: f64| {
                let from_axis = DVec3::new(p.x, p.y, 0.0).length() / fit;
                (from_axis.hypot(p.z - centre) - radius).abs()
            };
            let nearest = distance(0.0, 0.5).min(distance(3.0, 0.2));
            assert!(nearest < 7e-3, "{p}");
            assert!((n.length() - 1.0).abs() < 1e-6);
        }
        // A ball within another needs no cone, nor does one at the same place.
        let balls = 2 * (BALL_ROWS as usize + 1) * (SIDES as usize + 1);
        for second in ["0 0 0.1 0.2", "0 0 0 0.5"] {
            let mesh = parsed(&format!("0 0 0 0.5\n{second}"), CurveBasis::Linear).unwrap();
            assert_eq!(mesh.positions.len(), balls, "{second}");
        }
    }

    #[test]
    fn meshes_are_bounded_before_they_are_built() {
        let limits = Limits {
            max_vertices: 400,
            ..Limits::default()
        };
        // Both have few points, and many rows of vertices.
        let bent = "0 0 0 1e-3\n1 5 0 1e-3\n2 -5 0 1e-3\n3 5 0 1e-3\n4 0 0 1e-3\n";
        for basis in [CurveBasis::Spline, CurveBasis::Linear] {
            let mut faults = Faults::new(false);
            let curves = parse(bent.as_bytes(), basis, &limits, &mut faults).unwrap();
            let fault = mesh(&curves, basis, false, &limits).unwrap_err();
            assert!(fault.message.contains("`max_vertices`"), "{fault}");
        }
    }

    #[test]
    fn bad_files_say_what_was_expected() {
        let four = "0 0 0 1\n1 0 0 1\n2 0 0 1\n";
        for (text, basis, expected) in [
            (
                "",
                CurveBasis::Linear,
                "expected lines `x y z radius`, found none",
            ),
            (
                four,
                CurveBasis::Spline,
                "line 3: a curve needs at least 4 control points, found 3",
            ),
            (
                "0 0 0 1\n\n1 0 0 1\n2 0 0 1",
                CurveBasis::Linear,
                "line 1: a curve needs at least 2 control points, found 1",
            ),
            (
                "0 0 0 1\n0 0 1\n",
                CurveBasis::Linear,
                "line 2: expected the four numbers `x y z radius`, found 3",
            ),
            (
                "0 0 0 1\n0 0 1 -1\n",
                CurveBasis::Linear,
                "line 2: expected a radius of at least 0, found -1",
            ),
            (
                "0 nan 0 1\n0 0 1 1\n",
                CurveBasis::Linear,
                "line 1: expected a finite number, found `nan`",
            ),
        ] {
            let faults = parsed(text, basis).unwrap_err();
            assert_eq!(faults[0].to_string(), expected);
        }
    }
}
