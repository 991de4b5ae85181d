//! `Shape`: geometry as the file gives it.

use std::path::PathBuf;
use std::rc::Rc;

use glam::DMat4;

use super::context::{Context, Entity};
use super::param::ParamList;
use super::state::MaterialUse;
use super::token::shorten;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;
use crate::scene::Mesh;

/// A shape with the graphics state that it was met in.
pub(super) struct ShapeEntity {
    pub(super) entity: Entity,
    pub(super) to_world: DMat4,
    pub(super) reverse_orientation: bool,
    pub(super) material: MaterialUse,
    pub(super) area_light: Option<Rc<Entity>>,
}

/// Geometry before files are read and meshes are checked.
pub(super) enum Prepared {
    Mesh(Mesh),
    File(PathBuf),
    Sphere {
        radius: f32,
    },
    Disk {
        radius: f32,
        height: f32,
    },
    /// A kind that is left out, with a warning.
    LeftOut,
}

/// Reads a shape's parameters, except `alpha`.
pub(super) fn prepare(context: &mut Context, entity: &Entity) -> Result<Prepared, SceneError> {
    let params = &entity.params;
    match entity.name.as_str() {
        "trianglemesh" => Ok(Prepared::Mesh(triangles(context, entity)?)),
        "plymesh" => {
            params.ignore(&["edgelength"]);
            if params.find("displacement").is_some() {
                context.warn(
                    &params.place_of("displacement"),
                    "\"displacement\" is not rendered",
                );
            }
            let Some((name, _)) = params.string("filename")? else {
                let message = "shape \"plymesh\" needs its \"string filename\"";
                return Err(SceneError::new(
                    ErrorKind::Parameter,
                    &entity.place,
                    message,
                ));
            };
            Ok(Prepared::File(context.resolve(name)))
        }
        "sphere" => {
            let radius = params.float_above("radius", 1.0, 0.0)?;
            let whole = params.float("zmin", -radius)? <= -radius
                && params.float("zmax", radius)? >= radius
                && params.float("phimax", 360.0)? >= 360.0;
            if !whole {
                context.warn(
                    &entity.place,
                    "a part of a sphere is not supported: the whole is rendered",
                );
            }
            Ok(Prepared::Sphere {
                radius: f32_of(radius),
            })
        }
        "disk" => {
            let radius = f32_of(params.float_above("radius", 1.0, 0.0)?);
            let height = f32_of(params.float("height", 0.0)?);
            if params.float("innerradius", 0.0)? > 0.0 || params.float("phimax", 360.0)? < 360.0 {
                context.warn(
                    &entity.place,
                    "a part of a disk is not supported: the whole is rendered",
                );
            }
            Ok(Prepared::Disk { radius, height })
        }
        "bilinearmesh" => Ok(Prepared::Mesh(patches(context, entity)?)),
        "loopsubdiv" => {
            params.ignore(&["levels", "scheme"]);
            context.warn(
                &entity.place,
                "shape \"loopsubdiv\" is not subdivided: its control mesh is rendered",
            );
            Ok(Prepared::Mesh(triangles(context, entity)?))
        }
        kind @ ("curve" | "cylinder") => {
            context.warn(
                &entity.place,
                format!("shape \"{kind}\" is not supported: it is left out"),
            );
            Ok(Prepared::LeftOut)
        }
        other => {
            let message = format!("unknown shape \"{}\"", shorten(other));
            Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message).with_help(
                    "expected trianglemesh, plymesh, sphere, disk, bilinearmesh or loopsubdiv",
                ),
            )
        }
    }
}

fn mesh_error(entity: &Entity, name: &str, message: String) -> SceneError {
    let place = match entity.params.find(name) {
        Some(param) => param.place.clone(),
        None => entity.place.clone(),
    };
    SceneError::new(ErrorKind::Mesh, &place, message)
}

/// Vertices and their attributes. As in pbrt-v4, attributes of the wrong number are dropped.
fn vertices(
    context: &mut Context,
    params: &ParamList,
    entity: &Entity,
) -> Result<Mesh, SceneError> {
    let groups = |numbers: Option<&[f64]>| -> Vec<[f32; 3]> {
        numbers
            .map(|n| n.as_chunks::<3>().0.iter().map(|v| v.map(f32_of)).collect())
            .unwrap_or_default()
    };
    let positions = groups(params.numbers("P", &["point3"])?);
    if positions.is_empty() {
        let message = format!("shape \"{}\" needs its vertices, \"point3 P\"", entity.name);
        return Err(mesh_error(entity, "P", message));
    }
    let mut normals = groups(params.numbers("N", &["normal"])?);
    let mut uvs: Vec<[f32; 2]> = match params.numbers("uv", &["point2", "float"])? {
        Some(numbers) => numbers
            .as_chunks::<2>()
            .0
            .iter()
            .map(|v| v.map(f32_of))
            .collect(),
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
                normals.clear()
            } else {
                uvs.clear()
            }
        }
    }
    // Tangents and numbers of faces change nothing here.
    params.ignore(&["S", "faceIndices"]);
    Ok(Mesh {
        positions,
        normals,
        uvs,
        triangles: Vec::new(),
    })
}

/// Groups of `N` indices of vertices; `default` where the file has none.
fn indices<const N: usize>(entity: &Entity, vertices: usize) -> Result<Vec<[u32; N]>, SceneError> {
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
    let index = |x: f64| {
        if x >= 0.0 && x < vertices as f64 {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "an integer of i32 that is not negative"
            )]
            return Ok(x as u32);
        }
        let message =
            format!("\"indices\": index {x} is out of range; there are {vertices} vertices");
        Err(mesh_error(entity, name, message))
    };
    groups
        .iter()
        .map(|group| {
            let mut out = [0; N];
            for (o, x) in out.iter_mut().zip(group) {
                *o = index(*x)?;
            }
            Ok(out)
        })
        .collect()
}

fn triangles(context: &mut Context, entity: &Entity) -> Result<Mesh, SceneError> {
    let mut mesh = vertices(context, &entity.params, entity)?;
    mesh.triangles = indices::<3>(entity, mesh.positions.len())?;
    Ok(mesh)
}

/// Bilinear patches `(p00, p10, p01, p11)` as two triangles each.
fn patches(context: &mut Context, entity: &Entity) -> Result<Mesh, SceneError> {
    let params = &entity.params;
    if params.find("emissionfilename").is_some() {
        context.warn(
            &params.place_of("emissionfilename"),
            "\"emissionfilename\" is not rendered",
        );
    }
    let mut mesh = vertices(context, params, entity)?;
    let patches = indices::<4>(entity, mesh.positions.len())?;
    mesh.triangles = patches
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, d], [a, d, c]])
        .collect();
    if mesh.uvs.is_empty() && patches == [[0, 1, 2, 3]] && mesh.positions.len() == 4 {
        mesh.uvs = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    }
    Ok(mesh)
}
