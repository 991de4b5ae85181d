//! Meshes in PLY files (Turk 1994), plain or gzipped: text and both binary orders.
//!
//! Strict: a header that promises more than the file holds is an error before anything is read. A
//! check names all mistakes of the header, or all bad rows of a text, or what is wrong in binary data up
//! to where they cannot be followed any more.

mod faces;
mod header;
mod rows;
mod values;
mod vertices;

use std::path::Path;

use crate::Limits;
use crate::faults::{self, Fault, Faults};
use crate::read_file::Files;
use crate::scene::Mesh;
use header::{Encoding, Header};

/// Reads a mesh. Triangles of polygons fan out from their first vertex.
///
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// What is wrong with the file.
pub(crate) fn read(path: &Path, files: &Files, collects: bool) -> Result<Mesh, Vec<Fault>> {
    let bytes = files.unpacked(path).map_err(|m| vec![m.into()])?;
    parse(&bytes, files.limits(), collects)
}

/// Reads a mesh from the bytes of a PLY file.
///
/// # Errors
///
/// What was expected, with its line in headers and texts.
fn parse(bytes: &[u8], limits: &Limits, collects: bool) -> Result<Mesh, Vec<Fault>> {
    let mut faults = Faults::new(collects);
    let read = parse_into(bytes, limits, &mut faults);
    faults.end(read)
}

fn parse_into(bytes: &[u8], limits: &Limits, faults: &mut Faults) -> Result<Mesh, Fault> {
    let (header, rest) = header::read(bytes, faults)?;
    header.check(rest.len(), limits, faults)?;
    if !faults.is_empty() {
        // Data behind a damaged header cannot be interpreted.
        return Ok(Mesh::default());
    }
    if header.encoding == Encoding::Text {
        return data(&header, rest, limits, &mut Faults::new(false)).or_else(|first| {
            let (before, _) = bytes.split_at(bytes.len() - rest.len());
            let line = 1 + before.iter().filter(|b| **b == b'\n').count();
            rows::name(&header, rest, line, faults)?;
            match faults.is_empty() {
                true => Err(first),
                false => Ok(Mesh::default()),
            }
        });
    }
    data(&header, rest, limits, faults)
}

fn data(header: &Header, rest: &[u8], limits: &Limits, faults: &mut Faults) -> Result<Mesh, Fault> {
    let encoding = header.encoding;
    let mut values = values::Values::new(rest, encoding);
    let mut mesh = Mesh::default();
    let mut triangles = Vec::new();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => mesh = vertices::read(element, &mut values, encoding)?,
            "face" => triangles = faces::read(element, &mut values, encoding, limits, faults)?,
            _ => values.skip(element)?,
        }
    }
    mesh.triangles = triangles;
    let count = mesh.positions.len();
    let outside = |t: &[u32; 3]| t.iter().any(|i| *i as usize >= count);
    if !faults.is_empty() || mesh.triangles.iter().any(outside) {
        faults::of_mesh(&mesh, faults)?;
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests;
