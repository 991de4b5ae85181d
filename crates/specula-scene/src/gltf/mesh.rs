//! Meshes: the triangles of each primitive.

use gltf::Semantic;
use gltf::mesh::Mode;

use super::Reader;
use super::deform::{Deformation, Vertices};
use super::material::Appearance;
use crate::error::{ErrorKind, SceneError};
use crate::mesh;
use crate::scene::{Mesh, MeshId};

/// Colours without what is negative or no number.
fn not_negative(mut colours: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
    for x in colours.iter_mut().flatten() {
        *x = if *x > 0.0 { *x } else { 0.0 };
    }
    colours
}

impl Reader<'_> {
    /// The meshes and appearances of a mesh's primitives.
    pub(super) fn primitives(
        &mut self,
        mesh: &gltf::Mesh<'_>,
        deformation: Option<&Deformation>,
    ) -> Result<Vec<(MeshId, Appearance)>, SceneError> {
        let mut found = Vec::new();
        for primitive in mesh.primitives() {
            let what = format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
            let read = self.primitive(&what, &primitive, deformation);
            found.extend(self.problems.or(read, || None)?);
        }
        Ok(found)
    }

    fn primitive(
        &mut self,
        what: &str,
        primitive: &gltf::Primitive<'_>,
        deformation: Option<&Deformation>,
    ) -> Result<Option<(MeshId, Appearance)>, SceneError> {
        if matches!(
            primitive.mode(),
            Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
        ) {
            self.warn(format!("{what}: points and lines are left out"));
            return Ok(None);
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else {
            self.warn(format!("{what}: it has no positions and is left out"));
            return Ok(None);
        };
        let coloured = primitive.get(&Semantic::Colors(0)).is_some();
        let look = self.look(&primitive.material(), coloured)?;
        let count = positions.count();
        // A check names what is wrong with each attribute.
        let mut is_damaged = false;
        let positions = self.floats::<3>(&format!("{what}.POSITION"), &positions);
        let positions = self.or_none(positions, &mut is_damaged)?;
        let triangles = self.triangles(what, primitive, count);
        let triangles = self.or_none(triangles, &mut is_damaged)?;
        let normals = self.attribute::<3>(what, primitive, Semantic::Normals, count);
        let normals = self.or_none(normals, &mut is_damaged)?;
        let mut sets = [Vec::new(), Vec::new()];
        for (uvs, set) in sets.iter_mut().zip(look.sets) {
            if let Some(set) = set {
                let values = self.attribute::<2>(what, primitive, Semantic::TexCoords(set), count);
                let values = self.or_none(values, &mut is_damaged)?;
                *uvs = values.into_iter().map(|[u, v]| [u, 1.0 - v]).collect();
            }
        }
        let [uvs, second_uvs] = sets;
        let mut tangents = Vec::new();
        if look.tangents && !normals.is_empty() {
            let values = self.attribute::<4>(what, primitive, Semantic::Tangents, count);
            tangents = self.or_none(values, &mut is_damaged)?;
        }
        let colours = self.attribute::<3>(what, primitive, Semantic::Colors(0), count);
        let colours = self.or_none(colours, &mut is_damaged)?;
        if is_damaged {
            return Ok(None);
        }
        let mut vertices = Vertices::new(positions, normals, tangents);
        if let Some(deformation) = deformation {
            self.deform(what, primitive, deformation, &mut vertices)?;
        }
        let mut mesh = Mesh {
            positions: vertices.positions,
            normals: vertices.normals,
            uvs,
            second_uvs,
            tangents: vertices.tangents,
            colours: not_negative(colours),
            triangles,
            is_fibre: false,
        };
        match mesh::clean(&mut mesh) {
            Ok(cleaning) => {
                for message in cleaning.messages() {
                    self.warn(format!("{what}: {message}"));
                }
            }
            Err(message) => {
                self.warn(format!("{what}: {message}; it is left out"));
                return Ok(None);
            }
        }
        self.meshes.push(mesh);
        Ok(Some((MeshId(self.meshes.len() - 1), look)))
    }

    /// What was read, or nothing where its error is recorded; `is_damaged` says which.
    fn or_none<T: Default>(
        &self,
        read: Result<T, SceneError>,
        is_damaged: &mut bool,
    ) -> Result<T, SceneError> {
        self.problems.or(read, || {
            *is_damaged = true;
            T::default()
        })
    }

    /// An attribute for each of `count` vertices; empty where there is none.
    fn attribute<const N: usize>(
        &mut self,
        what: &str,
        primitive: &gltf::Primitive<'_>,
        semantic: Semantic,
        count: usize,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let Some(accessor) = primitive.get(&semantic) else {
            return Ok(Vec::new());
        };
        let name = semantic.to_string();
        let values = self.floats::<N>(&format!("{what}.{name}"), &accessor)?;
        if values.len() != count {
            self.warn(format!(
                "{what}.{name}: expected {count} elements, found {}; they are left out",
                values.len()
            ));
            return Ok(Vec::new());
        }
        Ok(values)
    }

    fn triangles(
        &self,
        what: &str,
        primitive: &gltf::Primitive<'_>,
        count: usize,
    ) -> Result<Vec<[u32; 3]>, SceneError> {
        let indices = match primitive.indices() {
            Some(accessor) => self.indices(&format!("{what}.indices"), &accessor)?,
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
        };
        if let Some(index) = indices.iter().find(|i| **i as usize >= count) {
            let message = format!("{what}.indices: vertex {index} does not exist, of {count}");
            return Err(self.error(ErrorKind::Mesh, message));
        }
        let windows = || indices.windows(3).enumerate();
        Ok(match primitive.mode() {
            Mode::TriangleStrip => windows()
                .map(|(i, w)| match i % 2 {
                    0 => [w[0], w[1], w[2]],
                    _ => [w[1], w[0], w[2]],
                })
                .collect(),
            Mode::TriangleFan => windows().map(|(_, w)| [indices[0], w[1], w[2]]).collect(),
            _ => indices
                .chunks_exact(3)
                .map(|c| [c[0], c[1], c[2]])
                .collect(),
        })
    }
}
