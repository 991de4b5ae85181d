//! The path tracer: a scene on the device, and samples that it takes there.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use specula_render::{
    FlatScene, PassReport, PreparedScene, RenderOptions, Renderer, Run, RunSums, Wanted,
};

use crate::adapter::{Gpu, GpuError};
use crate::error::TracerError;
use crate::path_kernels::PathKernels;
use crate::program;
use crate::queries::{Rays, Structures};
use crate::sample_batch::{Kernels, SampleBatch};
use crate::schedule::Schedule;
use crate::stage::{WORKGROUP, filled};

/// How long a dispatch should take: systems take devices away from work of seconds.
const WAVE_TIME: Duration = Duration::from_millis(100);
/// Samples of the first wave.
const FIRST_WAVE: usize = 1 << 12;
/// Most samples of a wave.
const LARGEST_WAVE: usize = 1 << 21;

/// How a device renders. The samples are the same, but for rays at edges and rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TracerOptions {
    /// How rays find what they hit.
    pub rays: Rays,
    /// In which order paths are followed.
    pub schedule: Schedule,
}

/// A scene on a device, ready to be sampled.
#[derive(Debug)]
pub struct Tracer<'a> {
    gpu: &'a Gpu,
    kernels: Kernels,
    /// Tables, nodes, packets, words.
    scene: [wgpu::Buffer; 4],
    uses_ray_queries: bool,
    wave: Option<SampleBatch>,
    /// Samples of the next wave.
    samples: usize,
    largest: usize,
}

/// Features of a scene that shaders do not know, in a person's words; none: it can be rendered on a
/// device.
#[must_use]
pub fn missing(scene: &PreparedScene) -> Vec<String> {
    scene.flatten().missing
}

impl<'a> Tracer<'a> {
    /// Compiles the scene's shader and uploads the scene, by the ways of [`TracerOptions::default`].
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

    /// The same by ways of choice.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`TracerError::Queries`] where ray queries are asked for and cannot be had.
    pub fn with_options(
        gpu: &'a Gpu,
        scene: &PreparedScene,
        options: &RenderOptions,
        on_gpu: TracerOptions,
    ) -> Result<Self, TracerError> {
        let flat = scene.flatten();
        let mut missing = flat.missing.clone();
        if options.share_paths > 1 {
            missing.push("paths that share".to_owned());
        }
        if !missing.is_empty() {
            return Err(TracerError::Missing(missing));
        }
        let (needed, limit) = (largest_array(&flat), limit(gpu));
        if needed > limit {
            return Err(TracerError::TooLarge { needed, limit });
        }
        let structures = Structures::chosen(on_gpu.rays, gpu, scene)?;
        let text = program::source(&flat, options, structures.is_some())?;
        let texts = [text.as_str(), program::SUMS];
        Self::of_texts(gpu, &flat, options, (on_gpu.schedule, structures), texts)
    }

    /// * `structures`: what rays are cast by; `None`: the tree.
    /// * `texts`: of the scene's shader, and of the one that adds.
    fn of_texts(
        gpu: &'a Gpu,
        flat: &FlatScene<'_>,
        options: &RenderOptions,
        (schedule, structures): (Schedule, Option<Structures>),
        texts: [&str; 2],
    ) -> Result<Self, TracerError> {
        // Before shaders are compiled: a scene that memory does not hold is told at once.
        let [tables, nodes, packets, words] = arrays(flat);
        let scene = [
            upload(gpu, tables)?,
            upload(gpu, nodes)?,
            upload(gpu, packets)?,
            upload(gpu, words)?,
        ];
        let limits = gpu.device.limits();
        let [path_tracer, adder] = texts;
        let module = gpu.shader("path tracer", path_tracer)?;
        let is_queues = schedule.is_queues(limits.max_storage_buffers_per_shader_stage);
        let structures = structures.as_ref().map(Structures::bindings);
        let taker = PathKernels::new(gpu, &module, is_queues, structures, options.max_depth)?;
        let kernels = Kernels::new(gpu, taker, adder)?;
        let largest = limit(gpu) / kernels.taker.sample_size().max(size_of::<RunSums>() as u64);
        Ok(Self {
            gpu,
            kernels,
            scene,
            uses_ray_queries: structures.is_some(),
            wave: None,
            samples: FIRST_WAVE,
            largest: usize::try_from(largest)
                .unwrap_or(usize::MAX)
                .min(LARGEST_WAVE)
                .min(limits.max_compute_workgroups_per_dimension as usize * WORKGROUP),
        })
    }

    /// Whether rays are cast by the adapter's ray queries; else they go through the tree.
    #[must_use]
    pub fn uses_ray_queries(&self) -> bool {
        self.uses_ray_queries
    }

    /// Adds samples to a render's film: [`Renderer::render_pass`] on the device.
    ///
    /// # Errors
    /// Those of the device. The film keeps what came before.
    pub fn render_pass(
        &mut self,
        renderer: &mut Renderer<'_>,
        samples: u32,
        stop: &AtomicBool,
    ) -> Result<PassReport, GpuError> {
        let most = std::cell::Cell::new(self.samples);
        renderer.render_pass_with(
            samples,
            stop,
            || most.get(),
            |wanted| {
                let found = self.take(wanted);
                most.set(self.samples);
                found
            },
        )
    }

    /// The sums of tiles, in the order of [`Wanted::runs`], in waves.
    fn take(&mut self, wanted: &[Wanted]) -> Result<Vec<RunSums>, GpuError> {
        let longest = wanted.iter().map(Wanted::longest_run).max().unwrap_or(0);
        let longest = longest.max(1);
        let runs: Vec<Run> = wanted.iter().flat_map(Wanted::runs).collect();
        let mut sums = Vec::with_capacity(runs.len());
        let mut rest = runs.as_slice();
        while !rest.is_empty() {
            let most = (self.largest / longest as usize).clamp(1, rest.len());
            let (now, later) = rest.split_at(most);
            let start = Instant::now();
            match self.wave(now, longest) {
                Ok(found) => sums.extend(found),
                Err(GpuError::OutOfMemory(_)) if self.shrinks(now.len() * longest as usize) => {
                    continue;
                }
                Err(error) => return Err(error),
            }
            let samples = now.iter().map(|run| run.count as usize).sum();
            self.adjust(samples, start.elapsed());
            rest = later;
        }
        Ok(sums)
    }

    /// Halves all waves from now on where memory did not suffice for one of so many samples; whether that
    /// may help.
    fn shrinks(&mut self, samples: usize) -> bool {
        self.largest = samples / 2;
        self.samples = self.samples.min(self.largest);
        self.largest >= WORKGROUP && self.gpu.check().is_ok()
    }

    /// Makes the next wave as large as lasts [`WAVE_TIME`].
    fn adjust(&mut self, samples: usize, took: Duration) {
        if took < WAVE_TIME / 2 && samples >= self.samples / 2 {
            self.samples = (self.samples * 2).min(self.largest);
        } else if took > 2 * WAVE_TIME {
            self.samples = (self.samples / 2).max(WORKGROUP);
        }
    }

    /// The sums of runs.
    ///
    /// * `longest`: samples of the longest one.
    fn wave(&mut self, runs: &[Run], longest: u32) -> Result<Vec<RunSums>, GpuError> {
        let needed = [runs.len() * longest as usize, runs.len()];
        let wave = match self.wave.take() {
            Some(wave) if wave.holds(needed) => wave,
            smaller => {
                // What there is goes before more is asked for.
                drop(smaller);
                let room = needed.map(|n| n.next_power_of_two().min(self.largest).max(n));
                SampleBatch::new(self.gpu, &self.kernels, &self.scene, room)?
            }
        };
        let sums = wave.take(self.gpu, &self.kernels, runs, longest)?;
        self.wave = Some(wave);
        Ok(sums)
    }
}

/// Tables, nodes, packets, words.
fn arrays<'f>(flat: &'f FlatScene<'_>) -> [&'f [u8]; 4] {
    [
        bytemuck::cast_slice(specula_shaders::tables()),
        flat.nodes,
        flat.packets,
        bytemuck::cast_slice(&flat.words),
    ]
}

/// Bytes of the largest array.
fn largest_array(flat: &FlatScene<'_>) -> u64 {
    let sizes = arrays(flat).map(|array| array.len() as u64);
    sizes.into_iter().max().unwrap_or(0)
}

/// Bytes that an array may have.
fn limit(gpu: &Gpu) -> u64 {
    let limits = gpu.device.limits();
    limits
        .max_storage_buffer_binding_size
        .min(limits.max_buffer_size)
}

/// A buffer that is never empty, which bindings must not be.
fn upload(gpu: &Gpu, contents: &[u8]) -> Result<wgpu::Buffer, GpuError> {
    let contents = if contents.is_empty() {
        &[0; 4]
    } else {
        contents
    };
    filled(gpu, "scene", contents, wgpu::BufferUsages::STORAGE)
}

#[cfg(test)]
mod tests;
