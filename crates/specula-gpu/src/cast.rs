//! Rays alone through a scene: what traversal costs without anything else, and whether it hits what it should.

use specula_render::PreparedScene;

use crate::adapter::{Gpu, GpuError};
use crate::compute::{Arrays, ComputeKernel};
use crate::error::TracerError;
use crate::program;
use crate::queries::{Rays, Structures};
use crate::tree::Tree;

/// A ray: origin, direction of any length, end in lengths of the direction, 1 where any hit will do and else 0.
pub type RayWords = [f32; 8];

/// What a ray hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Distance in lengths of the direction.
    pub t: f32,
    /// Barycentric weights of the second and third corner.
    pub barycentrics: [f32; 2],
    /// Index within the group.
    pub primitive: u32,
    /// Which instance; `None`: the ray hit nothing.
    pub instance: Option<u32>,
}

/// A scene's rays on a device.
#[derive(Debug)]
pub struct RayCaster<'a> {
    gpu: &'a Gpu,
    kernel: ComputeKernel,
    /// Nodes, triangles, words.
    scene: [Vec<u8>; 3],
}

/// Rays that have been uploaded, with room for their hits.
#[derive(Debug)]
pub struct RayBatch {
    arrays: Arrays,
    workgroups: u32,
}

impl<'a> RayCaster<'a> {
    /// Compiles the scene's rays.
    ///
    /// # Errors
    /// Where ray queries are asked for and cannot be had, or the device fails.
    pub fn new(gpu: &'a Gpu, scene: &PreparedScene, rays: Rays) -> Result<Self, TracerError> {
        let mut flat = scene.flatten();
        let tree = Tree::new(&mut flat);
        let structures = Structures::chosen(rays, gpu, scene)?;
        let shader = gpu.shader("rays", &program::rays(&flat, structures.is_some()))?;
        let kernel = match &structures {
            None => ComputeKernel::new(gpu, &shader, "cast_main", 4),
            Some(structures) => {
                ComputeKernel::with_structures(gpu, &shader, "cast_main", 4, structures)
            }
        }?;
        // Bindings must not be empty.
        let filled = |bytes: &[u8]| match bytes {
            [] => vec![0; 16],
            bytes => bytes.to_vec(),
        };
        let words = bytemuck::cast_slice(&flat.words);
        Ok(Self {
            gpu,
            kernel,
            scene: [tree.nodes(), tree.triangles(), words].map(filled),
        })
    }

    /// Uploads rays.
    ///
    /// # Errors
    /// Those of the device.
    pub fn upload(&self, rays: &[RayWords]) -> Result<RayBatch, GpuError> {
        let [nodes, triangles, words] = self.scene.each_ref().map(Vec::as_slice);
        let inputs = [bytemuck::cast_slice(rays), nodes, triangles, words];
        let size = size_of::<[u32; 5]>() as u64 * rays.len() as u64;
        Ok(RayBatch {
            arrays: self.kernel.upload(self.gpu, &inputs, size)?,
            workgroups: u32::try_from(rays.len().div_ceil(64)).unwrap_or(u32::MAX),
        })
    }

    /// Casts the rays and waits.
    ///
    /// # Errors
    /// Those of the device.
    pub fn cast(&self, batch: &RayBatch) -> Result<(), GpuError> {
        let workgroups = [batch.workgroups, 1, 1];
        self.kernel.run(self.gpu, &batch.arrays, workgroups)
    }

    /// What the rays hit.
    ///
    /// # Errors
    /// Those of the device.
    pub fn hits(&self, batch: &RayBatch) -> Result<Vec<RayHit>, GpuError> {
        let bytes = batch.arrays.output(self.gpu)?;
        let words: Vec<[u32; 5]> = bytemuck::pod_collect_to_vec(&bytes);
        let hit = |[t, u, v, primitive, instance]: [u32; 5]| RayHit {
            t: f32::from_bits(t),
            barycentrics: [u, v].map(f32::from_bits),
            primitive,
            instance: (instance != u32::MAX).then_some(instance),
        };
        Ok(words.into_iter().map(hit).collect())
    }
}
