//! pbrt-v3's `heightfield`: heights over a grid of the unit square, as the triangles that it is there.

use super::mesh_error;
use crate::error::SceneError;
use crate::grid;
use crate::num::f32_of;
use crate::pbrt::context::Entity;
use crate::scene::Mesh;

/// Most points along a side.
const MOST_POINTS: u32 = 1 << 14;

/// Reads the shape.
pub(super) fn read(entity: &Entity) -> Result<Mesh, SceneError> {
    let params = &entity.params;
    let side = |name: &str| params.integer_within(name, 2, 2..=MOST_POINTS);
    let [nu, nv] = [side("nu")?, side("nv")?];
    let heights = params.numbers("Pz", &["float"])?.unwrap_or(&[]);
    if heights.len() as u64 != u64::from(nu) * u64::from(nv) {
        let message = format!(
            "\"Pz\": expected {nu} times {nv} heights, found {}",
            heights.len()
        );
        return Err(mesh_error(entity, "Pz", message));
    }
    let mut mesh = Mesh::default();
    for (row, heights) in (0..nv).zip(heights.chunks(nu as usize)) {
        for (column, height) in (0..nu).zip(heights) {
            let x = f64::from(column) / f64::from(nu - 1);
            let y = f64::from(row) / f64::from(nv - 1);
            mesh.positions.push([x, y, *height].map(f32_of));
            mesh.uvs.push([x, y].map(f32_of));
        }
    }
    mesh.triangles = grid::triangles(&mesh.positions, [nu, nv]);
    Ok(mesh)
}
