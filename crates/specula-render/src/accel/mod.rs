//! Ray casting: bounding volume hierarchies of 8-wide nodes over triangles, quadrics, bilinear
//! patches and curves.
//!
//! ```text
//! Group (object space) --> pairs of triangles --> binary tree (obvhs) --> 8-wide nodes, packets of 8 triangles
//! Instance (Group, to_world) --------------------> 8-wide nodes over instances, if needed
//! ```
//!
//! What can be relied on:
//!
//! - **The same answer everywhere.** The AVX2 kernel and the portable one do the same operations in
//!   the same order, without fused multiply-add: their hits are equal bit for bit. Large groups are
//!   built in chunks, which are a function of the input alone: the tree never depends on the number
//!   of threads.
//! - **Ties.** Of hits with equal `t` the smallest `(instance, primitive)` wins, whatever the order
//!   of traversal; in small scenes, among primitives that are tested alike.
//! - **No leaks.** A ray from inside a closed mesh hits it: `triangle.rs`, `patch.rs`, `rectangle.rs` and
//!   `parallelepiped.rs` have the arguments.
//! - **A batch is its rays one by one.** Batches in small scenes (`brute_force.rs`), of coherent rays (`tree_packs.rs`) and
//!   of incoherent ones in large trees (`interleaved.rs`) are computed otherwise, with the same hits bit for bit.
//! - **It cannot fail.** Rays that are not finite hit nothing; indices are checked at build.

mod ball;
mod binary;
mod block;
mod bounds;
mod brute_force;
mod chunks;
mod clusters;
mod collapse;
mod curve;
mod flat;
mod frame;
mod frustum;
mod group;
mod input;
mod instances;
mod interleaved;
mod kernel;
mod moving;
mod node;
mod pack;
mod parallelepiped;
mod parallelogram;
mod patch;
mod predicted;
mod quadric;
mod rectangle;
mod traverse;
mod tree_packs;
mod triangle;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(test)]
mod tests;

pub(crate) use block::{BLOCK, BlockHits, RayBlock};
pub use bounds::Bounds;
pub use curve::{CurveSegment, CurveShape};
pub use input::{AccelError, Group, Instance};
pub(crate) use predicted::predicted;
pub use quadric::{Quadric, QuadricShape};
pub(crate) use triangle::has_area;

#[cfg(target_arch = "x86_64")]
use avx2::Avx2;
use brute_force::SmallScene;
use collapse::Tree;
use group::GroupTree;
use instances::Placement;
use kernel::Portable;
use rayon::prelude::*;
use specula_bsdf::Vec3;
use traverse::Scene;

use crate::convert::id;
use crate::movement::Movement;

/// A ray, `origin + t direction` for `t` in `(0, t_max)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins. The caller has already moved it off the surface that it leaves.
    pub origin: Vec3<f32>,
    /// Its direction, of any length but 0: `t` counts in this length.
    pub direction: Vec3<f32>,
    /// The exclusive end; may be infinite.
    pub t_max: f32,
}

/// The first hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Ray parameter, in `(0, t_max)`.
    pub t: f32,
    /// Barycentric weight of the triangle's second vertex; 0 for quadrics; of patches and curves the coordinate u.
    ///
    /// The point of a triangle is `(1 - u - v) p0 + u p1 + v p2`, in the group's space.
    pub u: f32,
    /// Barycentric weight of the triangle's third vertex; 0 for quadrics; of patches and curves the coordinate v.
    pub v: f32,
    /// Index within the group: its triangles first, then its quadrics, its patches and its segments of curves, each in
    /// input order.
    pub primitive: u32,
    /// Index of the instance in the list given to [`Accel::build`].
    pub instance: u32,
}

/// The instructions that a structure is traversed with. The answers are the same bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instructions {
    /// Plain Rust, left to the compiler to vectorise.
    Portable,
    /// AVX2 (x86-64 of 2013 or later).
    Avx2,
}

/// What a structure consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AccelStats {
    /// Triangles that can be hit, over all groups (those without area are left out).
    pub triangles: usize,
    /// Spheres and disks, over all groups.
    pub quadrics: usize,
    /// Bilinear patches that can be hit, over all groups.
    pub patches: usize,
    /// Segments of curves, over all groups.
    pub curves: usize,
    /// Parts of segments that can be hit, over all groups.
    pub curve_parts: usize,
    /// 8-wide nodes, of 256 bytes.
    pub nodes: usize,
    /// Packets of at most 8 triangles, of 320 bytes.
    pub packets: usize,
    /// Levels of 8-wide nodes of the deepest tree.
    pub depth: usize,
    /// Memory of nodes, packets, quadrics, patches, curves and instances.
    pub bytes: usize,
}

/// An acceleration structure over instances of groups of triangles, quadrics, bilinear patches and curves.
///
/// # Examples
///
/// ```
/// use specula_bsdf::math::vec3;
/// use specula_render::accel::{Accel, Group, Instance, Ray};
///
/// let group = Group {
///     positions: &[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
///     triangles: &[[0, 1, 2]],
///     ..Group::default()
/// };
/// let accel = Accel::build(&[group], &[Instance::of(0)])?;
/// let ray = Ray {
///     origin: vec3(0.25, 0.25, 0.0),
///     direction: vec3(0.0, 0.0, 1.0),
///     t_max: f32::INFINITY,
/// };
/// assert_eq!(accel.intersect(&ray).map(|hit| hit.t), Some(1.0));
/// assert!(accel.occluded(&ray));
/// # Ok::<(), specula_render::accel::AccelError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Accel {
    scene: Scene,
    /// A copy for `brute_force`, where the scene is small.
    small: Option<SmallScene>,
    bounds: Option<Bounds>,
    kernel: KernelChoice,
    stats: AccelStats,
}

/// The kernel in use. [`Avx2`] exists only where the machine has it.
#[derive(Clone, Copy, Debug)]
enum KernelChoice {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
}

impl Accel {
    /// Builds the trees of the groups (in parallel, in rayon's current pool) and of the instances.
    ///
    /// Triangles, patches and curves without area or with a point that is not finite are left out. Indices of the others
    /// stay as they are.
    ///
    /// # Errors
    ///
    /// [`AccelError`] where an index is out of range, a transform is singular or not finite, or
    /// there are more primitives than indices.
    pub fn build(groups: &[Group<'_>], instances: &[Instance]) -> Result<Self, AccelError> {
        Self::build_moving(groups, instances, &[])
    }

    /// [`Accel::build`] of instances some of which move.
    ///
    /// * `movements`: indices of instances, ascending, and how they move, which takes the place of their transforms.
    pub(crate) fn build_moving(
        groups: &[Group<'_>],
        instances: &[Instance],
        movements: &[(u32, &Movement)],
    ) -> Result<Self, AccelError> {
        input::check(groups, instances)?;
        let built: Vec<_> = groups.par_iter().map(GroupTree::build).collect();
        let mut scene = Scene::default();
        let triangles = built.iter().flatten().map(|g| g.triangles).sum();
        let trees: Vec<Option<Tree>> = built
            .into_iter()
            .map(|group| group.map(|g| g.append(&mut scene)))
            .collect();
        let placed: Vec<Placement> = (0..)
            .zip(instances)
            .filter_map(|(index, instance)| {
                let tree = trees[instance.group as usize].as_ref()?;
                let placed = Placement::new(index, instance, tree);
                Some(match movements.binary_search_by_key(&index, |m| m.0) {
                    Ok(i) => placed.moving(movements[i].1, id(i), tree),
                    Err(_) => placed,
                })
            })
            .collect();
        let bounds = placed.iter().map(|p| p.bounds).reduce(|a, b| a.union(&b));
        let mut depth = trees.iter().flatten().map(|t| t.depth).max().unwrap_or(0);
        if let [only] = placed.as_slice()
            && only.identity
        {
            scene.root = Some(only.root);
            scene.single = Some(only.instance);
        } else if let Some(tree) = instances::build(&placed, &mut scene) {
            depth = depth.max(tree.depth);
            scene.root = Some(tree.root);
            scene.placements = placed;
            scene.movements = movements.iter().map(|(_, m)| (*m).clone()).collect();
        }
        Ok(Self {
            bounds,
            small: SmallScene::new(&scene),
            kernel: KernelChoice::best(),
            stats: AccelStats {
                triangles,
                quadrics: scene.quadrics.len(),
                patches: scene.patches.len(),
                curves: scene.curves.len(),
                curve_parts: scene.curve_parts.len(),
                nodes: scene.nodes.len(),
                packets: scene.packets.len(),
                depth,
                bytes: size_of_val(scene.nodes.as_slice())
                    + size_of_val(scene.packets.as_slice())
                    + size_of_val(scene.quadrics.as_slice())
                    + size_of_val(scene.patches.as_slice())
                    + size_of_val(scene.curves.as_slice())
                    + size_of_val(scene.curve_parts.as_slice())
                    + size_of_val(scene.placements.as_slice()),
            },
            scene,
        })
    }

    /// The first hit of the ray.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        if let Some(small) = self.small_with_own_tests() {
            return small.intersect_one(ray);
        }
        match self.kernel {
            KernelChoice::Portable => traverse::intersect(Portable, &self.scene, ray),
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.intersect(&self.scene, ray),
        }
    }

    /// Whether the ray hits any surface: whether [`Accel::intersect`] returns a hit, but faster.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        if let Some(small) = self.small_with_own_tests() {
            return small.occluded_one(ray);
        }
        match self.kernel {
            KernelChoice::Portable => traverse::occluded(Portable, &self.scene, ray),
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.occluded(&self.scene, ray),
        }
    }

    #[inline(always)]
    fn small_with_own_tests(&self) -> Option<&SmallScene> {
        self.small.as_ref().filter(|small| small.has_own_tests())
    }

    /// [`Accel::intersect`] of each ray, in order: the same answers, but faster for many rays.
    pub fn intersect_all(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        if let Some(small) = &self.small {
            return small.intersect(rays, hits);
        }
        for rays in rays.chunks(BLOCK) {
            self.intersect_in_tree((&RayBlock::of(rays), rays.len()), hits);
        }
    }

    /// Of a small scene the primitives at each place, one of them twice where there is one, and the instance.
    pub(crate) fn small_primitives(&self) -> Option<(Vec<[u32; 2]>, u32)> {
        self.small.as_ref().map(SmallScene::primitives)
    }

    /// The closest hits of the first `n` rays of a block.
    pub(crate) fn intersect_block(&self, (rays, n): (&RayBlock, usize), hits: &mut BlockHits) {
        match &self.small {
            Some(small) => small.intersect_block(rays, n, &mut hits.small),
            None => {
                hits.hits.clear();
                self.intersect_in_tree((rays, n), &mut hits.hits);
            }
        }
    }

    /// Appends the hits of rays.
    fn intersect_in_tree(&self, (rays, n): (&RayBlock, usize), hits: &mut Vec<Option<Hit>>) {
        let first = hits.len();
        hits.resize(first + n, None);
        let (scene, hits) = (&self.scene, &mut hits[first..]);
        match self.kernel {
            KernelChoice::Portable => {
                let groups = tree_packs::intersect(Portable, scene, (rays, n), hits);
                interleaved::intersect(Portable, scene, (rays, n, groups), hits);
            }
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.intersect_block(scene, (rays, n), hits),
        }
    }

    /// [`Accel::occluded`] of each ray, in order: the same answers, but faster for many rays.
    pub fn occluded_all(&self, rays: &[Ray], occluded: &mut Vec<bool>) {
        occluded.clear();
        if let Some(small) = &self.small {
            return small.occluded(rays, occluded);
        }
        for rays in rays.chunks(BLOCK) {
            self.occluded_in_tree((&RayBlock::of(rays), rays.len()), occluded);
        }
    }

    /// Whether the first `n` rays of a block hit anything.
    pub(crate) fn occluded_block(&self, (rays, n): (&RayBlock, usize), occluded: &mut Vec<bool>) {
        occluded.clear();
        match &self.small {
            Some(small) => {
                occluded.resize(n, false);
                small.occluded_block(rays, occluded);
            }
            None => self.occluded_in_tree((rays, n), occluded),
        }
    }

    /// Appends whether rays hit anything.
    fn occluded_in_tree(&self, (rays, n): (&RayBlock, usize), occluded: &mut Vec<bool>) {
        let first = occluded.len();
        occluded.resize(first + n, false);
        let (scene, occluded) = (&self.scene, &mut occluded[first..]);
        match self.kernel {
            KernelChoice::Portable => {
                let groups = tree_packs::occluded(Portable, scene, (rays, n), occluded);
                interleaved::occluded(Portable, scene, (rays, n, groups), occluded);
            }
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(kernel) => kernel.occluded_block(scene, (rays, n), occluded),
        }
    }

    /// A box around everything in the world, a little larger than it; `None` where there is nothing.
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// What the structure consists of.
    pub fn stats(&self) -> AccelStats {
        self.stats
    }

    /// The instructions in use: the best that the machine has, unless chosen otherwise.
    pub fn instructions(&self) -> Instructions {
        match self.kernel {
            KernelChoice::Portable => Instructions::Portable,
            #[cfg(target_arch = "x86_64")]
            KernelChoice::Avx2(_) => Instructions::Avx2,
        }
    }

    /// The same structure with the portable kernel, for comparison.
    #[must_use]
    pub fn portable(mut self) -> Self {
        self.kernel = KernelChoice::Portable;
        self
    }
}

impl KernelChoice {
    fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(kernel) = Avx2::detect() {
            return Self::Avx2(kernel);
        }
        Self::Portable
    }
}
