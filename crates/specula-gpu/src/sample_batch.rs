//! A batch: runs of samples that a device takes at once, and their sums.

use specula_render::{Run, RunSums};
use wgpu::BufferUsages as Usages;

use crate::adapter::{Gpu, GpuError};
use crate::path_kernels::{BoundKernels, PathKernels, SAMPLE_SIZE};
use crate::program;
use crate::shader::Slot;
use crate::stage::{Stage, array, layout, submit};

/// Bytes of a requested run.
const RUN_SIZE: u64 = 16;

/// Vectors before the first run, each as large as a run.
const HEAD: u64 = 2;

/// The kernels of a batch.
#[derive(Debug)]
pub(crate) struct Kernels {
    pub(crate) taker: PathKernels,
    /// Adds the samples of each run.
    sums: Stage,
}

/// Arrays on the device for a batch.
#[derive(Debug)]
pub(crate) struct SampleBatch {
    /// Capacity in samples and runs.
    capacity: [usize; 2],
    requests: wgpu::Buffer,
    sums: wgpu::Buffer,
    taking: BoundKernels,
    adding: wgpu::BindGroup,
}

impl Kernels {
    /// * `adder`: the text of the kernel that sums samples.
    pub(crate) fn new(gpu: &Gpu, taker: PathKernels, adder: &str) -> Result<Self, GpuError> {
        let slots = (0..3).map(|binding| Slot {
            binding,
            is_written: binding == 2,
        });
        let shader = gpu.shader("sums", adder)?;
        let arrays = layout(gpu, slots)?;
        let sums = Stage::new(gpu, &arrays, &shader, program::SUMS_ENTRY, None)?;
        Ok(Self { taker, sums })
    }
}

impl SampleBatch {
    /// * `capacity`: in samples and runs.
    pub(crate) fn new(
        gpu: &Gpu,
        kernels: &Kernels,
        scene: &[wgpu::Buffer],
        capacity: [usize; 2],
    ) -> Result<Self, GpuError> {
        gpu.caught(|gpu| {
            let [samples, runs] = capacity.map(|n| n as u64);
            let requests = array(gpu, "requests", (runs + HEAD) * RUN_SIZE, Usages::COPY_DST);
            let results = array(gpu, "results", samples * SAMPLE_SIZE, Usages::empty());
            let sums_size = runs * size_of::<RunSums>() as u64;
            let sums = array(gpu, "sums", sums_size, Usages::COPY_SRC);
            let read: Vec<_> = scene.iter().chain([&requests, &results]).collect();
            Self {
                capacity,
                taking: kernels.taker.with_capacity(gpu, &read, capacity[0]),
                adding: kernels.sums.group(gpu, &[&requests, &results, &sums]),
                requests,
                sums,
            }
        })
    }

    /// Whether the capacity suffices for so many samples and runs.
    pub(crate) fn holds(&self, [samples, runs]: [usize; 2]) -> bool {
        self.capacity[0] >= samples && self.capacity[1] >= runs
    }

    /// Takes the samples of runs, and adds those of each.
    ///
    /// * `settings`: of the render, by [`program::settings`].
    /// * `longest`: samples of the longest run.
    pub(crate) fn take(
        &self,
        gpu: &Gpu,
        kernels: &Kernels,
        settings: [u32; 4],
        (runs, longest): (&[Run], u32),
    ) -> Result<Vec<RunSums>, GpuError> {
        let count = u32::try_from(runs.len()).unwrap_or(u32::MAX);
        let words = runs.iter().map(|run| {
            let [x, y] = run.pixel;
            [x, y, run.first, run.count]
        });
        let requests: Vec<[u32; 4]> = [[longest, count, 0, 0], settings]
            .into_iter()
            .chain(words)
            .collect();
        gpu.caught(|gpu| {
            let requests = bytemuck::cast_slice(&requests);
            gpu.queue.write_buffer(&self.requests, 0, requests);
        })?;
        self.taking.take(gpu, runs.len() * longest as usize)?;
        submit(gpu, |pass| {
            kernels.sums.run(pass, &self.adding, runs.len());
        })?;
        let bytes = gpu.read(&self.sums, (runs.len() * size_of::<RunSums>()) as u64)?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}
