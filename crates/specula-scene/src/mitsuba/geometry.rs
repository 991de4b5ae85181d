//! Meshes: read in parallel, each once, with the normals that Mitsuba would give them.

use std::collections::HashMap;
use std::path::PathBuf;

use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::context::Context;
use crate::curves::{self, CurveBasis};
use crate::error::{ErrorKind, Place, SceneError};
use crate::faults::Fault;
use crate::mesh::{self, Cleaning};
use crate::num::f32_of;
use crate::read_file::Files;
use crate::scene::{Geometry, Mesh, MeshId};
use crate::{obj, ply, serialized};

/// A mesh that is to be read.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum MeshSource {
    Rectangle,
    Cube,
    File {
        path: PathBuf,
        format: Format,
        face_normals: bool,
        flip_v: bool,
    },
    Curves {
        path: PathBuf,
        basis: CurveBasis,
        /// Bits of the matrix that moves control points.
        to_world: [u64; 16],
        is_hair: bool,
    },
}

impl MeshSource {
    /// The file that it comes from.
    fn path(&self) -> Option<&PathBuf> {
        match self {
            Self::Rectangle | Self::Cube => None,
            Self::File { path, .. } | Self::Curves { path, .. } => Some(path),
        }
    }
}

/// A format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Format {
    Obj,
    Ply,
    /// With the number of the mesh in its file.
    Serialized(u32),
}

/// The geometry of a mesh that was read.
#[derive(Clone, Copy, Debug)]
pub(super) struct BuiltGeometry {
    /// `None` where nothing is left of it.
    pub(super) geometry: Option<Geometry>,
    /// Whether its normals come from its triangles: then a mirroring transform turns them over.
    pub(super) own_normals: bool,
}

/// Meshes to be read, in the order of first use.
#[derive(Default)]
pub(super) struct Meshes {
    sources: Vec<(MeshSource, Place)>,
    ids: HashMap<MeshSource, usize>,
}

impl Meshes {
    /// The number of a mesh.
    pub(super) fn ask(&mut self, source: MeshSource, place: &Place) -> usize {
        *self.ids.entry(source.clone()).or_insert_with(|| {
            self.sources.push((source, place.clone()));
            self.sources.len() - 1
        })
    }

    /// Reads them all.
    pub(super) fn read(
        self,
        context: &mut Context,
    ) -> Result<(Vec<BuiltGeometry>, Vec<Mesh>), SceneError> {
        let files = context.access;
        for (source, _) in &self.sources {
            if let Some(path) = source.path() {
                files.announce(path);
            }
        }
        let collects = context.problems.is_check();
        // The order of results is that of the sources, whatever the threads do.
        let results: Vec<_> = self
            .sources
            .par_iter()
            .map(|(source, _)| build(source, files, collects))
            .collect();
        let mut ready = Vec::new();
        let mut meshes = Vec::new();
        for (result, (source, place)) in results.into_iter().zip(&self.sources) {
            let BuiltMesh {
                mesh,
                own_normals,
                cleaning,
            } = match result {
                Ok(built) => built,
                Err(faults) => {
                    for fault in faults {
                        let error = fault_error(context, source, place, &fault);
                        context.problems.record(error)?;
                    }
                    ready.push(BuiltGeometry {
                        geometry: None,
                        own_normals: false,
                    });
                    continue;
                }
            };
            report(context, place, &cleaning, mesh.triangles.is_empty());
            let geometry = (!mesh.triangles.is_empty()).then(|| {
                meshes.push(mesh);
                Geometry::Mesh(MeshId(meshes.len() - 1))
            });
            ready.push(BuiltGeometry {
                geometry,
                own_normals,
            });
        }
        Ok((ready, meshes))
    }
}

struct BuiltMesh {
    mesh: Mesh,
    own_normals: bool,
    cleaning: Cleaning,
}

fn fault_error(context: &Context, source: &MeshSource, place: &Place, fault: &Fault) -> SceneError {
    let Some(path) = source.path() else {
        return SceneError::new(ErrorKind::Mesh, place, fault.to_string());
    };
    let number = match source {
        MeshSource::File {
            format: Format::Serialized(index),
            ..
        } => format!(" ({index})"),
        _ => String::new(),
    };
    let message = format!("mesh {}{number}: {fault}", path.display());
    context.file_error(ErrorKind::Mesh, place, path, message)
}

/// * `collects`: whether to go on after a mistake, as in a check.
fn build(source: &MeshSource, files: &Files, collects: bool) -> Result<BuiltMesh, Vec<Fault>> {
    let plain = |mesh| BuiltMesh {
        mesh,
        own_normals: false,
        cleaning: Cleaning::default(),
    };
    let (path, format, face_normals, flip_v) = match source {
        MeshSource::Rectangle => return Ok(plain(super::primitive::rectangle())),
        MeshSource::Cube => return Ok(plain(super::primitive::cube())),
        MeshSource::Curves {
            path,
            basis,
            to_world,
            is_hair,
        } => {
            let to_world = DMat4::from_cols_array(&to_world.map(f64::from_bits));
            let mut mesh = curves::read(path, *basis, &to_world, *is_hair, files, collects)?;
            let cleaning = mesh::clean_or_name(&mut mesh, collects)?;
            return Ok(BuiltMesh {
                cleaning,
                ..plain(mesh)
            });
        }
        MeshSource::File {
            path,
            format,
            face_normals,
            flip_v,
        } => (path, *format, *face_normals, *flip_v),
    };
    let mut face_normals = face_normals;
    let mut mesh = match format {
        Format::Obj => obj::read(path, files, collects)?,
        Format::Ply => ply::read(path, files, collects)?,
        Format::Serialized(index) => {
            let read = serialized::read(path, index, files).map_err(|m| vec![m.into()])?;
            face_normals |= read.face_normals;
            read.mesh
        }
    };
    if face_normals {
        mesh.normals.clear();
    }
    if flip_v {
        mesh.uvs.iter_mut().for_each(|uv| uv[1] = 1.0 - uv[1]);
    }
    let cleaning = mesh::clean_or_name(&mut mesh, collects)?;
    let own_normals = mesh.normals.is_empty();
    if own_normals && !face_normals {
        mesh.normals = smooth_normals(&mesh);
    }
    Ok(BuiltMesh {
        mesh,
        own_normals,
        cleaning,
    })
}

/// Normals at vertices: those of the triangles around, weighted by their angles there.
///
/// Source: Thürmer and Wüthrich 1998.
fn smooth_normals(mesh: &Mesh) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; mesh.positions.len()];
    let position = |i: u32| DVec3::from(mesh.positions[i as usize].map(f64::from));
    for t in &mesh.triangles {
        let corners = t.map(position);
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
            let (to_b, to_c) = (b - a, c - a);
            if let Some(normal) = to_b.cross(to_c).try_normalize() {
                sums[t[i] as usize] += normal * to_b.angle_between(to_c);
            }
        }
    }
    let unit = |v: DVec3| v.try_normalize().unwrap_or(DVec3::Z);
    sums.into_iter()
        .map(|v| unit(v).to_array().map(f32_of))
        .collect()
}

fn report(context: &mut Context, place: &Place, cleaning: &Cleaning, empty: bool) {
    if empty {
        context.warn(
            place,
            "the mesh has no triangles with an area: it is left out",
        );
        return;
    }
    for message in cleaning.messages() {
        context.warn(place, message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_weighted_by_angles() {
        // A corner of a cube: the side cut into two triangles must not count twice.
        let mesh = Mesh {
            positions: vec![
                [0.0; 3],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
            ],
            triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]],
            ..Mesh::default()
        };
        let [x, y, z] = smooth_normals(&mesh)[0];
        assert!((x - y).abs() < 1e-6 && (y - z).abs() < 1e-6, "{x} {y} {z}");
    }
}
