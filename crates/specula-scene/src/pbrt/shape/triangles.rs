//! Vertices and indices of inline meshes; `trianglemesh`.

use rayon::prelude::*;

use super::mesh_error;
use crate::error::SceneError;
use crate::mesh;
use crate::num::f32_of;
use crate::pbrt::context::{Context, Entity};
use crate::scene::Mesh;

/// Reads the shape `trianglemesh`.
pub(super) fn read(context: &mut Context, entity: &Entity) -> Result<Mesh, SceneError> {
    let mut mesh = vertices(context, entity)?;
    mesh.triangles = indices::<3>(entity, mesh.positions.len())?;
    Ok(mesh)
}

/// Vertices and their attributes. As in pbrt-v4, attributes of the wrong number are dropped.
pub(super) fn vertices(context: &mut Context, entity: &Entity) -> Result<Mesh, SceneError> {
    let params = &entity.params;
    let groups = |numbers: Option<&[f64]>| -> Vec<[f32; 3]> {
        numbers
            .map(|n| each(n.as_chunks::<3>().0, |v| v.map(f32_of)))
            .unwrap_or_default()
    };
    let positions = groups(params.numbers("P", &["point3"])?);
    if positions.is_empty() {
        let message = format!("shape \"{}\" needs its vertices, \"point3 P\"", entity.name);
        return Err(mesh_error(entity, "P", message));
    }
    let mut normals = groups(params.numbers("N", &["normal"])?);
    let mut uvs: Vec<[f32; 2]> = match params.numbers("uv", &["point2", "float"])? {
        Some(numbers) => each(numbers.as_chunks::<2>().0, |v| v.map(f32_of)),
        None => Vec::new(),
    };
    for (name, count) in [("N", normals.len()), ("uv", uvs.len())] {
        if count != 0 && count != positions.len() {
            let message = format!(
                "\"{name}\" has {count} values for {} vertices: it is dropped",
                positions.len()
            );
            context.warn(&params.place_of(name), message);
            if name == "N" {
                normals.clear();
            } else {
                uvs.clear();
            }
        }
    }
    // Tangents and numbers of faces change nothing here.
    params.ignore(&["S", "faceIndices"]);
    Ok(Mesh {
        positions,
        normals,
        uvs,
        ..Mesh::default()
    })
}

/// Groups of `N` indices of vertices; where the file has none, `N` vertices are one group.
pub(super) fn indices<const N: usize>(
    entity: &Entity,
    vertices: usize,
) -> Result<Vec<[u32; N]>, SceneError> {
    let name = "indices";
    let Some(numbers) = entity.params.numbers(name, &["integer"])? else {
        if vertices == N {
            return Ok(vec![std::array::from_fn(|i| u32::try_from(i).unwrap_or(0))]);
        }
        let message = format!("shape \"{}\" needs its \"integer indices\"", entity.name);
        return Err(mesh_error(entity, name, message));
    };
    let (groups, rest) = numbers.as_chunks::<N>();
    if !rest.is_empty() {
        let message = format!(
            "\"indices\": expected a multiple of {N} indices, found {}",
            numbers.len()
        );
        return Err(mesh_error(entity, name, message));
    }
    let outside = |x: &f64| !(*x >= 0.0 && *x < vertices as f64);
    if let Some(first) = mesh::first(groups.as_flattened(), outside) {
        let x = numbers[first];
        let message =
            format!("\"indices\": index {x} is out of range; there are {vertices} vertices");
        return Err(mesh_error(entity, name, message));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an integer of i32 that is not negative"
    )]
    Ok(each(groups, |group| group.map(|x| x as u32)))
}

/// Each element, turned into another; of large arrays on all cores.
fn each<T: Sync, U: Send>(elements: &[T], turned: impl Fn(&T) -> U + Send + Sync) -> Vec<U> {
    if elements.len() <= mesh::SERIAL {
        return elements.iter().map(turned).collect();
    }
    let parts = elements.par_iter().with_min_len(mesh::SERIAL);
    parts.map(turned).collect()
}
