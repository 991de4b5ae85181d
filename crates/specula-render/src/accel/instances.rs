//! Groups placed in the world, and the tree over them.

use glam::{DAffine3, DMat4, DVec3};
use specula_bsdf::{Real, Vec3};
use specula_scene::bounds::BoundingBox;

use super::collapse::{self, Tree};
use super::node::{Child, ChildKind};
use super::traverse::Scene;
use super::{Bounds, Instance, Ray};
use crate::movement::Movement;

/// An instance, ready for rays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    to_group: DAffine3,
    /// The root of the group's tree.
    pub(super) root: Child,
    /// Index in the input.
    pub(super) instance: u32,
    /// Whether rays enter the group unchanged.
    pub(super) identity: bool,
    /// Index of how it moves in [`Scene::movements`]; beyond their end where it does not.
    pub(super) movement: u32,
    /// In the world.
    pub(super) bounds: Bounds,
}

impl Placement {
    /// * `instance`: has been checked.
    pub(super) fn new(index: u32, instance: &Instance, tree: &Tree) -> Self {
        let identity = instance.to_world == DMat4::IDENTITY;
        let to_world = DAffine3::from_mat4(instance.to_world);
        Self {
            to_group: to_world.inverse(),
            root: tree.root,
            instance: index,
            identity,
            movement: u32::MAX,
            bounds: if identity {
                tree.bounds
            } else {
                transformed(&tree.bounds, &to_world)
            },
        }
    }

    /// One that moves, as `movement`, which is that of this index; it is where the shutter opens.
    pub(super) fn moving(self, movement: &Movement, index: u32, tree: &Tree) -> Self {
        Self {
            to_group: DAffine3::from_mat4(movement.at(0.0)).inverse(),
            identity: false,
            movement: index,
            bounds: swept(&tree.bounds, movement),
            ..self
        }
    }

    /// The group's space from the world's.
    pub(super) fn group_space(&self) -> &DAffine3 {
        &self.to_group
    }

    /// The ray in the group's space, with the same `t`.
    #[inline(always)]
    pub(super) fn enter(&self, ray: &Ray) -> Ray {
        enter(&self.to_group, ray)
    }
}

/// The ray in a group's space, with the same `t`.
#[inline(always)]
fn enter(to_group: &DAffine3, ray: &Ray) -> Ray {
    let wide = |v: Vec3<f32>| DVec3::from_array(v.to_array().map(f64::from));
    let narrow = |v: DVec3| Vec3::from(v.to_array().map(f32::of));
    Ray {
        origin: narrow(to_group.transform_point3(wide(ray.origin))),
        direction: narrow(to_group.transform_vector3(wide(ray.direction))),
        t_max: ray.t_max,
    }
}

/// The ray in the space of a group that moves, at a time.
pub(super) fn enter_moving(movement: &Movement, time: f32, ray: &Ray) -> Ray {
    enter(&DAffine3::from_mat4(movement.at(time)).inverse(), ray)
}

/// Builds the tree over the instances; `None` where there are none.
pub(super) fn build(placed: &[Placement], scene: &mut Scene) -> Option<Tree> {
    if placed.is_empty() {
        return None;
    }
    let items: Vec<Bounds> = placed.iter().map(|p| p.bounds).collect();
    let tree = collapse::build(
        &items,
        |_| 0,
        &mut scene.nodes,
        |leaf| Child::new(ChildKind::PatchOrPlacement, leaf[0] as usize),
    );
    Some(tree)
}

/// The box around a transformed box: centre and half extents, the latter through `|A|`.
///
/// Padded by the error that rounding the ray in the group's space may cause near the box.
fn transformed(bounds: &Bounds, to_world: &DAffine3) -> Bounds {
    let (min, max) = (
        DVec3::from_array(bounds.min.map(f64::from)),
        DVec3::from_array(bounds.max.map(f64::from)),
    );
    let centre = to_world.transform_point3((min + max) * 0.5);
    let m = to_world.matrix3;
    let half = (max - min) * 0.5;
    let extent = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
    around(centre, extent)
}

/// The box around all places of a box that moves, padded likewise.
fn swept(bounds: &Bounds, movement: &Movement) -> Bounds {
    let [min, max] = [bounds.min, bounds.max].map(|p| DVec3::from_array(p.map(f64::from)));
    let swept = movement.swept(BoundingBox { min, max });
    around(swept.centre(), (swept.max - swept.min) * 0.5)
}

fn around(centre: DVec3, extent: DVec3) -> Bounds {
    let pad = (extent.max_element() + centre.abs().max_element()) * 1e-6;
    Bounds {
        min: (centre - extent - pad).to_array().map(f32::of),
        max: (centre + extent + pad).to_array().map(f32::of),
    }
    .padded(0.0)
}
