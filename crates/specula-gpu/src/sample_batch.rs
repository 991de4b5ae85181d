//! A batch: runs of samples that a device takes at once, and their sums.

use bytemuck::Zeroable as _;
use specula_render::{Run, RunSums};
use wgpu::BufferUsages as Usages;

use crate::adapter::{Gpu, GpuError};
use crate::path_kernels::{BoundKernels, PathKernels, SAMPLE_SIZE};
use crate::program;
use crate::shader::Slot;
use crate::stage::{Stage, array, layout};

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
    /// Of finished submissions, for the next ones.
    spare: Vec<wgpu::Buffer>,
}

/// Samples that a device takes.
#[derive(Debug)]
pub(crate) struct Submission {
    runs: usize,
    /// Sums of the runs are copied to this.
    staging: wgpu::Buffer,
    state: State,
}

impl Submission {
    /// Waits for the sums of the runs; returns the buffer that they were read from.
    ///
    /// Call [`SampleBatch::complete`] before.
    pub(crate) fn fetch(
        self,
        gpu: &Gpu,
        sums: &mut Vec<RunSums>,
    ) -> Result<wgpu::Buffer, GpuError> {
        let State::Whole(index) = self.state else {
            let text = "paths have not been taken to their ends";
            return Err(GpuError::Refused(text.to_owned()));
        };
        let size = (self.runs * size_of::<RunSums>()) as u64;
        gpu.fetched(&self.staging, size, index, |bytes| {
            sums.resize(self.runs, RunSums::zeroed());
            bytemuck::cast_slice_mut(sums).copy_from_slice(bytes);
        })?;
        Ok(self.staging)
    }
}

/// What of a submission is under way.
#[derive(Debug)]
enum State {
    /// Paths to so many vertices; some may go on.
    Begun(u32),
    /// Everything.
    Whole(wgpu::SubmissionIndex),
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
                spare: Vec::new(),
            }
        })
    }

    /// Whether the capacity suffices for so many samples and runs.
    pub(crate) fn holds(&self, [samples, runs]: [usize; 2]) -> bool {
        self.capacity[0] >= samples && self.capacity[1] >= runs
    }

    /// Begins to take the samples of runs, and to add those of each.
    ///
    /// * `settings`: of the render, by [`program::settings`].
    /// * `longest`: samples of the longest run.
    pub(crate) fn begin(
        &mut self,
        gpu: &Gpu,
        kernels: &Kernels,
        settings: [u32; 4],
        (runs, longest): (&[Run], u32),
    ) -> Result<Submission, GpuError> {
        let count = u32::try_from(runs.len()).unwrap_or(u32::MAX);
        let words = runs.iter().map(|run| {
            let [x, y] = run.pixel;
            [x, y, run.first, run.count]
        });
        let requests: Vec<[u32; 4]> = [[longest, count, 0, 0], settings]
            .into_iter()
            .chain(words)
            .collect();
        let staging = match self.spare.pop() {
            Some(staging) => staging,
            None => gpu.caught(|gpu| gpu.staging(self.sums.size()))?,
        };
        gpu.caught(|gpu| {
            let requests = bytemuck::cast_slice(&requests);
            gpu.queue.write_buffer(&self.requests, 0, requests);
        })?;
        let rest = self.taking.begin(gpu, runs.len() * longest as usize)?;
        let state = match rest {
            Some(done) => State::Begun(done),
            None => State::Whole(self.add(gpu, kernels, runs.len(), &staging)?),
        };
        Ok(Submission {
            runs: runs.len(),
            staging,
            state,
        })
    }

    /// Submits what of a submission is left: the batch's arrays are free for the next one.
    pub(crate) fn complete(
        &self,
        gpu: &Gpu,
        kernels: &Kernels,
        submission: &mut Submission,
    ) -> Result<(), GpuError> {
        if let State::Begun(done) = submission.state {
            self.taking.go_on(gpu, done)?;
            let index = self.add(gpu, kernels, submission.runs, &submission.staging)?;
            submission.state = State::Whole(index);
        }
        Ok(())
    }

    /// Keeps a buffer that was read for the next submission.
    pub(crate) fn reuse(&mut self, staging: wgpu::Buffer) {
        if staging.size() == self.sums.size() {
            self.spare.push(staging);
        }
    }

    /// Adds the samples of each run, and copies the sums to where they are read.
    fn add(
        &self,
        gpu: &Gpu,
        kernels: &Kernels,
        runs: usize,
        staging: &wgpu::Buffer,
    ) -> Result<wgpu::SubmissionIndex, GpuError> {
        gpu.caught(|gpu| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            kernels.sums.run(&mut pass, &self.adding, runs);
            drop(pass);
            let size = (runs * size_of::<RunSums>()) as u64;
            encoder.copy_buffer_to_buffer(&self.sums, 0, staging, 0, size);
            gpu.queue.submit([encoder.finish()])
        })
    }
}
