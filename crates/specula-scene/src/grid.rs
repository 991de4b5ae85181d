//! Grids of points as triangles.

use crate::scene::Mesh;

/// Adds the triangles of a grid, two for each cell; those with a side of no length, as at poles and tips, are left out.
///
/// * `columns`, `rows`: how many points the mesh has, row by row.
pub(crate) fn add_triangles(mesh: &mut Mesh, [columns, rows]: [u32; 2]) {
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            let a = row * columns + column;
            let (b, c, d) = (a + 1, a + columns + 1, a + columns);
            for triangle in [[a, b, c], [a, c, d]] {
                let [p, q, r] = triangle.map(|i| mesh.positions[i as usize]);
                if p != q && q != r && r != p {
                    mesh.triangles.push(triangle);
                }
            }
        }
    }
}
