//! Meshes of `rectangle` and `cube`, as Mitsuba lays out their coordinates, and the place of `cylinder`.

use glam::{DMat4, DVec3, DVec4};

use crate::scene::Mesh;

/// `[-1, 1]^2` in the plane z = 0, facing +z.
pub(super) fn rectangle() -> Mesh {
    Mesh {
        positions: vec![
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [-1.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
        ],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]],
        triangles: vec![[1, 2, 0], [1, 3, 2]],
        ..Mesh::default()
    }
}

/// `[-1, 1]^3`. Every side has coordinates from 0 to 1: `(normal, direction of u, direction of v)`.
pub(super) fn cube() -> Mesh {
    const SIDES: [[[f32; 3]; 3]; 6] = [
        [[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
        [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]],
    ];
    let mut mesh = Mesh::default();
    for (first, [normal, along_u, along_v]) in (0..).step_by(4).zip(SIDES) {
        for [u, v] in [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]] {
            let at =
                |c: usize| normal[c] + (2.0 * u - 1.0) * along_u[c] + (2.0 * v - 1.0) * along_v[c];
            mesh.positions.push([at(0), at(1), at(2)]);
            mesh.normals.push(normal);
            mesh.uvs.push([u, v]);
        }
        mesh.triangles.push([first, first + 1, first + 2]);
        mesh.triangles.push([first + 3, first, first + 2]);
    }
    mesh
}

/// The unit cylinder to one from `p0` to `p1`; `None` where they are the same point.
///
/// The azimuth begins where the frame of Duff et al. 2017 puts it.
pub(super) fn cylinder_placement(p0: DVec3, p1: DVec3, radius: f64) -> Option<DMat4> {
    let axis = (p1 - p0).try_normalize()?;
    let sign = 1.0_f64.copysign(axis.z);
    let a = -1.0 / (sign + axis.z);
    let b = axis.x * axis.y * a;
    let s = DVec3::new(1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
    let t = DVec3::new(b, sign + axis.y * axis.y * a, -axis.y);
    let length = (p1 - p0).length();
    Some(DMat4::from_cols(
        (s * radius).extend(0.0),
        (t * radius).extend(0.0),
        (axis * length).extend(0.0),
        DVec4::new(p0.x, p0.y, p0.z, 1.0),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(v: [f32; 3]) -> DVec3 {
        DVec3::from(v.map(f64::from))
    }

    #[test]
    fn windings_face_the_way_that_normals_do() {
        for mesh in [rectangle(), cube()] {
            for t in &mesh.triangles {
                let [a, b, c] = t.map(|i| vector(mesh.positions[i as usize]));
                let normal = (b - a).cross(c - a);
                for i in t {
                    assert!(normal.dot(vector(mesh.normals[*i as usize])) > 0.0, "{t:?}");
                }
            }
        }
    }

    /// Mitsuba 3.9.1's cube, hit from above at x = 0.1, y = 0.2, has u = 0.6 along +y and
    /// v = 0.55 along +x.
    #[test]
    fn a_cubes_top_has_mitsubas_coordinates() {
        let mesh = cube();
        let top: Vec<usize> = (0..24).filter(|i| mesh.normals[*i][2] == 1.0).collect();
        for i in top {
            let ([x, y, z], [u, v]) = (mesh.positions[i], mesh.uvs[i]);
            assert_eq!((z, u, v), (1.0, 0.5 * (y + 1.0), 0.5 * (x + 1.0)));
        }
    }

    #[test]
    fn cylinders_reach_from_point_to_point() {
        let (p0, p1) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(-1.0, 2.0, 3.5));
        let m = cylinder_placement(p0, p1, 0.25).unwrap();
        assert!(m.transform_point3(DVec3::ZERO).distance(p0) < 1e-12);
        assert!(m.transform_point3(DVec3::Z).distance(p1) < 1e-12);
        assert!((m.transform_vector3(DVec3::X).length() - 0.25).abs() < 1e-12);
        assert!(m.determinant() > 0.0);
        assert!(cylinder_placement(p0, p0, 1.0).is_none());
    }
}
