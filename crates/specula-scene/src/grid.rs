//! Grids of points as triangles.

/// The triangles of a grid, two for each cell; those with a side of no length, as at poles and tips, are left out.
///
/// * `positions`: of the points, row by row.
/// * `columns`, `rows`: how many points there are.
pub(crate) fn triangles(positions: &[[f32; 3]], [columns, rows]: [u32; 2]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            let a = row * columns + column;
            let (b, c, d) = (a + 1, a + columns + 1, a + columns);
            for triangle in [[a, b, c], [a, c, d]] {
                let [p, q, r] = triangle.map(|i| positions[i as usize]);
                if p != q && q != r && r != p {
                    triangles.push(triangle);
                }
            }
        }
    }
    triangles
}
