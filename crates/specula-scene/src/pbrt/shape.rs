//! `Shape`: geometry as the file gives it.

mod curve;
mod heightfield;
mod nurbs;
mod patch;
mod quadric;
mod revolved;
mod subdivision;
mod triangles;

use std::path::PathBuf;
use std::rc::Rc;

use glam::DMat4;

use super::context::{Context, Entity};
use super::medium::Sides;
use super::state::MaterialUse;
use crate::Limits;
use crate::error::{ErrorKind, SceneError};
use crate::faults::Fault;
use crate::mesh::{self, Cleaning};
use crate::num::shorten;
use crate::scene::{CurveKind, CurveMesh, FloatParam, Geometry, Mesh, PatchMesh};

/// A shape with its graphics state.
pub(super) struct ShapeEntity {
    pub(super) entity: Entity,
    pub(super) to_world: DMat4,
    /// That of the end, where it moves.
    pub(super) end: Option<DMat4>,
    pub(super) reverse_orientation: bool,
    pub(super) material: MaterialUse,
    pub(super) media: Sides,
    pub(super) area_light: Option<Rc<Entity>>,
}

/// Geometry before files are read and meshes are checked.
pub(super) enum Prepared {
    Mesh(Mesh),
    File(PathBuf),
    Recipe(Recipe),
    Ready(Geometry),
}

/// A mesh that is still to be made: this may take a while, and is done in parallel.
pub(super) enum Recipe {
    Curves(CurveMesh),
    Patches(PatchMesh),
    Revolved(revolved::Revolved),
    Subdivision(subdivision::Control),
}

impl Recipe {
    /// Tells it whether it is of hair, as which curves differ.
    pub(super) fn set_hair(&mut self, is_hair: bool) {
        if let Self::Curves(curves) = self {
            curves.is_fibre = is_hair && curves.kind != CurveKind::Ribbon;
        }
    }

    /// The mesh or the curves; patches that are parallelograms, as triangles.
    pub(super) fn build(self, limits: &Limits) -> Result<Built, String> {
        let mesh = match self {
            Self::Curves(curves) => return Ok(Built::Curves(curves)),
            Self::Patches(patches) if patches.is_flat() => patches.mesh(),
            Self::Patches(patches) => return Ok(Built::Patches(patches)),
            Self::Revolved(revolved) => revolved.build(),
            Self::Subdivision(control) => control.build(limits)?,
        };
        Ok(Built::Mesh(mesh))
    }

    /// Takes what it is subdivided into from the scene's budget.
    pub(super) fn take_from(&self, left: &mut u64, limits: &Limits) -> Result<(), String> {
        match self {
            Self::Subdivision(control) => control.take_from(left, limits),
            Self::Revolved(_) | Self::Curves(_) | Self::Patches(_) => Ok(()),
        }
    }

    /// How many shapes pbrt-v4 makes of it.
    pub(super) fn pieces(&self) -> Option<usize> {
        match self {
            Self::Revolved(_) => Some(1),
            Self::Patches(mesh) => Some(mesh.patches.len()),
            Self::Curves(curves) => Some(curves.segments.len()),
            Self::Subdivision(_) => None,
        }
    }
}

/// What a recipe makes.
pub(super) enum Built {
    Mesh(Mesh),
    Patches(PatchMesh),
    Curves(CurveMesh),
}

impl Built {
    /// [`mesh::clean_or_name`] of it.
    pub(super) fn clean(self, collects: bool) -> Result<(Self, Cleaning), Vec<Fault>> {
        match self {
            Self::Mesh(mut mesh) => {
                let cleaning = mesh::clean_or_name(&mut mesh, collects)?;
                Ok((Self::Mesh(mesh), cleaning))
            }
            Self::Patches(patches) => {
                let (patches, cleaning) = patch::clean(patches, collects)?;
                Ok((Self::Patches(patches), cleaning))
            }
            Self::Curves(curves) => {
                let (curves, cleaning) = curve::clean(curves);
                Ok((Self::Curves(curves), cleaning))
            }
        }
    }

    /// Whether nothing is left of it.
    pub(super) fn is_empty(&self) -> bool {
        match self {
            Self::Mesh(mesh) => mesh.triangles.is_empty(),
            Self::Patches(mesh) => mesh.patches.is_empty(),
            Self::Curves(curves) => curves.segments.is_empty(),
        }
    }
}

/// `value` holds where `size` may not exceed the limit of meshes.
pub(super) fn bounded<T>(value: T, size: u64, limits: &Limits) -> Result<T, String> {
    let most = limits.max_vertices;
    if size <= most {
        return Ok(value);
    }
    Err(format!(
        "its mesh would have {size} triangles; at most {most} are made (`max_vertices`)"
    ))
}

/// Reads a shape's parameters, except `alpha`.
pub(super) fn prepare(context: &mut Context, entity: &Entity) -> Result<Prepared, SceneError> {
    let params = &entity.params;
    match entity.name.as_str() {
        "trianglemesh" => Ok(Prepared::Mesh(triangles::read(context, entity)?)),
        "plymesh" => {
            params.ignore(&["edgelength"]);
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
        "sphere" | "disk" | "cylinder" => Ok(Prepared::Ready(quadric::read(entity)?)),
        // Those of pbrt-v3, which tell that a file is one of it.
        "cone" | "paraboloid" | "hyperboloid" => Ok(Prepared::Recipe(Recipe::Revolved(
            revolved::Revolved::read(entity)?,
        ))),
        "heightfield" => Ok(Prepared::Mesh(heightfield::read(entity)?)),
        "nurbs" => Ok(Prepared::Mesh(nurbs::read(entity)?)),
        "bilinearmesh" => Ok(Prepared::Recipe(Recipe::Patches(patch::read(
            context, entity,
        )?))),
        "loopsubdiv" => {
            let control = subdivision::Control::read(context, entity)?;
            Ok(Prepared::Recipe(Recipe::Subdivision(control)))
        }
        "curve" => Ok(Prepared::Recipe(Recipe::Curves(curve::read(
            context, entity,
        )?))),
        other => {
            let message = format!("unknown shape \"{}\"", shorten(other));
            Err(
                SceneError::new(ErrorKind::Parameter, &entity.place, message).with_help(
                    "expected trianglemesh, plymesh, sphere, disk, cylinder, bilinearmesh, curve \
                     or loopsubdiv",
                ),
            )
        }
    }
}

/// The texture by which a mesh is to be displaced.
pub(super) fn displacement(
    context: &mut Context,
    entity: &Entity,
) -> Result<Option<FloatParam>, SceneError> {
    if entity.name != "plymesh" || entity.params.find("displacement").is_none() {
        return Ok(None);
    }
    let message = "\"displacement\" of a mesh is rendered as bumps: its outline stays smooth";
    context.warn(&entity.params.place_of("displacement"), message);
    context.float_or_none(&entity.params, "displacement")
}

fn mesh_error(entity: &Entity, name: &str, message: String) -> SceneError {
    let place = match entity.params.find(name) {
        Some(param) => param.place.clone(),
        None => entity.place.clone(),
    };
    SceneError::new(ErrorKind::Mesh, &place, message)
}
