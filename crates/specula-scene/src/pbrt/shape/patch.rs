//! `bilinearmesh`: patches between four corners.

use super::triangles;
use crate::error::SceneError;
use crate::faults::Fault;
use crate::mesh::{self, Cleaning};
use crate::pbrt::context::{Context, Entity};
use crate::scene::{Mesh, PatchMesh};

/// Reads the shape `bilinearmesh`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<PatchMesh, SceneError> {
    // A distribution for sampling alone: it changes no picture.
    entity.params.ignore(&["emissionfilename"]);
    let Mesh {
        positions,
        normals,
        uvs,
        ..
    } = triangles::vertices(context, entity)?;
    let patches = triangles::indices::<4>(entity, positions.len())?;
    Ok(PatchMesh {
        positions,
        normals,
        uvs,
        patches,
        are_polygons: false,
    })
}

/// Makes patches valid as [`mesh::clean_or_name`] does triangles: every patch has area.
///
/// * `collects`: whether to go on after a mistake, as in a check.
///
/// # Errors
///
/// Those of [`mesh::clean_or_name`].
pub(in crate::pbrt) fn clean(
    patches: PatchMesh,
    collects: bool,
) -> Result<(PatchMesh, Cleaning), Vec<Fault>> {
    let PatchMesh {
        positions,
        normals,
        uvs,
        patches,
        are_polygons,
    } = patches;
    // By triangles between the corners, of which bad normals take theirs.
    let corners = |&[a, b, c, d]: &[u32; 4]| [[a, b, d], [a, d, c], [a, b, c], [b, d, c]];
    let mut mesh = Mesh {
        positions,
        normals,
        uvs,
        triangles: patches.iter().flat_map(corners).collect(),
        ..Mesh::default()
    };
    let mut cleaning = mesh::clean_or_name(&mut mesh, collects)?;
    let mut cleaned = PatchMesh {
        positions: mesh.positions,
        normals: mesh.normals,
        uvs: mesh.uvs,
        patches: Vec::new(),
        are_polygons,
    };
    let before = patches.len();
    cleaned.patches = patches;
    cleaned.patches = (cleaned.patches.iter().copied())
        .filter(|p| cleaned.has_area(p))
        .collect();
    cleaning.dropped_triangles = 0;
    cleaning.dropped_patches = before - cleaned.patches.len();
    Ok((cleaned, cleaning))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_without_area_go_and_bad_normals_become_the_patches() {
        let patches = PatchMesh {
            positions: vec![
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [1.0, 1.0, 0.5],
                [2.0, 0.0, 0.0],
            ],
            normals: vec![[0.0; 3]; 5],
            uvs: vec![[f32::NAN; 2]; 5],
            patches: vec![[0, 1, 2, 3], [0, 1, 4, 0], [2, 2, 0, 1]],
            are_polygons: true,
        };
        let (cleaned, cleaning) = clean(patches, false).unwrap();
        assert_eq!(cleaned.patches, [[0, 1, 2, 3], [2, 2, 0, 1]]);
        assert!(cleaned.are_polygons && cleaned.uvs.is_empty() && cleaned.normals[0][2] > 0.5);
        let expected = Cleaning {
            dropped_patches: 1,
            replaced_normals: 5,
            dropped_uvs: true,
            ..Cleaning::default()
        };
        assert_eq!(cleaning, expected);
        let far = PatchMesh {
            positions: vec![[f32::INFINITY, 0.0, 0.0]; 4],
            patches: vec![[0, 1, 2, 3]],
            ..PatchMesh::default()
        };
        assert!(clean(far, true).is_err());
    }
}
