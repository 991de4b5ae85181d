//! The element `face`.

use super::header::{Element, Encoding, Property, Scalar};
use super::values::Values;
use crate::Limits;
use crate::faults::{Fault, Faults};

/// Whether a property lists the vertices of a face.
pub(super) fn is_indices(property: &Property) -> bool {
    matches!(property.name.as_str(), "vertex_indices" | "vertex_index") && property.count.is_some()
}

/// Whether faces have lists of whole numbers to read.
pub(super) fn has_indices(element: &Element) -> bool {
    let mut properties = element.properties.iter();
    properties.any(|p| is_indices(p) && p.value.is_integer())
}

/// Triangles of polygons.
#[derive(Default)]
pub(super) struct Faces {
    /// They fan out from the first vertex of their polygon.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The first triangle of each quadrilateral.
    pub(super) quads: Vec<usize>,
}

/// Reads polygons. Indices are not yet checked against the number of vertices.
///
/// # Errors
///
/// Where a face has fewer than three vertices, an index is none, or the data end.
pub(super) fn read(
    element: &Element,
    values: &mut Values<'_>,
    encoding: Encoding,
    limits: &Limits,
    faults: &mut Faults,
) -> Result<Faces, Fault> {
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(element.count);
    let mut quads = Vec::new();
    let mut face = plain(element, values, encoding, &mut triangles);
    let mut corners: Vec<u32> = Vec::new();
    while face < element.count {
        for property in &element.properties {
            let count = match property.count {
                Some(scalar) => values.count(scalar)?,
                None => 1,
            };
            if !is_indices(property) {
                for _ in 0..count {
                    values.next(property.value)?;
                }
                continue;
            }
            corners.clear();
            for _ in 0..count {
                match index(values.next(property.value)?, face) {
                    Ok(corner) => corners.push(corner),
                    Err(message) => faults.record(message)?,
                }
            }
            if count < 3 {
                faults.record(format!(
                    "face {face} has {count} vertices; expected at least 3"
                ))?;
            }
            if corners.len() < 3 {
                continue;
            }
            if corners.len() == 4 {
                quads.push(triangles.len());
            }
            triangles.extend(corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]));
            if triangles.len() as u64 > limits.max_vertices {
                let most = limits.max_vertices;
                let message = format!("it has more than {most} triangles (`max_vertices`)");
                return Err(message.into());
            }
        }
        face += 1;
    }
    Ok(Faces { triangles, quads })
}

/// Reads leading triangles of the common layout, a list of 32-bit indices with byte counts and
/// nothing else in little-endian order; returns how many faces it took.
fn plain(
    element: &Element,
    values: &mut Values<'_>,
    encoding: Encoding,
    triangles: &mut Vec<[u32; 3]>,
) -> usize {
    const STRIDE: usize = 13;
    let common = encoding == Encoding::Little
        && matches!(element.properties.as_slice(), [p]
            if p.count == Some(Scalar::U8) && matches!(p.value, Scalar::I32 | Scalar::U32));
    if !common {
        return 0;
    }
    let records = values.rest().as_chunks::<STRIDE>().0;
    let signed = element.properties[0].value == Scalar::I32;
    let last = if signed {
        i32::MAX.unsigned_abs()
    } else {
        u32::MAX
    };
    for record in records.iter().take(element.count) {
        let [count, indices @ ..] = record;
        let (corners, _) = indices.as_chunks::<4>();
        let triangle = [corners[0], corners[1], corners[2]].map(u32::from_le_bytes);
        if *count != 3 || triangle.iter().any(|i| *i > last) {
            break;
        }
        triangles.push(triangle);
    }
    values.advance(triangles.len() * STRIDE);
    triangles.len()
}

fn index(x: f64, face: usize) -> Result<u32, String> {
    if (0.0..=f64::from(u32::MAX)).contains(&x) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "an integer within u32"
        )]
        return Ok(x as u32);
    }
    Err(format!(
        "face {face} refers to vertex {x}; expected an index from 0"
    ))
}
