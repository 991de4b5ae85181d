//! Cleaning and checking of meshes.

use glam::DVec3;
use rayon::prelude::*;

use crate::faults::{self, Fault, Faults};
use crate::num::f32_of;
use crate::scene::Mesh;

/// What [`clean`] changed.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Cleaning {
    /// Triangles without area that were dropped.
    pub(crate) dropped_triangles: usize,
    /// Patches without area that were dropped.
    pub(crate) dropped_patches: usize,
    /// Segments of curves without length or width that were dropped.
    pub(crate) dropped_segments: usize,
    /// Shading normals that were zero or not finite and became geometric ones.
    pub(crate) replaced_normals: usize,
    /// Whether the surface coordinates were dropped because some were not finite.
    pub(crate) dropped_uvs: bool,
}

impl Cleaning {
    /// Warnings about a mesh that was changed.
    pub(crate) fn messages(&self) -> Vec<String> {
        let mut messages = Vec::new();
        if self.dropped_triangles > 0 {
            let count = self.dropped_triangles;
            messages.push(format!("{count} triangles without area are dropped"));
        }
        if self.dropped_patches > 0 {
            let count = self.dropped_patches;
            messages.push(format!("{count} patches without area are dropped"));
        }
        if self.dropped_segments > 0 {
            let count = self.dropped_segments;
            messages.push(format!(
                "{count} segments without length or width are dropped"
            ));
        }
        if self.replaced_normals > 0 {
            let count = self.replaced_normals;
            messages.push(format!(
                "{count} normals are zero or not finite: geometric ones are used"
            ));
        }
        if self.dropped_uvs {
            messages.push("surface coordinates are dropped: some are not finite".to_owned());
        }
        messages
    }
}

/// Makes `mesh` valid: indices in range, vertices finite, every triangle with area,
/// normals finite and not zero.
///
/// # Errors
///
/// A message where a vertex is not finite or an index is out of range.
pub(crate) fn clean(mesh: &mut Mesh) -> Result<Cleaning, String> {
    let count = mesh.positions.len();
    let not_finite = |p: &[f32; 3]| !is_finite(p);
    if let Some(i) = first(&mesh.positions, not_finite) {
        return Err(format!("vertex {i} is not finite: {:?}", mesh.positions[i]));
    }
    let outside = |t: &[u32; 3]| t.iter().fold(false, |any, &i| any | (i as usize >= count));
    if let Some(t) = first(&mesh.triangles, outside) {
        let [a, b, c] = mesh.triangles[t];
        return Err(format!(
            "triangle {t} refers to vertices {a}, {b}, {c}, but there are {count} vertices"
        ));
    }
    let mut cleaning = Cleaning::default();
    let before = mesh.triangles.len();
    let positions = &mesh.positions;
    let flat = |t: &[u32; 3]| is_flat(positions, t);
    if first(&mesh.triangles, flat).is_some() {
        mesh.triangles.retain(|t| !flat(t));
    }
    cleaning.dropped_triangles = before - mesh.triangles.len();
    let bad_uv = |uv: &[f32; 2]| !is_finite(uv);
    if first(&mesh.uvs, bad_uv).is_some() {
        mesh.uvs.clear();
        cleaning.dropped_uvs = true;
    }
    if first(&mesh.second_uvs, bad_uv).is_some() {
        mesh.second_uvs.clear();
        cleaning.dropped_uvs = true;
    }
    let bad_tangent = |t: &[f32; 4]| !is_finite(t);
    if first(&mesh.tangents, bad_tangent).is_some() {
        mesh.tangents.clear();
    }
    cleaning.replaced_normals = mend_normals(mesh);
    Ok(cleaning)
}

/// [`clean`], which names all that is wrong in a check.
///
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// Those of [`clean`]: one at least.
pub(crate) fn clean_or_name(mesh: &mut Mesh, collects: bool) -> Result<Cleaning, Vec<Fault>> {
    clean(mesh).or_else(|first| {
        let mut faults = Faults::new(collects);
        let named = faults::of_mesh(mesh, &mut faults);
        faults
            .end(named.and(Ok(Cleaning::default())))
            .and(Err(vec![first.into()]))
    })
}

/// Elements that one thread reads: a call into the pool takes longer than so many.
pub(crate) const SERIAL: usize = 1 << 14;

/// The first element of which `is` holds.
pub(crate) fn first<T: Sync>(slice: &[T], is: impl Fn(&T) -> bool + Send + Sync) -> Option<usize> {
    // By parts, most of which have none: those the compiler turns into vectors.
    const PART: usize = 256;
    let within = |first: usize, elements: &[T]| -> Option<usize> {
        for (i, part) in elements.chunks(PART).enumerate() {
            if part.iter().fold(false, |any, x| any | is(x)) {
                return part.iter().position(&is).map(|at| first + PART * i + at);
            }
        }
        None
    };
    if slice.len() <= SERIAL {
        return within(0, slice);
    }
    let parts = slice.par_chunks(SERIAL).enumerate();
    parts
        .map(|(i, part)| within(SERIAL * i, part))
        .find_first(Option::is_some)?
}

fn mend_normals(mesh: &mut Mesh) -> usize {
    let is_bad = |n: &[f32; 3]| !is_finite(n) | is_zero(n);
    if first(&mesh.normals, is_bad).is_none() {
        return 0;
    }
    let bad = mesh.normals.iter().filter(|n| is_bad(n)).count();
    for triangle in &mesh.triangles {
        for &i in triangle {
            if is_bad(&mesh.normals[i as usize])
                && let Some(n) = face_normal(&mesh.positions, triangle)
            {
                mesh.normals[i as usize] = n.to_array().map(f32_of);
            }
        }
    }
    // Vertices that no triangle uses.
    mesh.normals
        .iter_mut()
        .filter(|n| is_bad(n))
        .for_each(|n| *n = [0.0, 0.0, 1.0]);
    bad
}

/// Whether all are finite, without a branch.
pub(crate) fn is_finite<const N: usize>(numbers: &[f32; N]) -> bool {
    numbers.iter().fold(true, |all, x| all & x.is_finite())
}

/// Whether all are 0, without a branch.
pub(crate) fn is_zero<const N: usize>(numbers: &[f32; N]) -> bool {
    numbers.iter().fold(true, |all, x| all & (*x == 0.0))
}

/// A normal of a triangle, twice as long as its area.
fn twice_area(positions: &[[f32; 3]], triangle: &[u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|i| DVec3::from(positions[i as usize].map(f64::from)));
    (b - a).cross(c - a)
}

/// Unit normal of a triangle, or `None` where it has no area.
fn face_normal(positions: &[[f32; 3]], triangle: &[u32; 3]) -> Option<DVec3> {
    twice_area(positions, triangle).try_normalize()
}

/// Whether [`face_normal`] is `None`, in less time: it is where the square of the length is 0 or not finite.
fn is_flat(positions: &[[f32; 3]], triangle: &[u32; 3]) -> bool {
    let square = twice_area(positions, triangle).length_squared();
    !(square > 0.0 && square < f64::INFINITY)
}

/// Area of a mesh under a transform, in square scene units.
pub(crate) fn area(mesh: &Mesh, to_world: &glam::DMat4) -> f64 {
    let corner =
        |i: u32| to_world.transform_point3(DVec3::from(mesh.positions[i as usize].map(f64::from)));
    let twice = |t: &[u32; 3]| {
        let [a, b, c] = t.map(corner);
        (b - a).cross(c - a).length()
    };
    0.5 * mesh.triangles.iter().map(twice).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad() -> Mesh {
        Mesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2], [2, 3, 0]],
            ..Mesh::default()
        }
    }

    #[test]
    fn triangles_without_area_go() {
        let mut mesh = quad();
        mesh.triangles.push([1, 1, 2]);
        assert_eq!(clean(&mut mesh).unwrap().dropped_triangles, 1);
        assert_eq!(mesh, quad());
        assert_eq!(
            area(&mesh, &glam::DMat4::from_scale(DVec3::splat(3.0))),
            9.0
        );
    }

    #[test]
    fn flat_triangles_are_those_without_a_normal() {
        let sizes = [
            0.0,
            1e-45,
            1e-40,
            3e-23,
            1e-19,
            1e-8,
            1.0,
            1e8,
            1e20,
            f32::MAX,
        ];
        for (x, y) in sizes.iter().flat_map(|x| sizes.map(|y| (*x, y))) {
            for apex in [
                [0.0, y, 0.0],
                [0.5 * x, y, -y],
                [2.0 * x, 0.0, 0.0],
                [x, y, f32::INFINITY],
            ] {
                let positions = [[0.0; 3], [x, 0.0, 0.0], apex];
                let has_normal = face_normal(&positions, &[0, 1, 2]).is_some();
                assert_eq!(
                    is_flat(&positions, &[0, 1, 2]),
                    !has_normal,
                    "{positions:?}"
                );
            }
        }
        let far = [[0.0; 3], [1.0, 1.0, 0.0], [1.0, 0.0, f32::INFINITY]];
        assert_eq!(face_normal(&far, &[0, 1, 2]), None);
        assert!(is_flat(&far, &[0, 1, 2]));
    }

    #[test]
    fn the_first_is_found_wherever_it_is() {
        for count in [0, 1, 300, SERIAL, SERIAL + 1, 5 * SERIAL + 77] {
            let mut flags = vec![false; count];
            assert_eq!(first(&flags, |f| *f), None);
            for at in [
                0,
                255,
                256,
                SERIAL - 1,
                SERIAL,
                4 * SERIAL + 3,
                count - 1.min(count),
            ] {
                if at < count {
                    flags[at] = true;
                    flags[count - 1] = true;
                    assert_eq!(first(&flags, |f| *f), Some(at), "{at} of {count}");
                    flags.fill(false);
                }
            }
        }
    }

    #[test]
    fn normals_that_are_none_become_geometric() {
        let mut mesh = quad();
        mesh.normals = vec![
            [0.0; 3],
            [f32::NAN, 0.0, 1.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, -1.0],
        ];
        assert_eq!(clean(&mut mesh).unwrap().replaced_normals, 2);
        assert_eq!(
            mesh.normals,
            [
                [0.0, 0.0, 1.0],
                [0.0, 0.0, 1.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, -1.0]
            ]
        );
    }

    #[test]
    fn bad_indices_and_vertices_are_errors() {
        let mut mesh = quad();
        mesh.triangles.push([0, 1, 4]);
        assert!(clean(&mut mesh).unwrap_err().contains("triangle 2"));
        let mut mesh = quad();
        mesh.positions[3][1] = f32::INFINITY;
        assert!(clean(&mut mesh).unwrap_err().contains("vertex 3"));
    }
}
