//! `curve`: Bezier curves and B-splines of some width, as cubic Bezier segments.

use glam::DVec3;

use super::mesh_error;
use crate::error::{ErrorKind, SceneError};
use crate::mesh::Cleaning;
use crate::num::{f32_of, shorten};
use crate::pbrt::context::{Context, Entity};
use crate::scene::tube::{Bezier, cubic_spline};
use crate::scene::{CurveKind, CurveMesh};

/// Reads the shape `curve`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<CurveMesh, SceneError> {
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
    let (kind, normals) = kind(context, entity, segments.len())?;
    let narrow = |p: DVec3| p.to_array().map(f32_of);
    let count = segments.len() as f64;
    let [first, last] = width_at_ends;
    let width = |i: usize| f32_of(first + i as f64 / count * (last - first));
    let ends = |i: usize| [normals[i], normals[i + 1]];
    Ok(CurveMesh {
        kind,
        width_at_ends: (0..segments.len())
            .map(|i| [width(i), width(i + 1)])
            .collect(),
        normals: match kind {
            CurveKind::Ribbon => (0..segments.len()).map(ends).collect(),
            CurveKind::Flat | CurveKind::Cylinder => Vec::new(),
        },
        segments: segments.into_iter().map(|s| s.map(narrow)).collect(),
        is_fibre: false,
    })
}

/// The kind, and of ribbons the unit normals between segments.
fn kind(
    context: &mut Context,
    entity: &Entity,
    segments: usize,
) -> Result<(CurveKind, Vec<[f32; 3]>), SceneError> {
    let params = &entity.params;
    let normals = params.numbers("N", &["normal"])?;
    let kind = match params.string("type")? {
        None | Some(("flat", _)) => CurveKind::Flat,
        Some(("cylinder", _)) => CurveKind::Cylinder,
        Some(("ribbon", _)) => {
            let given = normals.unwrap_or_default().as_chunks::<3>().0;
            if given.len() != segments + 1 {
                let message = format!(
                    "\"N\": a ribbon of {segments} segments needs {} normals, found {}",
                    segments + 1,
                    given.len()
                );
                return Err(mesh_error(entity, "N", message));
            }
            let unit = |n: &[f64; 3]| DVec3::from(*n).normalize_or(DVec3::Z);
            let unit = given.iter().map(|n| unit(n).to_array().map(f32_of));
            return Ok((CurveKind::Ribbon, unit.collect()));
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
    Ok((kind, Vec::new()))
}

/// Drops segments without length or width.
pub(in crate::pbrt) fn clean(curves: CurveMesh) -> (CurveMesh, Cleaning) {
    let count = curves.segments.len();
    let kept: Vec<usize> = (0..count).filter(|i| curves.has_area(*i)).collect();
    let cleaning = Cleaning {
        dropped_segments: count - kept.len(),
        ..Cleaning::default()
    };
    if kept.len() == count {
        return (curves, cleaning);
    }
    let cleaned = CurveMesh {
        segments: kept.iter().map(|i| curves.segments[*i]).collect(),
        width_at_ends: kept.iter().map(|i| curves.width_at_ends[*i]).collect(),
        normals: (kept.iter())
            .filter_map(|i| curves.normals.get(*i).copied())
            .collect(),
        ..curves
    };
    (cleaned, cleaning)
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn segments_without_width_are_dropped() {
        let segment = [0.0, 1.0, 2.0, 3.0].map(|x: f32| [x, 0.0, 0.0]);
        let curves = CurveMesh {
            kind: CurveKind::Ribbon,
            segments: vec![segment; 3],
            width_at_ends: vec![[0.0, 0.1], [0.0; 2], [0.2; 2]],
            normals: vec![
                [[0.0, 0.0, 1.0]; 2],
                [[1.0, 0.0, 0.0]; 2],
                [[0.0, 1.0, 0.0]; 2],
            ],
            is_fibre: true,
        };
        let (cleaned, cleaning) = clean(curves);
        assert_eq!(cleaning.dropped_segments, 1);
        assert_eq!(cleaned.width_at_ends, [[0.0, 0.1], [0.2; 2]]);
        assert_eq!(cleaned.normals[1], [[0.0, 1.0, 0.0]; 2]);
        assert!(cleaned.segments.len() == 2 && cleaned.is_fibre);
    }
}
