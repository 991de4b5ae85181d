//! The path tracer: a scene on the device, and samples that it takes there.

use std::collections::VecDeque;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use specula_render::{
    Most, PassReport, PreparedScene, RenderOptions, Renderer, Run, RunSums, SampleDevice, Wanted,
};

use crate::adapter::{AdapterKind, Gpu, GpuError};
use crate::error::TracerError;
use crate::path_kernels::{self, PathKernels};
use crate::program;
use crate::queries::{Rays, Structures};
use crate::sample_batch::{Kernels, SampleBatch, Submission};
use crate::scene_program::SceneProgram;
use crate::schedule::Schedule;
use crate::stage::{WORKGROUP, filled};

/// How long a batch should take: systems reset devices whose work takes seconds.
const BATCH_TIME: Duration = Duration::from_millis(100);
/// Samples of the first batch in software.
const FIRST_BATCH: usize = 1 << 12;
/// The same on a real GPU, which smaller ones leave idle.
const FIRST_BATCH_OF_REAL_GPUS: usize = 1 << 17;
/// Most samples of a batch.
const LARGEST_BATCH: usize = 1 << 22;
/// Most runs of a batch: their sums are what comes back.
const MOST_RUNS: usize = 1 << 17;

/// How a device renders. The samples are the same, but for rays at edges and rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TracerOptions {
    /// How rays are cast.
    pub rays: Rays,
    /// In which order paths are followed.
    pub schedule: Schedule,
}

/// A scene on a device, ready to be sampled.
#[derive(Debug)]
pub struct Tracer<'a> {
    gpu: &'a Gpu,
    kernels: Kernels,
    /// Of the render.
    settings: [u32; 4],
    /// Tables, nodes, triangles, words.
    scene: [wgpu::Buffer; 4],
    uses_ray_queries: bool,
    batch: Option<SampleBatch>,
    /// Begun and not finished, the first one first.
    begun: VecDeque<Begun>,
    /// When the last one was finished.
    finished: Option<Instant>,
    /// Samples of the next batch.
    samples: usize,
    largest: usize,
    /// Samples and runs that arrays are made for at first.
    expected: [usize; 2],
    /// Of the batch that was fetched last.
    sums: Vec<RunSums>,
    /// Samples a second of the last batches.
    rate: Option<f64>,
}

/// What was begun of a pass.
#[derive(Debug)]
enum Begun {
    /// So many samples, on the device since then.
    Submitted(Submission, usize, Instant),
    /// Samples that the device takes in several batches only; they are done.
    Done(Vec<RunSums>),
}

impl<'a> Tracer<'a> {
    /// Compiles the scene's shader and uploads the scene, with [`TracerOptions::default`].
    ///
    /// # Errors
    /// [`TracerError::Missing`] before anything else; where the scene is too large, or the device
    /// fails.
    pub fn new(
        gpu: &'a Gpu,
        scene: &PreparedScene,
        options: &RenderOptions,
    ) -> Result<Self, TracerError> {
        Self::with_options(gpu, scene, options, TracerOptions::default())
    }

    /// [`new`](Self::new) with options.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`TracerError::Queries`] where ray queries are asked for and cannot be had.
    pub fn with_options(
        gpu: &'a Gpu,
        scene: &PreparedScene,
        options: &RenderOptions,
        on_gpu: TracerOptions,
    ) -> Result<Self, TracerError> {
        let program = SceneProgram::new(scene, options)?;
        let (needed, limit) = (program.largest_array(), gpu.adapter.largest_array);
        if needed > limit {
            return Err(TracerError::TooLarge { needed, limit });
        }
        let structures = Structures::chosen(on_gpu.rays, gpu, scene)?;
        let text = match structures {
            Some(_) => program.text_with_queries(),
            None => program.text(),
        }?;
        let texts = [text.as_str(), program::SUMS];
        let how = (on_gpu.schedule, structures);
        let mut tracer = Self::of_texts(gpu, &program, options, how, texts)?;
        if gpu.adapter.kind != AdapterKind::Software {
            // Arrays that grow with the batches cost more than small batches on a real GPU.
            let [width, height] = scene.resolution().map(|side| side as usize);
            let samples = (width * height).saturating_mul(options.samples_per_pixel as usize);
            tracer.expected = [samples.min(tracer.largest), samples.min(MOST_RUNS)];
        }
        Ok(tracer)
    }

    /// * `structures`: of ray queries; `None`: rays are traversed by the shader.
    /// * `texts`: of the scene's shader, and of the one that sums samples.
    fn of_texts(
        gpu: &'a Gpu,
        program: &SceneProgram<'_>,
        options: &RenderOptions,
        (schedule, structures): (Schedule, Option<Structures>),
        texts: [&str; 2],
    ) -> Result<Self, TracerError> {
        // Before shaders are compiled: a scene that memory does not hold is told at once.
        let [tables, nodes, packets, words] = program.arrays();
        let scene = [
            upload(gpu, tables)?,
            upload(gpu, nodes)?,
            upload(gpu, packets)?,
            upload(gpu, words)?,
        ];
        let limits = gpu.device.limits();
        let [path_tracer, adder] = texts;
        let shader = gpu.shader("path tracer", path_tracer)?;
        let is_queues = schedule.is_queues(limits.max_storage_buffers_per_shader_stage);
        let structures = structures.as_ref().map(Structures::bindings);
        let sizes = (options.max_depth, path_kernels::state_size(&program.flat));
        let taker = PathKernels::new(gpu, &shader, is_queues, structures, sizes)?;
        let kernels = Kernels::new(gpu, taker, adder)?;
        let largest = gpu.adapter.largest_array
            / kernels.taker.sample_size().max(size_of::<RunSums>() as u64);
        let largest = usize::try_from(largest)
            .unwrap_or(usize::MAX)
            .min(LARGEST_BATCH)
            .min(limits.max_compute_workgroups_per_dimension as usize * WORKGROUP);
        let first = match gpu.adapter.kind {
            AdapterKind::Software => FIRST_BATCH,
            _ => FIRST_BATCH_OF_REAL_GPUS,
        };
        Ok(Self {
            gpu,
            kernels,
            settings: program.settings(),
            scene,
            uses_ray_queries: structures.is_some(),
            batch: None,
            begun: VecDeque::new(),
            finished: None,
            samples: first.min(largest),
            largest,
            expected: [0; 2],
            sums: Vec::new(),
            rate: None,
        })
    }

    /// Whether rays are cast by the adapter's ray queries; else the shader traverses the tree.
    #[must_use]
    pub fn uses_ray_queries(&self) -> bool {
        self.uses_ray_queries
    }

    /// Adds samples to a render's film: [`Renderer::render_pass`] on the device.
    ///
    /// # Errors
    /// Those of the device. Samples of finished batches stay in the film.
    pub fn render_pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        self.forget();
        renderer.render_pass_with(samples, stop, self)
    }

    /// Leaves what an earlier pass has begun and, as it failed, not finished.
    pub(crate) fn forget(&mut self) {
        self.begun.clear();
        self.finished = None;
    }

    /// Where it renders.
    #[must_use]
    pub fn gpu(&self) -> &'a Gpu {
        self.gpu
    }

    /// Samples a second of the last batches, once one is finished.
    #[must_use]
    pub fn rate(&self) -> Option<f64> {
        self.rate
    }

    /// The sums that were finished last.
    pub(crate) fn sums(&self) -> &[RunSums] {
        &self.sums
    }

    /// The sums of runs, in batches, one after the other.
    fn take(&mut self, runs: &[Run], longest: u32) -> Result<Vec<RunSums>, GpuError> {
        let mut sums = Vec::with_capacity(runs.len());
        let mut rest = runs;
        while !rest.is_empty() {
            let most = (self.largest / longest as usize).clamp(1, rest.len());
            let (now, later) = rest.split_at(most);
            let start = Instant::now();
            match self.take_batch(now, longest) {
                Ok(()) => sums.extend_from_slice(&self.sums),
                Err(GpuError::OutOfMemory(_)) if self.shrinks(now.len() * longest as usize) => {
                    continue;
                }
                Err(error) => return Err(error),
            }
            self.adjust(count_samples(now), start.elapsed());
            rest = later;
        }
        Ok(sums)
    }

    /// Halves the largest batch, as memory did not suffice for one of so many samples; returns whether that may help.
    fn shrinks(&mut self, samples: usize) -> bool {
        self.largest = samples / 2;
        self.samples = self.samples.min(self.largest);
        self.largest >= WORKGROUP && self.gpu.check().is_ok()
    }

    /// Adjusts the size of the next batch to [`BATCH_TIME`], and the rate to what this one took.
    fn adjust(&mut self, samples: usize, took: Duration) {
        let rate = samples as f64 / took.as_secs_f64().max(1e-6);
        self.rate = Some(self.rate.map_or(rate, |earlier| 0.5 * (earlier + rate)));
        if took < BATCH_TIME / 2 && samples >= self.samples / 2 {
            self.samples = (self.samples * 2).min(self.largest);
        } else if took > 2 * BATCH_TIME {
            self.samples = (self.samples / 2).max(WORKGROUP);
        }
    }

    /// Takes a batch; its sums are in [`sums`](Self::sums) then.
    ///
    /// * `longest`: samples of the longest run.
    fn take_batch(&mut self, runs: &[Run], longest: u32) -> Result<(), GpuError> {
        let submission = self.submit(runs, longest)?;
        self.fetch(submission)
    }

    /// Begins a batch.
    fn submit(&mut self, runs: &[Run], longest: u32) -> Result<Submission, GpuError> {
        let needed = [runs.len() * longest as usize, runs.len()];
        let mut batch = match self.batch.take() {
            Some(batch) if batch.holds(needed) => batch,
            smaller => {
                // Freed before more memory is requested.
                drop(smaller);
                let grown = needed.map(|n| n.next_power_of_two().min(self.largest).max(n));
                let [samples, runs] = self.expected;
                let capacity = [grown[0].max(samples.min(self.largest)), grown[1].max(runs)];
                SampleBatch::new(self.gpu, &self.kernels, &self.scene, capacity)?
            }
        };
        let submission = batch.begin(self.gpu, &self.kernels, self.settings, (runs, longest))?;
        self.batch = Some(batch);
        Ok(submission)
    }

    /// Waits for the sums of a batch; they are in [`sums`](Self::sums) then.
    fn fetch(&mut self, mut submission: Submission) -> Result<(), GpuError> {
        if let Some(batch) = &self.batch {
            batch.complete(self.gpu, &self.kernels, &mut submission)?;
        }
        let staging = submission.fetch(self.gpu, &mut self.sums)?;
        if let Some(batch) = &mut self.batch {
            batch.reuse(staging);
        }
        Ok(())
    }
}

impl SampleDevice for Tracer<'_> {
    type Error = GpuError;

    fn most(&self) -> Most {
        Most {
            samples: self.samples,
            runs: MOST_RUNS,
        }
    }

    fn begin(&mut self, wanted: &[Wanted]) -> Result<(), GpuError> {
        // The arrays of paths are shared.
        if let (Some(Begun::Submitted(last, ..)), Some(batch)) =
            (self.begun.back_mut(), &self.batch)
        {
            batch.complete(self.gpu, &self.kernels, last)?;
        }
        let longest = wanted.iter().map(Wanted::longest_run).max().unwrap_or(0);
        let longest = longest.max(1);
        let runs: Vec<Run> = wanted.iter().flat_map(Wanted::runs).collect();
        let slots = runs.len() * longest as usize;
        if slots <= self.largest {
            let start = Instant::now();
            match self.submit(&runs, longest) {
                Ok(submission) => {
                    let samples = count_samples(&runs);
                    let begun = Begun::Submitted(submission, samples, start);
                    self.begun.push_back(begun);
                    return Ok(());
                }
                Err(GpuError::OutOfMemory(_)) if self.shrinks(slots) => {}
                Err(error) => return Err(error),
            }
        }
        let sums = self.take(&runs, longest)?;
        self.begun.push_back(Begun::Done(sums));
        Ok(())
    }

    fn finish(&mut self) -> Result<&[RunSums], GpuError> {
        match self.begun.pop_front() {
            Some(Begun::Submitted(submission, samples, start)) => {
                self.fetch(submission)?;
                // While batches overlap, what one takes is the time between two that are finished.
                let begin = self.finished.map_or(start, |last| last.max(start));
                self.adjust(samples, begin.elapsed());
                self.finished = Some(Instant::now());
            }
            Some(Begun::Done(sums)) => self.sums = sums,
            None => self.sums.clear(),
        }
        Ok(&self.sums)
    }
}

/// Samples of runs.
fn count_samples(runs: &[Run]) -> usize {
    runs.iter().map(|run| run.count as usize).sum()
}

/// A buffer that is never empty, which bindings must not be.
fn upload(gpu: &Gpu, contents: &[u8]) -> Result<wgpu::Buffer, GpuError> {
    let contents = if contents.is_empty() {
        &[0; 16]
    } else {
        contents
    };
    filled(gpu, "scene", contents, wgpu::BufferUsages::STORAGE)
}

#[cfg(test)]
mod tests;
