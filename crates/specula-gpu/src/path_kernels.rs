//! The kernels that take samples: a thread follows a path to its end, or wavefronts go from vertex to vertex in queues.

use specula_render::FlatScene;
use wgpu::BufferUsages as Usages;

use crate::adapter::{Gpu, GpuError};
use crate::program;
use crate::scene_program::SceneProgram;
use crate::schedule::QUEUE_ARRAYS;
use crate::shader::{Shader, Slot};
use crate::stage::{RayBindings, Stage, array, layout, submit};

/// Bytes of a sample on the device.
pub(crate) const SAMPLE_SIZE: u64 = SceneProgram::SAMPLE_SIZE;
/// Bytes of a field of a path between two kernels.
const FIELD_SIZE: u64 = 16;
/// Bytes before the queues: `QUEUE_HEAD` in queue.wgsl.
const HEAD_SIZE: u64 = 12;
/// Arrays that are only read: those of the scene, and the requested runs.
const READ: u32 = 5;
/// Arrays of a kernel that follows whole paths.
const PATH_ARRAYS: u32 = 6;
/// Vertices of paths in queues that are submitted at once. Few paths are longer; whether one is, is read back before
/// more are submitted.
const VERTICES_AT_ONCE: u32 = 16;

/// Bytes of a path between two kernels: `QUEUE_FIELDS` in queue_state.wgsl.
pub(crate) fn state_size(flat: &FlatScene<'_>) -> u64 {
    let has = |name| u64::from(flat.constant(name) == Some(1));
    FIELD_SIZE * (10 + 6 * has("HAS_BOUNDARIES") + has("TEXTURES_ARE_FILTERED"))
}

/// The kernels that take samples.
#[derive(Clone, Debug)]
pub(crate) enum PathKernels {
    /// One for a whole path.
    Paths(Stage),
    /// One for each part of a path.
    Queues(Box<Queues>),
}

/// The kernels of paths in queues.
#[derive(Clone, Debug)]
pub(crate) struct Queues {
    begin: Stage,
    trace: Stage,
    shade: Stage,
    connect: Stage,
    compact: Stage,
    advance: Stage,
    /// Most vertices of a path.
    most: u32,
    /// Bytes of a path between two kernels.
    state_size: u64,
}

/// The kernels with their arrays.
#[derive(Debug)]
pub(crate) enum BoundKernels {
    Paths(Stage, wgpu::BindGroup),
    Queues(Box<Queues>, QueueArrays),
}

/// Arrays of paths in queues.
#[derive(Debug)]
pub(crate) struct QueueArrays {
    group: wgpu::BindGroup,
    advance_group: wgpu::BindGroup,
    compact_group: wgpu::BindGroup,
    slots: wgpu::Buffer,
    workgroups: wgpu::Buffer,
}

impl PathKernels {
    /// * `shader`: the scene's.
    /// * `structures`: of ray queries; `None`: rays are traversed by the shader.
    /// * `state_size`: of the scene, by [`state_size`].
    pub(crate) fn new(
        gpu: &Gpu,
        shader: &Shader,
        is_queues: bool,
        structures: Option<&RayBindings>,
        (max_depth, state_size): (u32, u64),
    ) -> Result<Self, GpuError> {
        let slot = |binding| Slot {
            binding,
            is_written: binding >= READ,
        };
        if !is_queues {
            let arrays = layout(gpu, (0..PATH_ARRAYS).map(slot))?;
            let stage = Stage::new(gpu, &arrays, shader, SceneProgram::ENTRY, structures)?;
            return Ok(Self::Paths(stage));
        }
        let arrays = layout(gpu, (0..QUEUE_ARRAYS).map(slot))?;
        let between = gpu.shader("queue advance", program::QUEUE_ADVANCE)?;
        let stage = |entry, arrays| {
            let slots = (0..arrays).map(|binding| Slot {
                binding,
                is_written: true,
            });
            Stage::new(gpu, &layout(gpu, slots)?, &between, entry, None)
        };
        Ok(Self::Queues(Box::new(Queues {
            begin: Stage::new(gpu, &arrays, shader, "queue_begin", None)?,
            trace: Stage::new(gpu, &arrays, shader, "queue_trace", structures)?,
            shade: Stage::new(gpu, &arrays, shader, "queue_shade", None)?,
            connect: Stage::new(gpu, &arrays, shader, "queue_connect", structures)?,
            compact: stage("queue_advance_compact", 1)?,
            advance: stage("queue_advance_main", 2)?,
            most: max_depth.saturating_add(1),
            state_size,
        })))
    }

    /// Bytes of a sample in the largest array.
    pub(crate) fn sample_size(&self) -> u64 {
        match self {
            Self::Paths(_) => SAMPLE_SIZE,
            Self::Queues(queues) => queues.state_size,
        }
    }

    /// The kernels with arrays for so many samples.
    ///
    /// * `arrays`: those of the scene, the requested runs, the results.
    pub(crate) fn with_capacity(
        &self,
        gpu: &Gpu,
        arrays: &[&wgpu::Buffer],
        samples: usize,
    ) -> BoundKernels {
        match self {
            Self::Paths(stage) => BoundKernels::Paths(stage.clone(), stage.group(gpu, arrays)),
            Self::Queues(queues) => {
                let samples = samples as u64;
                let states = array(gpu, "paths", samples * queues.state_size, Usages::empty());
                let copied = Usages::COPY_DST | Usages::COPY_SRC;
                let slots = array(gpu, "queues", HEAD_SIZE + samples * 8, copied);
                let workgroups = array(gpu, "workgroups", 12, Usages::INDIRECT);
                let all = [arrays, &[&states, &slots]].concat();
                let arrays = QueueArrays {
                    group: queues.shade.group(gpu, &all),
                    advance_group: queues.advance.group(gpu, &[&slots, &workgroups]),
                    compact_group: queues.compact.group(gpu, &[&slots]),
                    slots,
                    workgroups,
                };
                BoundKernels::Queues(queues.clone(), arrays)
            }
        }
    }
}

impl BoundKernels {
    /// Begins to take the samples of a batch.
    ///
    /// * `slots`: threads, one for each sample or none.
    /// * Returns: vertices that paths have come to, where some may go on; see [`go_on`](Self::go_on).
    pub(crate) fn begin(&self, gpu: &Gpu, slots: usize) -> Result<Option<u32>, GpuError> {
        match self {
            Self::Paths(stage, group) => {
                submit(gpu, |pass| stage.run(pass, group, slots))?;
                Ok(None)
            }
            Self::Queues(queues, arrays) => queues.begin(gpu, arrays, slots),
        }
    }

    /// Takes paths to their ends.
    ///
    /// * `done`: vertices that they have come to.
    pub(crate) fn go_on(&self, gpu: &Gpu, done: u32) -> Result<(), GpuError> {
        match self {
            Self::Paths(..) => Ok(()),
            Self::Queues(queues, arrays) => queues.go_on(gpu, arrays, done),
        }
    }
}

impl Queues {
    fn begin(
        &self,
        gpu: &Gpu,
        arrays: &QueueArrays,
        slots: usize,
    ) -> Result<Option<u32>, GpuError> {
        // Before vertex 0: a queue of odd depth, of all slots.
        let count = u32::try_from(slots).unwrap_or(u32::MAX);
        let before = [u32::MAX, 0, count];
        gpu.caught(|gpu| {
            let head = bytemuck::bytes_of(&before);
            gpu.queue.write_buffer(&arrays.slots, 0, head);
        })?;
        let count = VERTICES_AT_ONCE.min(self.most);
        submit(gpu, |pass| {
            self.begin.run(pass, &arrays.group, slots);
            self.compact.run(pass, &arrays.compact_group, slots);
            self.bounce(pass, arrays, count);
        })?;
        Ok((count < self.most).then_some(count))
    }

    fn go_on(&self, gpu: &Gpu, arrays: &QueueArrays, mut done: u32) -> Result<(), GpuError> {
        while done < self.most {
            let head = gpu.read(&arrays.slots, HEAD_SIZE)?;
            let head: Vec<u32> = bytemuck::pod_collect_to_vec(&head);
            // The queue of the vertex after the last one.
            if head.get(1 + (done & 1) as usize) == Some(&0) {
                return Ok(());
            }
            let count = VERTICES_AT_ONCE.min(self.most - done);
            submit(gpu, |pass| self.bounce(pass, arrays, count))?;
            done += count;
        }
        Ok(())
    }

    /// Takes all paths to so many vertices more.
    fn bounce(&self, pass: &mut wgpu::ComputePass<'_>, arrays: &QueueArrays, count: u32) {
        for _ in 0..count {
            self.advance.run(pass, &arrays.advance_group, 1);
            for stage in [&self.trace, &self.shade, &self.connect] {
                stage.run_indirect(pass, &arrays.group, &arrays.workgroups);
            }
            self.compact
                .run_indirect(pass, &arrays.compact_group, &arrays.workgroups);
        }
    }
}
