//! Meshes that morph targets and skins deform.
//!
//! Source: glTF 2.0, sections 3.7.2.2 (morph targets) and 3.7.3 (skins).

use glam::{DMat3, DMat4, DVec3};
use gltf::Semantic;

use super::Reader;
use crate::error::{ErrorKind, SceneError};
use crate::num::f32_of;

/// What deforms the mesh of a node.
pub(super) struct Deformation {
    /// Weights of the morph targets.
    pub(super) weights: Vec<f64>,
    pub(super) pose: Option<Pose>,
}

/// Where the joints of a skin hold a mesh.
pub(super) struct Pose {
    /// By joint: from the mesh's space to the world.
    pub(super) joints: Vec<DMat4>,
    /// That of the node, for vertices that no joint holds.
    pub(super) node: DMat4,
}

/// What of a mesh is deformed, by vertex; empty where it has none.
pub(super) struct Vertices {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    /// As of [`Mesh`](crate::scene::Mesh).
    pub(super) tangents: Vec<[f32; 4]>,
}

/// Joints and weights of a vertex, four at a time.
type JointSet = (Vec<[f32; 4]>, Vec<[f32; 4]>);

impl Deformation {
    /// Whether a mesh keeps its shape.
    pub(super) fn is_none(&self) -> bool {
        self.pose.is_none() && self.weights.iter().all(|w| *w == 0.0)
    }
}

impl Pose {
    /// The space of a vertex: that of its joints, by weight.
    fn at(&self, vertex: usize, sets: &[JointSet]) -> DMat4 {
        let mut sum = DMat4::ZERO;
        let mut total = 0.0;
        for (joints, weights) in sets {
            for (joint, weight) in joints[vertex].iter().zip(weights[vertex]) {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "checked to be indices"
                )]
                let joint = self.joints[*joint as usize];
                let weight = f64::from(weight);
                if weight > 0.0 && weight.is_finite() {
                    sum += joint * weight;
                    total += weight;
                }
            }
        }
        if total > 0.0 {
            sum * (1.0 / total)
        } else {
            self.node
        }
    }
}

impl Vertices {
    pub(super) fn new(
        positions: Vec<[f32; 3]>,
        normals: Vec<[f32; 3]>,
        tangents: Vec<[f32; 4]>,
    ) -> Self {
        Self {
            positions,
            normals,
            tangents,
        }
    }

    /// Takes a vertex to another space.
    fn transform(&mut self, i: usize, space: &DMat4) {
        let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        let narrow = |v: DVec3| v.to_array().map(f32_of);
        let linear = DMat3::from_mat4(*space);
        self.positions[i] = narrow(space.transform_point3(wide(self.positions[i])));
        if let Some(normal) = self.normals.get_mut(i) {
            let inverse = linear.inverse();
            // Joints that press a limb flat leave it no inverse.
            let of_normals = if inverse.is_finite() {
                inverse.transpose()
            } else {
                linear
            };
            *normal = narrow((of_normals * wide(*normal)).normalize_or_zero());
        }
        if let Some([x, y, z, sign]) = self.tangents.get_mut(i) {
            [*x, *y, *z] = narrow((linear * wide([*x, *y, *z])).normalize_or_zero());
            if linear.determinant() < 0.0 {
                *sign = -*sign;
            }
        }
    }
}

/// Adds what a morph target moves, by its weight.
fn add<const N: usize>(values: &mut [[f32; N]], moves: &[[f32; 3]], weight: f64) {
    for (value, by) in values.iter_mut().zip(moves) {
        for (x, by) in value.iter_mut().zip(by) {
            *x = f32_of(f64::from(*x) + weight * f64::from(*by));
        }
    }
}

impl Reader<'_> {
    /// Deforms the vertices of a primitive: morph targets first, then the skin, which takes them to the world.
    ///
    /// # Errors
    ///
    /// Where an attribute is damaged, or names a joint that is not there.
    pub(super) fn deform(
        &mut self,
        what: &str,
        primitive: &gltf::Primitive<'_>,
        deformation: &Deformation,
        vertices: &mut Vertices,
    ) -> Result<(), SceneError> {
        let count = vertices.positions.len();
        self.deformed = self.deformed.saturating_add(count as u64);
        let most = self.limits.max_vertices;
        if self.deformed > most {
            let message =
                format!("{what}: more than {most} vertices are deformed (`max_vertices`)");
            return Err(self.error(ErrorKind::Limit, message));
        }
        for (k, (target, weight)) in primitive
            .morph_targets()
            .zip(&deformation.weights)
            .enumerate()
        {
            if *weight == 0.0 {
                continue;
            }
            let what = format!("{what}.targets[{k}]");
            let read = |name: &str, accessor: Option<gltf::Accessor<'_>>| {
                accessor.map_or(Ok(Vec::new()), |a| {
                    self.vectors::<3>(&format!("{what}.{name}"), &a, count)
                })
            };
            let positions = read("POSITION", target.positions())?;
            let normals = read("NORMAL", target.normals())?;
            let tangents = read("TANGENT", target.tangents())?;
            add(&mut vertices.positions, &positions, *weight);
            add(&mut vertices.normals, &normals, *weight);
            add(&mut vertices.tangents, &tangents, *weight);
        }
        let Some(pose) = &deformation.pose else {
            return Ok(());
        };
        let sets = self.joint_sets(what, primitive, vertices.positions.len(), pose)?;
        if sets.is_empty() {
            self.warn(format!("{what}: no joint of its skin holds it"));
        }
        for i in 0..vertices.positions.len() {
            let space = pose.at(i, &sets);
            vertices.transform(i, &space);
        }
        Ok(())
    }

    /// The joints and weights of a primitive's vertices.
    fn joint_sets(
        &self,
        what: &str,
        primitive: &gltf::Primitive<'_>,
        count: usize,
        pose: &Pose,
    ) -> Result<Vec<JointSet>, SceneError> {
        let mut sets = Vec::new();
        for set in 0.. {
            let Some(joints) = primitive.get(&Semantic::Joints(set)) else {
                break;
            };
            let name = format!("{what}.JOINTS_{set}");
            let Some(weights) = primitive.get(&Semantic::Weights(set)) else {
                let message = format!("{name}: expected WEIGHTS_{set} with it");
                return Err(self.error(ErrorKind::Mesh, message));
            };
            let joints = self.vectors::<4>(&name, &joints, count)?;
            let weights = self.vectors::<4>(&format!("{what}.WEIGHTS_{set}"), &weights, count)?;
            let most = pose.joints.len();
            let is_one = |joint: f32| joint >= 0.0 && (joint as f64) < most as f64;
            if let Some(joint) = joints.iter().flatten().find(|joint| !is_one(**joint)) {
                let message = format!("{name}: joint {joint} does not exist, of {most}");
                return Err(self.error(ErrorKind::Mesh, message));
            }
            sets.push((joints, weights));
        }
        Ok(sets)
    }

    /// Exactly `count` vectors.
    fn vectors<const N: usize>(
        &self,
        what: &str,
        accessor: &gltf::Accessor<'_>,
        count: usize,
    ) -> Result<Vec<[f32; N]>, SceneError> {
        let values = self.floats::<N>(what, accessor)?;
        if values.len() == count {
            return Ok(values);
        }
        let message = format!("{what}: expected {count} elements, found {}", values.len());
        Err(self.error(ErrorKind::Mesh, message))
    }

    /// By joint of a skin, from the mesh's space to that of the joint: the inverse matrices of its binding.
    ///
    /// # Errors
    ///
    /// Where there are fewer than joints, or they are damaged.
    pub(super) fn binding(&self, skin: &gltf::Skin<'_>) -> Result<Vec<DMat4>, SceneError> {
        let joints = skin.joints().count();
        let Some(accessor) = skin.inverse_bind_matrices() else {
            return Ok(vec![DMat4::IDENTITY; joints]);
        };
        let what = format!("skins[{}].inverseBindMatrices", skin.index());
        let matrices = self.floats::<16>(&what, &accessor)?;
        if matrices.len() < joints {
            let found = matrices.len();
            let message = format!("{what}: expected {joints} matrices, found {found}");
            return Err(self.error(ErrorKind::Mesh, message));
        }
        let matrices = matrices.into_iter().take(joints);
        Ok(matrices
            .map(|m| DMat4::from_cols_array(&m.map(f64::from)))
            .collect())
    }
}
