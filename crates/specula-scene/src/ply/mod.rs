//! Meshes in PLY files (Turk 1994), plain or gzipped: text and both binary orders.
//!
//! Strict: a header that promises more than the file holds is an error before anything is read.
//! The crate `ply-rs-bw` was used before; ten million triangles took it longer than the rest of
//! the loading together, and it refused `.5` in texts.

mod faces;
mod header;
mod values;
mod vertices;

use std::path::Path;

use crate::Limits;
use crate::read_file::read_bytes;
use crate::scene::Mesh;

/// Reads a mesh. Triangles of polygons fan out from their first vertex.
///
/// # Errors
///
/// A message that begins with the file's name.
pub(crate) fn read(path: &Path, limits: &Limits) -> Result<Mesh, String> {
    let wrong = |message: String| format!("mesh {}: {message}", path.display());
    let bytes = read_bytes(path, limits).map_err(wrong)?;
    parse(&bytes, limits).map_err(wrong)
}

/// Reads a mesh from the bytes of a PLY file.
///
/// # Errors
///
/// A message saying what was expected.
pub(crate) fn parse(bytes: &[u8], limits: &Limits) -> Result<Mesh, String> {
    let (header, rest) = header::read(bytes)?;
    let mut values = values::Values::new(rest, header.encoding);
    let mut mesh = None;
    let mut triangles = Vec::new();
    for element in &header.elements {
        let most = limits.max_vertices;
        if element.count as u64 > most {
            let (count, name) = (element.count, &element.name);
            return Err(format!(
                "it has {count} of `{name}`; at most {most} are read (`max_vertices`)"
            ));
        }
        match element.name.as_str() {
            "vertex" => mesh = Some(vertices::read(element, &mut values, header.encoding)?),
            "face" => triangles = faces::read(element, &mut values, header.encoding, limits)?,
            _ => values.skip(element)?,
        }
    }
    let mut mesh = mesh.ok_or("it has no element `vertex`")?;
    let count = mesh.positions.len();
    let outside = |t: &[u32; 3]| t.iter().any(|i| *i as usize >= count);
    if let Some(i) = triangles.iter().position(outside) {
        let [a, b, c] = triangles[i];
        return Err(format!(
            "triangle {i} refers to vertices {a}, {b} and {c}, but there are {count} vertices"
        ));
    }
    mesh.triangles = triangles;
    Ok(mesh)
}

#[cfg(test)]
mod tests;
