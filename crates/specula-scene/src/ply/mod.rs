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
use crate::scene::{Mesh, PatchMesh, is_parallelogram};
use header::{Encoding, Header};

/// A mesh of polygons.
#[derive(Default)]
pub(crate) struct Polygons {
    /// Triangles of polygons fan out from their first vertex.
    pub(crate) mesh: Mesh,
    /// The first triangle of each quadrilateral.
    quads: Vec<usize>,
}

/// Reads a mesh. Triangles of polygons fan out from their first vertex.
///
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// What is wrong with the file.
pub(crate) fn read(path: &Path, files: &Files, collects: bool) -> Result<Mesh, Vec<Fault>> {
    read_polygons(path, files, collects).map(|polygons| polygons.mesh)
}

/// [`read`], which remembers which polygons are quadrilaterals.
///
/// # Errors
///
/// Those of [`read`].
pub(crate) fn read_polygons(
    path: &Path,
    files: &Files,
    collects: bool,
) -> Result<Polygons, Vec<Fault>> {
    let bytes = files.unpacked(path).map_err(|m| vec![m.into()])?;
    parse(&bytes, files.limits(), collects)
}

impl Polygons {
    /// The corners of a quadrilateral as those of a patch.
    fn corners(&self, first: usize) -> [u32; 4] {
        let triangles = &self.mesh.triangles;
        let ([a, b, c], [_, _, d]) = (triangles[first], triangles[first + 1]);
        [a, b, d, c]
    }

    /// Quadrilaterals as bilinear patches, and the triangles that are left. All are triangles where all quadrilaterals
    /// are parallelograms, which two triangles equal.
    pub(crate) fn split(self) -> (Mesh, Option<PatchMesh>) {
        let patches: Vec<[u32; 4]> = self.quads.iter().map(|q| self.corners(*q)).collect();
        let Self { mut mesh, quads } = self;
        let is_flat = |p: &[u32; 4]| is_parallelogram(p.map(|v| mesh.positions[v as usize]));
        if patches.iter().all(is_flat) {
            return (mesh, None);
        }
        let mut is_half = vec![false; mesh.triangles.len()];
        for first in quads {
            is_half[first..first + 2].fill(true);
        }
        let mut is_half = is_half.into_iter();
        mesh.triangles.retain(|_| is_half.next() == Some(false));
        let vertices = match mesh.triangles.is_empty() {
            true => std::mem::take(&mut mesh),
            false => mesh.clone(),
        };
        let patches = PatchMesh {
            positions: vertices.positions,
            normals: vertices.normals,
            uvs: vertices.uvs,
            patches,
            are_polygons: true,
        };
        (mesh, Some(patches))
    }
}

/// Reads a mesh from the bytes of a PLY file.
///
/// # Errors
///
/// What was expected, with its line in headers and texts.
fn parse(bytes: &[u8], limits: &Limits, collects: bool) -> Result<Polygons, Vec<Fault>> {
    let mut faults = Faults::new(collects);
    let read = parse_into(bytes, limits, &mut faults);
    faults.end(read)
}

fn parse_into(bytes: &[u8], limits: &Limits, faults: &mut Faults) -> Result<Polygons, Fault> {
    let (header, rest) = header::read(bytes, faults)?;
    header.check(rest.len(), limits, faults)?;
    if !faults.is_empty() {
        // Data behind a damaged header cannot be interpreted.
        return Ok(Polygons::default());
    }
    if header.encoding == Encoding::Text {
        return data(&header, rest, limits, &mut Faults::new(false)).or_else(|first| {
            let (before, _) = bytes.split_at(bytes.len() - rest.len());
            let line = 1 + before.iter().filter(|b| **b == b'\n').count();
            rows::name(&header, rest, line, faults)?;
            match faults.is_empty() {
                true => Err(first),
                false => Ok(Polygons::default()),
            }
        });
    }
    data(&header, rest, limits, faults)
}

fn data(
    header: &Header,
    rest: &[u8],
    limits: &Limits,
    faults: &mut Faults,
) -> Result<Polygons, Fault> {
    let encoding = header.encoding;
    let mut values = values::Values::new(rest, encoding);
    let mut mesh = Mesh::default();
    let mut faces = faces::Faces::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => mesh = vertices::read(element, &mut values, encoding)?,
            "face" => faces = faces::read(element, &mut values, encoding, limits, faults)?,
            _ => values.skip(element)?,
        }
    }
    mesh.triangles = faces.triangles;
    let count = mesh.positions.len();
    let outside = |t: &[u32; 3]| t.iter().any(|i| *i as usize >= count);
    if !faults.is_empty() || mesh.triangles.iter().any(outside) {
        faults::of_mesh(&mesh, faults)?;
    }
    let quads = faces.quads;
    Ok(Polygons { mesh, quads })
}

#[cfg(test)]
mod tests;
