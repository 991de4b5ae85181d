//! Meshes and pictures: read, made and checked in parallel, each once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::context::Context;
use super::shape::{Built, Prepared, Recipe, ShapeEntity, prepare};
use crate::error::{ErrorKind, Place, SceneError};
use crate::faults::Fault;
use crate::image::Image;
use crate::mesh::Cleaning;
use crate::ply;
use crate::read_file::Files;
use crate::scene::{CurveMesh, CurveMeshId, Geometry, Mesh, MeshId, PatchMesh, PatchMeshId};
use crate::triangulate::ExactMeshes;

/// Geometry of a shape, with what its light needs to know.
#[derive(Clone, Copy)]
pub(super) struct ShapeGeometry {
    /// `None` where the shape is left out.
    pub(super) geometry: Option<Geometry>,
    /// Quadrilaterals beside triangles, of the same shape.
    pub(super) beside: Option<Geometry>,
    /// How many shapes pbrt-v4 makes of it; `None` for one per triangle.
    pub(super) pieces: Option<usize>,
}

/// Where a mesh comes from.
enum MeshSource {
    Mesh(Mesh),
    File(PathBuf),
    Recipe(Recipe),
}

impl MeshSource {
    fn path(&self) -> Option<PathBuf> {
        match self {
            Self::File(path) => Some(path.clone()),
            Self::Mesh(_) | Self::Recipe(_) => None,
        }
    }
}

/// A mesh to be read, made or checked, and the first place that asks for it.
struct Job {
    source: MeshSource,
    place: Place,
}

/// A shape's geometry before meshes are read.
enum Slot {
    Job(usize),
    Ready(Geometry),
    /// A shape with a mistake.
    Nothing,
}

/// Meshes to be read, without repetition.
#[derive(Default)]
struct Jobs {
    list: Vec<Job>,
    files: HashMap<PathBuf, usize>,
}

impl Jobs {
    fn add(&mut self, source: MeshSource, place: &Place) -> usize {
        self.list.push(Job {
            source,
            place: place.clone(),
        });
        self.list.len() - 1
    }

    fn file(&mut self, path: PathBuf, place: &Place) -> usize {
        if let Some(&job) = self.files.get(&path) {
            return job;
        }
        let job = self.add(MeshSource::File(path.clone()), place);
        self.files.insert(path, job);
        job
    }

    /// Leaves out what takes long.
    fn forget_subdivisions(&mut self) {
        for job in &mut self.list {
            if matches!(job.source, MeshSource::Recipe(Recipe::Subdivision(_))) {
                job.source = MeshSource::Mesh(Mesh::default());
            }
        }
    }
}

/// The meshes of a scene.
#[derive(Default)]
pub(super) struct Meshes {
    pub(super) triangles: Vec<Mesh>,
    pub(super) patches: Vec<PatchMesh>,
    pub(super) curves: Vec<CurveMesh>,
}

impl Meshes {
    fn add(&mut self, made: Built) -> Geometry {
        match made {
            Built::Mesh(mesh) => {
                self.triangles.push(mesh);
                Geometry::Mesh(MeshId(self.triangles.len() - 1))
            }
            Built::Patches(mesh) => {
                self.patches.push(mesh);
                Geometry::Patches(PatchMeshId(self.patches.len() - 1))
            }
            Built::Curves(curves) => {
                self.curves.push(curves);
                Geometry::Curves(CurveMeshId(self.curves.len() - 1))
            }
        }
    }

    /// Triangles, and what exact shapes refer to.
    pub(super) fn split(&mut self) -> (&mut Vec<Mesh>, ExactMeshes<'_>) {
        let exact = ExactMeshes {
            patches: &self.patches,
            curves: &self.curves,
        };
        (&mut self.triangles, exact)
    }
}

/// Reads and checks all meshes and all pictures that the context was asked for.
///
/// * `is_hair`: whether a shape's material is hair.
pub(super) fn read(
    context: &mut Context,
    shapes: &[&ShapeEntity],
    is_hair: impl Fn(&ShapeEntity) -> bool,
) -> Result<(Vec<ShapeGeometry>, Meshes), SceneError> {
    let mut jobs = Jobs::default();
    let mut slots = Vec::with_capacity(shapes.len());
    let mut left = context.files.limits().max_subdivided;
    for shape in shapes {
        let entity = &shape.entity;
        let mut pieces = None;
        let prepared = prepare(context, entity).map(Some);
        let Some(prepared) = entity.or(prepared, || None)? else {
            slots.push((Slot::Nothing, pieces));
            continue;
        };
        let slot = match prepared {
            Prepared::Ready(geometry) => Slot::Ready(geometry),
            Prepared::Mesh(mesh) => Slot::Job(jobs.add(MeshSource::Mesh(mesh), &entity.place)),
            Prepared::File(path) => {
                context.files.announce(&path);
                let name = entity.params.string("filename").ok().flatten();
                let place = name.map_or(&entity.place, |(_, place)| place);
                Slot::Job(jobs.file(path, place))
            }
            Prepared::Recipe(mut recipe) => {
                recipe.set_hair(is_hair(shape));
                if let Err(message) = recipe.take_from(&mut left, context.files.limits()) {
                    let error = SceneError::new(ErrorKind::Mesh, &entity.place, message);
                    context.problems.record(error)?;
                    // A check is not to take longer than a render.
                    jobs.forget_subdivisions();
                    slots.push((Slot::Nothing, pieces));
                    continue;
                }
                pieces = recipe.pieces();
                Slot::Job(jobs.add(MeshSource::Recipe(recipe), &entity.place))
            }
        };
        slots.push((slot, pieces));
    }
    let files = context.files.clone();
    let collects = context.problems.is_check();
    let pictures = context.take_image_jobs();
    let search = context.search.clone();
    let places: Vec<(Place, Option<PathBuf>)> = jobs
        .list
        .iter()
        .map(|job| (job.place.clone(), job.source.path()))
        .collect();
    // The order of results is that of the jobs, whatever the threads do.
    let (results, images) = rayon::join(
        || -> Vec<_> {
            let list = jobs.list.into_par_iter();
            list.map(|j| make(j.source, &files, collects)).collect()
        },
        || -> Vec<_> {
            let pictures = pictures.par_iter();
            pictures.map(|p| p.read(&files, &search)).collect()
        },
    );
    for image in images {
        let image = context.problems.or(image, Image::stand_in)?;
        context.images.push(image);
    }
    let mut meshes = Meshes::default();
    let mut ids = Vec::new();
    for (result, (place, path)) in results.into_iter().zip(&places) {
        let parts = match result {
            Ok(parts) => parts,
            Err(faults) => {
                for fault in faults {
                    let error = broken(context, place, path.as_deref(), &fault);
                    context.problems.record(error)?;
                }
                ids.push([None; 2]);
                continue;
            }
        };
        let mut found = [None; 2];
        for (id, (made, cleaning)) in found.iter_mut().zip(parts) {
            report(context, place, &cleaning, made.is_empty());
            *id = (!made.is_empty()).then(|| meshes.add(made));
        }
        ids.push(found);
    }
    Ok((geometries(slots, &ids), meshes))
}

/// The geometries of shapes, from those of the jobs.
fn geometries(
    slots: Vec<(Slot, Option<usize>)>,
    of_jobs: &[[Option<Geometry>; 2]],
) -> Vec<ShapeGeometry> {
    let resolved = slots.into_iter().map(|(slot, pieces)| {
        let [first, second] = match slot {
            Slot::Job(i) => of_jobs[i],
            Slot::Ready(geometry) => [Some(geometry), None],
            Slot::Nothing => [None; 2],
        };
        ShapeGeometry {
            geometry: first.or(second),
            beside: first.and(second),
            pieces,
        }
    });
    resolved.collect()
}

/// The error of the scene for a mistake in a mesh.
fn broken(context: &Context, place: &Place, path: Option<&Path>, fault: &Fault) -> SceneError {
    let Some(path) = path else {
        return SceneError::new(ErrorKind::Mesh, place, fault.to_string());
    };
    let message = format!("mesh {}: {fault}", path.display());
    SceneError::new(ErrorKind::Mesh, place, message).if_missing(context.search.hint(path), path)
}

/// Makes a mesh, or of a file with quadrilaterals that are no parallelograms two, or patches alone.
///
/// * `collects`: whether to go on after a mistake, as in a check.
fn make(
    source: MeshSource,
    files: &Files,
    collects: bool,
) -> Result<Vec<(Built, Cleaning)>, Vec<Fault>> {
    let made = match source {
        MeshSource::Mesh(mesh) => vec![Built::Mesh(mesh)],
        MeshSource::Recipe(recipe) => {
            vec![recipe.build(files.limits()).map_err(|m| vec![m.into()])?]
        }
        MeshSource::File(path) => {
            let mut polygons = ply::read_polygons(&path, files, collects)?;
            // pbrt-v4 ignores colours of vertices.
            polygons.mesh.colours = Vec::new();
            match polygons.split() {
                (mesh, None) => vec![Built::Mesh(mesh)],
                (mesh, Some(patches)) if mesh.triangles.is_empty() => vec![Built::Patches(patches)],
                (mesh, Some(patches)) => vec![Built::Mesh(mesh), Built::Patches(patches)],
            }
        }
    };
    made.into_iter().map(|m| m.clean(collects)).collect()
}

fn report(context: &mut Context, place: &Place, cleaning: &Cleaning, empty: bool) {
    if empty {
        let message = match (cleaning.dropped_triangles, cleaning.dropped_patches) {
            (0, 0) if cleaning.dropped_segments > 0 => {
                "no segment of the curve has a length and a width: it is left out".to_owned()
            }
            (0, 0) => "the mesh has no triangles: it is left out".to_owned(),
            (0, n) => format!("all {n} patches of the mesh have no area: it is left out"),
            (n, _) => format!("all {n} triangles of the mesh have no area: it is left out"),
        };
        context.warn(place, message);
        return;
    }
    for message in cleaning.messages() {
        context.warn(place, message);
    }
}
