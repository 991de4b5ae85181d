//! The path tracer: a scene on the device, and samples that it takes there.

use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use specula_render::{Found, PassReport, PreparedScene, RenderOptions, Renderer, Wanted};
use wgpu::util::DeviceExt;

use crate::adapter::{Gpu, GpuError};
use crate::program;

/// How long a dispatch should take: systems take devices away from work of seconds.
const WAVE: Duration = Duration::from_millis(100);
/// Samples of the first wave.
const FIRST_WAVE: usize = 1 << 12;
/// Most samples of a wave.
const LARGEST_WAVE: usize = 1 << 21;
/// Threads of a workgroup, as the shader says.
const WORKGROUP: usize = 64;
/// Bytes of a wanted sample.
const WANTED_SIZE: u64 = 16;

/// Why a scene cannot be rendered on a device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TracerError {
    /// The scene has what shaders do not know.
    #[error("the GPU does not render {}", .0.join(", "))]
    Missing(Vec<String>),
    /// The scene's arrays are larger than the device takes.
    #[error("the scene's largest array has {needed} bytes; the GPU takes {limit}")]
    TooLarge {
        /// Bytes of the largest array.
        needed: u64,
        /// Bytes that the device takes.
        limit: u64,
    },
    /// The library's modules do not fit together.
    #[error(transparent)]
    Program(#[from] specula_shaders::ComposeError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// A scene on a device, ready to be sampled.
#[derive(Debug)]
pub struct Tracer<'a> {
    gpu: &'a Gpu,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    /// Tables, nodes, packets, words.
    scene: [wgpu::Buffer; 4],
    wave: Option<WaveBuffers>,
    /// Samples of the next wave.
    samples: usize,
    largest: usize,
}

/// What goes to the device for a wave and comes back.
#[derive(Debug)]
struct WaveBuffers {
    capacity: usize,
    wanted: wgpu::Buffer,
    found: wgpu::Buffer,
    group: wgpu::BindGroup,
}

/// Features of a scene that shaders do not know, in a person's words; none: it can be rendered on a
/// device.
#[must_use]
pub fn missing(scene: &PreparedScene) -> Vec<String> {
    program::missing(&scene.flatten())
}

impl<'a> Tracer<'a> {
    /// Compiles the scene's shader and uploads the scene.
    ///
    /// # Errors
    /// [`TracerError::Missing`] before anything else; where the scene is too large, or the device
    /// fails.
    pub fn new(
        gpu: &'a Gpu,
        scene: &PreparedScene,
        options: &RenderOptions,
    ) -> Result<Self, TracerError> {
        let flat = scene.flatten();
        let mut missing = program::missing(&flat);
        if options.share_paths > 1 {
            missing.push("paths that share".to_owned());
        }
        if !missing.is_empty() {
            return Err(TracerError::Missing(missing));
        }
        let tables = specula_shaders::tables();
        let arrays = [
            bytemuck::cast_slice(tables),
            flat.nodes,
            flat.packets,
            bytemuck::cast_slice(&flat.words),
        ];
        let limits = gpu.device.limits();
        let limit = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let needed = arrays.iter().map(|a| a.len() as u64).max().unwrap_or(0);
        if needed > limit {
            return Err(TracerError::TooLarge { needed, limit });
        }
        let text = program::source(&flat, options)?;
        let module = gpu.shader("path tracer", &text)?;
        let (layout, pipeline) = pipeline(gpu, &module)?;
        let scene = gpu.caught(|gpu| arrays.map(|contents| upload(gpu, contents)))?;
        let per_sample = size_of::<Found>() as u64;
        let largest = usize::try_from(limit / per_sample).unwrap_or(usize::MAX);
        Ok(Self {
            gpu,
            pipeline,
            layout,
            scene,
            wave: None,
            samples: FIRST_WAVE,
            largest: largest
                .min(LARGEST_WAVE)
                .min(limits.max_compute_workgroups_per_dimension as usize * WORKGROUP),
        })
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

    /// Takes the samples of tiles, in the order of [`Wanted::each`], in waves.
    fn take(&mut self, wanted: &[Wanted]) -> Result<Vec<Found>, GpuError> {
        let list: Vec<[u32; 4]> = wanted
            .iter()
            .flat_map(Wanted::each)
            .map(|(_, [x, y], number)| [x, y, number, 1])
            .collect();
        let mut found = Vec::with_capacity(list.len());
        let mut rest = list.as_slice();
        while !rest.is_empty() {
            let (wave, after) = rest.split_at(rest.len().min(self.largest));
            rest = after;
            let start = Instant::now();
            found.extend(self.wave(wave)?);
            self.adjust(wave.len(), start.elapsed());
        }
        Ok(found)
    }

    /// Makes the next wave as large as lasts [`WAVE`].
    fn adjust(&mut self, samples: usize, took: Duration) {
        if took < WAVE / 2 && samples >= self.samples / 2 {
            self.samples = (self.samples * 2).min(self.largest);
        } else if took > 2 * WAVE {
            self.samples = (self.samples / 2).max(WORKGROUP);
        }
    }

    fn wave(&mut self, list: &[[u32; 4]]) -> Result<Vec<Found>, GpuError> {
        let gpu = self.gpu;
        if self.wave.as_ref().is_none_or(|w| w.capacity < list.len()) {
            self.wave = None;
            self.wave = Some(self.wave_buffers(list.len().next_power_of_two().min(self.largest))?);
        }
        let Some(wave) = &self.wave else {
            return Ok(Vec::new());
        };
        let bytes: &[u8] = bytemuck::cast_slice(list);
        gpu.caught(|gpu| {
            gpu.queue.write_buffer(&wave.wanted, 0, bytes);
            // Threads behind the list, in its last workgroup, take nothing.
            let end = list.len().next_multiple_of(WORKGROUP).min(wave.capacity);
            let idle = vec![[0_u32; 4]; end - list.len()];
            gpu.queue.write_buffer(
                &wave.wanted,
                bytes.len() as u64,
                bytemuck::cast_slice(&idle),
            );
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &wave.group, &[]);
                let groups = u32::try_from(list.len().div_ceil(WORKGROUP)).unwrap_or(u32::MAX);
                pass.dispatch_workgroups(groups, 1, 1);
            }
            gpu.queue.submit([encoder.finish()]);
        })?;
        let size = (list.len() * size_of::<Found>()) as u64;
        let bytes = gpu.read(&wave.found, size)?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    fn wave_buffers(&self, capacity: usize) -> Result<WaveBuffers, GpuError> {
        let capacity = capacity.max(WORKGROUP);
        self.gpu.caught(|gpu| {
            let buffer = |label, size, usage| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size,
                    usage: wgpu::BufferUsages::STORAGE | usage,
                    mapped_at_creation: false,
                })
            };
            let samples = capacity as u64;
            let wanted = buffer(
                "wanted samples",
                samples * WANTED_SIZE,
                wgpu::BufferUsages::COPY_DST,
            );
            let found = buffer(
                "found samples",
                samples * size_of::<Found>() as u64,
                wgpu::BufferUsages::COPY_SRC,
            );
            let entries: Vec<_> = (0_u32..)
                .zip(self.scene.iter().chain([&wanted, &found]))
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("path tracer"),
                layout: &self.layout,
                entries: &entries,
            });
            WaveBuffers {
                capacity,
                wanted,
                found,
                group,
            }
        })
    }
}

/// A buffer that is never empty, which bindings must not be.
fn upload(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let contents = if contents.is_empty() {
        &[0; 4]
    } else {
        contents
    };
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("scene"),
            contents,
            usage: wgpu::BufferUsages::STORAGE,
        })
}

fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
) -> Result<(wgpu::BindGroupLayout, wgpu::ComputePipeline), GpuError> {
    const BUFFERS: u32 = 6;
    let entry = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: binding + 1 < BUFFERS,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..BUFFERS).map(entry).collect();
    gpu.caught(|gpu| {
        let device = &gpu.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("path tracer"),
            entries: &entries,
        });
        let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("path tracer"),
            bind_group_layouts: &[Some(&layout)],
            ..Default::default()
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("path tracer"),
            layout: Some(&whole),
            module,
            entry_point: Some(program::ENTRY),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        (layout, pipeline)
    })
}
