//! Flat arrays of everything that rays can hit, and the surface at a hit.
//!
//! Shapes of the world are baked into one group in world space; every object that is instanced is
//! a group of its own. Orientation is baked too: a triangle's winding is such that
//! `(p1 - p0) x (p2 - p0)` points to its outside. The outside is pbrt's: the winding's side,
//! flipped by `ReverseOrientation`, travelling with the shape under mirroring transforms; where the
//! mesh has vertex normals, the side that they point to. Spheres and disks follow the same rule
//! (outwards, and +z). pbrt itself turns the hits, though not the light samples, of mirrored
//! spheres and disks inside out; Specula does not.

mod bake;
mod flat;
mod footprint;
mod hit;
mod partials;

use glam::DMat4;
use rayon::prelude::*;
use specula_bsdf::Vec3;
use specula_bsdf::math::vec3;
use specula_scene::scene::{ColourParam, FloatParam, Scene};

use crate::accel::{Accel, AccelError, Group, Hit, Instance, Quadric, QuadricShape};
use crate::convert::{Affine, id, narrow3, normal_matrix, widen3};
use crate::texture::Textures;
use bake::Baker;

pub(crate) use hit::{PrimitiveLocation, Surface};
pub(crate) use partials::Partials;

/// No light.
pub(crate) use crate::codes::NONE;

/// Largest coordinate of a shape: squares of lengths, and their products with areas, are within
/// `f32`.
pub(crate) const FARTHEST: f32 = 1e15;

/// What the primitives of a shape share.
#[derive(Clone, Debug)]
pub(crate) struct ShapeRecord {
    pub(crate) material: u32,
    /// Emitted radiance; black where it does not emit.
    pub(crate) radiance: ColourParam,
    pub(crate) two_sided: bool,
    /// Opacity, where it is not 1 everywhere.
    pub(crate) alpha: Option<FloatParam>,
    /// Whether it is no surface but the boundary of a medium.
    pub(crate) is_interface: bool,
    has_uvs: bool,
}

/// A sphere or a disk in its group.
#[derive(Clone, Debug)]
pub(crate) struct PlacedQuadric {
    pub(crate) shape: QuadricShape,
    pub(crate) to_group: DMat4,
    forward: Affine,
    backward: Affine,
    normals: Affine,
    /// Whether the outside is the inside.
    pub(crate) flipped: bool,
}

/// Triangles and quadrics in one space. Primitives are numbered triangles first.
#[derive(Clone, Debug, Default)]
pub(crate) struct GroupData {
    pub(crate) positions: Vec<[f32; 3]>,
    /// Zero where a mesh has none; empty where no mesh has any.
    normals: Vec<[f32; 3]>,
    /// As `normals`.
    uvs: Vec<[f32; 2]>,
    /// As `normals`.
    second_uvs: Vec<[f32; 2]>,
    /// As `normals`: in the group's space, with the sign of `normal x tangent` there.
    tangents: Vec<[f32; 4]>,
    /// White where a mesh has none; empty where no mesh has any or no texture shows them.
    colours: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) quadrics: Vec<PlacedQuadric>,
    /// Shape of every primitive.
    pub(crate) shape_of: Vec<u32>,
    /// Index of every primitive among the group's lights, or [`NONE`]; ends with the last light.
    light_of: Vec<u32>,
    /// Primitives that emit, by that index.
    pub(crate) emitters: Vec<u32>,
}

/// Memory of a quadric in its group, with its shape's index.
pub(crate) const BYTES_PER_QUADRIC: u64 =
    (size_of::<PlacedQuadric>() + size_of::<Quadric>() + 8 + size_of::<ShapeRecord>()) as u64;

/// Memory of an instance, with its share of the tree over instances.
pub(crate) const BYTES_PER_INSTANCE: u64 =
    (size_of::<Placement>() + size_of::<Instance>() + 24) as u64;

/// A group, placed in the world: an instance.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    pub(crate) group: u32,
    pub(crate) transform: DMat4,
    inverse: DMat4,
    to_world: Affine,
    normals: Affine,
    identity: bool,
    /// Index of the group's first light in the world's list.
    pub(crate) first_light: u32,
}

/// Everything that rays can hit.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    pub(crate) accel: Accel,
    pub(crate) groups: Vec<GroupData>,
    pub(crate) placements: Vec<Placement>,
    pub(crate) shapes: Vec<ShapeRecord>,
    /// Whether rays pass any shape: it has an opacity, or is an interface.
    pub(crate) has_passable: bool,
}

impl Geometry {
    /// Bakes the scene's shapes and builds the tree over them.
    ///
    /// * `scene`: left without its shapes, objects, and the meshes that were baked.
    /// * `earlier`: geometry whose tree is taken over, if it is over the same shapes.
    pub(crate) fn after(
        scene: &mut Scene,
        textures: &Textures,
        earlier: Option<Self>,
    ) -> Result<Self, AccelError> {
        let mut baker = Baker::new(scene, textures);
        let world = std::mem::take(&mut baker.world);
        let mut groups = vec![baker.bake(world)];
        let mut group_of = vec![None; baker.objects.len()];
        let mut placements = vec![Placement::new(0, DMat4::IDENTITY)];
        for (object, to_world) in std::mem::take(&mut baker.instances) {
            let group = *group_of[object].get_or_insert_with(|| {
                let shapes = std::mem::take(&mut baker.objects[object]);
                groups.push(baker.bake(shapes));
                id(groups.len() - 1)
            });
            placements.push(Placement::new(group, to_world));
        }
        let shapes = baker.records;
        // A lone group needs no tree over instances: an empty world group must not make it one of two.
        placements.retain(|p| !groups[p.group as usize].shape_of.is_empty());
        let mut lights = 0;
        for p in &mut placements {
            p.first_light = lights;
            lights += id(groups[p.group as usize].emitters.len());
        }
        let same = earlier.filter(|e| e.has_shapes_of(&groups, &placements));
        let accel = match same {
            Some(earlier) => earlier.accel,
            None => build_accel(&groups, &placements)?,
        };
        let passable = |s: &ShapeRecord| s.alpha.is_some() || s.is_interface;
        let has_passable = shapes.iter().any(passable);
        Ok(Self {
            accel,
            groups,
            placements,
            shapes,
            has_passable,
        })
    }
}

impl Geometry {
    /// Whether its acceleration structure is that of these groups and instances.
    fn has_shapes_of(&self, groups: &[GroupData], placements: &[Placement]) -> bool {
        let place = |p: &Placement| (p.group, p.transform);
        self.groups.len() == groups.len()
            && (self.placements.iter().map(place)).eq(placements.iter().map(place))
            && (self.groups.iter().zip(groups)).all(|(a, b)| {
                a.positions == b.positions
                    && a.triangles == b.triangles
                    && (a.quadrics.iter().map(PlacedQuadric::in_tree))
                        .eq(b.quadrics.iter().map(PlacedQuadric::in_tree))
            })
    }

    /// The group of a hit.
    #[inline(always)]
    pub(crate) fn group_of(&self, hit: &Hit) -> &GroupData {
        let placement = &self.placements[hit.instance as usize];
        &self.groups[placement.group as usize]
    }

    /// Whether all shapes, in the world and in the space of their group, are near enough for rays.
    pub(crate) fn is_within_reach(&self) -> bool {
        let near = |p: &[f32; 3]| p.iter().all(|x| x.abs() <= FARTHEST);
        let world = self.accel.bounds();
        world.is_none_or(|b| near(&b.min) && near(&b.max))
            && self.groups.iter().all(|g| {
                g.positions.par_iter().with_min_len(1 << 14).all(near)
                    && g.quadrics.iter().all(|q| q.reach() <= f64::from(FARTHEST))
            })
    }
}

fn build_accel(groups: &[GroupData], placements: &[Placement]) -> Result<Accel, AccelError> {
    let quadrics: Vec<Vec<Quadric>> = groups
        .iter()
        .map(|g| g.quadrics.iter().map(PlacedQuadric::in_tree).collect())
        .collect();
    let inputs: Vec<Group<'_>> = groups
        .iter()
        .zip(&quadrics)
        .map(|(g, quadrics)| Group {
            positions: &g.positions,
            triangles: &g.triangles,
            quadrics,
        })
        .collect();
    let instances: Vec<Instance> = placements
        .iter()
        .map(|p| Instance {
            group: p.group,
            to_world: p.transform,
        })
        .collect();
    Accel::build(&inputs, &instances)
}

impl GroupData {
    /// Index of a primitive among the group's lights, or [`NONE`].
    #[inline(always)]
    pub(crate) fn light_of(&self, primitive: u32) -> u32 {
        self.light_of
            .get(primitive as usize)
            .copied()
            .unwrap_or(NONE)
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn corners(&self, primitive: u32) -> [Vec3<f32>; 3] {
        self.triangles[primitive as usize].map(|v| Vec3::from(self.positions[v as usize]))
    }
}

impl PlacedQuadric {
    /// The quadric as the acceleration structure takes it.
    fn in_tree(&self) -> Quadric {
        Quadric {
            shape: self.shape,
            to_group: self.to_group,
        }
    }

    /// A bound on its coordinates.
    fn reach(&self) -> f64 {
        let (radius, height) = match self.shape {
            QuadricShape::Sphere { radius } => (radius, 0.0),
            QuadricShape::Disk { radius, height } => (radius, height.abs()),
        };
        let m = &self.to_group;
        let axes = [m.x_axis, m.y_axis, m.z_axis].map(|a| a.truncate().length());
        m.w_axis.truncate().length() + axes.iter().sum::<f64>() * radius.max(height)
    }
}

impl Placement {
    fn new(group: u32, transform: DMat4) -> Self {
        Self {
            group,
            transform,
            inverse: transform.inverse(),
            to_world: Affine::new(&transform),
            normals: Affine::linear(&normal_matrix(&transform)),
            identity: transform == DMat4::IDENTITY,
            first_light: 0,
        }
    }
}

/// The corner of a parallelogram and its two neighbours, where two triangles of the same winding make
/// one: in winding order about the outside.
pub(crate) fn parallelogram([one, other]: [[Vec3<f32>; 3]; 2]) -> Option<[Vec3<f32>; 3]> {
    let lone = (0..3).find(|&i| !other.contains(&one[i]))?;
    let [corner, next, last] = [0, 1, 2].map(|i| one[(lone + i) % 3]);
    let opposite = (0..3).find(|&i| other[i] != next && other[i] != last)?;
    // The two triangles traverse the shared edge in opposite directions.
    if other[(opposite + 1) % 3] != last || other[(opposite + 2) % 3] != next {
        return None;
    }
    let gap = (other[opposite] - last) - (next - corner);
    let size = (next - corner).length().max((last - corner).length());
    (gap.length() <= 1e-6 * size).then_some([corner, next, last])
}

/// The unit vector along `v`, without overflow or underflow; `fallback` for the zero vector and for
/// what is not finite.
#[inline(always)]
pub(crate) fn unit_or(v: Vec3<f32>, fallback: Vec3<f32>) -> Vec3<f32> {
    let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
    if !(largest > 0.0 && largest.is_finite()) {
        return fallback;
    }
    // Two steps: the reciprocal of a subnormal number overflows.
    let v = vec3(v.x / largest, v.y / largest, v.z / largest);
    v.normalize()
}

/// The unit normal of a triangle by two of its edges; `+z` where it has no area.
#[inline(always)]
pub(crate) fn normal_of(e1: Vec3<f32>, e2: Vec3<f32>) -> Vec3<f32> {
    /// Below, components lose digits.
    const LEAST: f32 = 1e-30;
    let n = e1.cross(e2);
    let largest = n.x.abs().max(n.y.abs()).max(n.z.abs());
    if largest > LEAST && largest.is_finite() {
        return unit_or(n, Vec3::Z);
    }
    let n = widen3(e1).cross(widen3(e2)).normalize_or_zero();
    unit_or(narrow3(n), Vec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_of_every_size_have_a_normal() {
        let (a, b) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 0.6, 0.8));
        for scale in [1e-37, 1e-25, 1e-12, 1.0, 1e12, 1e25, 1e37] {
            let n = normal_of(a * scale, b * scale);
            assert!((n - vec3(0.0, -0.8, 0.6)).length() < 1e-6, "{scale}: {n:?}");
        }
        assert_eq!(normal_of(a, a), Vec3::Z);
        assert_eq!(normal_of(Vec3::ZERO, b), Vec3::Z);
    }
}
