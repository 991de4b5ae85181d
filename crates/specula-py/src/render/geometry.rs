//! What shapes are given: vectors, transforms and triangles that make sense.

use glam::DMat4;
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use specula::scene::scene::Mesh;

use crate::parameters::invalid;

/// An affine transform that can be inverted, of its rows.
pub(super) fn affine(rows: Option<[[f64; 4]; 4]>) -> PyResult<DMat4> {
    let Some(rows) = rows else {
        return Ok(DMat4::IDENTITY);
    };
    let matrix = DMat4::from_cols_array_2d(&rows).transpose();
    if !matrix.is_finite() || rows[3] != [0.0, 0.0, 0.0, 1.0] {
        return Err(invalid(
            "transform: expected finite numbers whose last row is 0, 0, 0, 1",
        ));
    }
    let inverse = matrix.inverse();
    match matrix.determinant() != 0.0 && inverse.is_finite() {
        true => Ok(matrix),
        false => Err(invalid("transform: expected a matrix that can be inverted")),
    }
}

/// Three finite numbers.
pub(super) fn finite(name: &str, vector: [f64; 3]) -> PyResult<[f64; 3]> {
    match vector.iter().all(|x| x.is_finite()) {
        true => Ok(vector),
        false => Err(invalid(format!(
            "{name}: expected finite numbers, got {vector:?}"
        ))),
    }
}

pub(super) fn unit(name: &str, vector: [f64; 3]) -> PyResult<[f64; 3]> {
    let [x, y, z] = finite(name, vector)?;
    let length = x.hypot(y).hypot(z);
    match length > 0.0 && length.is_finite() {
        true => Ok([x / length, y / length, z / length]),
        false => Err(invalid(format!(
            "{name}: expected a direction, got {vector:?}"
        ))),
    }
}

/// Triangles of vertices that exist.
pub(super) fn triangles(
    faces: &PyReadonlyArray2<'_, i64>,
    count: usize,
) -> PyResult<Vec<[u32; 3]>> {
    let faces = faces.as_slice()?;
    let (faces, _) = faces.as_chunks::<3>();
    let vertex = |i: i64| u32::try_from(i).ok().filter(|&i| (i as usize) < count);
    let of = |(n, face): (usize, &[i64; 3])| match face.map(vertex) {
        [Some(a), Some(b), Some(c)] => Ok([a, b, c]),
        _ => Err(invalid(format!(
            "faces[{n}]: expected indices of {count} vertices, got {face:?}"
        ))),
    };
    faces.iter().enumerate().map(of).collect()
}

/// Removes triangles without area; returns how many there were.
pub(super) fn drop_flat(mesh: &mut Mesh) -> usize {
    let positions = &mesh.positions;
    let corner = |i: u32| positions[i as usize].map(f64::from);
    let has_area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let cross = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        let length = cross[0].hypot(cross[1]).hypot(cross[2]);
        length > 0.0 && (1.0 / length).is_finite()
    };
    let before = mesh.triangles.len();
    mesh.triangles.retain(has_area);
    before - mesh.triangles.len()
}
