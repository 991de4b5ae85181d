//! SPIR-V of any compiler on a Vulkan device, handed to the driver as it is.
#![allow(
    unsafe_code,
    reason = "wgpu hands a shader to the driver unread by a function that is unsafe to call"
)]

use std::borrow::Cow;

use specula_gpu::Gpu;

/// Threads of a workgroup, as the entry points say.
pub(super) const GROUP: usize = 64;
/// Workgroups along x; more threads go to the next row.
pub(super) const ROW: usize = 1024;

/// A device that takes SPIR-V as it is.
pub(super) struct Vulkan {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Vulkan {
    /// The adapter on which the other cases run, by its Vulkan driver; an error where that does not take SPIR-V as it
    /// is.
    pub(super) fn open(gpu: &Gpu) -> Result<Self, String> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::VULKAN,
            flags: wgpu::InstanceFlags::empty(),
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapters = instance.enumerate_adapters(wgpu::Backends::VULKAN);
        let adapters = pollster::block_on(adapters);
        let same = |adapter: &wgpu::Adapter| adapter.get_info().name == gpu.adapter.name;
        let adapter = adapters.into_iter().find(same).ok_or("no Vulkan")?;
        let wanted = wgpu::Features::PASSTHROUGH_SHADERS;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("parity"),
            required_features: wanted,
            required_limits: adapter.limits(),
            // SAFETY: states that we know of possible faults in what is asked for, which is shaders that are not
            // checked; those of the tests are written by compilers, and `spirv-val` reads them.
            experimental_features: unsafe { wgpu::ExperimentalFeatures::enabled() },
            ..wgpu::DeviceDescriptor::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|error| error.to_string())?;
        Ok(Self { device, queue })
    }

    /// A shader with an entry point.
    pub(super) fn shader(&self, words: &[u32], entry: &str) -> wgpu::ShaderModule {
        let entry = wgpu::PassthroughShaderEntryPoint {
            name: Cow::Borrowed(entry),
            workgroup_size: (u32::try_from(GROUP).unwrap_or(1), 1, 1),
        };
        let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
            label: Some("parity"),
            entry_points: Cow::Owned(vec![entry]),
            spirv: Some(Cow::Borrowed(words)),
            ..Default::default()
        };
        // SAFETY: the words are a compiler's, and read no further than their arrays.
        unsafe { self.device.create_shader_module_passthrough(descriptor) }
    }

    /// Runs an entry point for so many rows of arguments.
    ///
    /// The bindings are 0 the tables and 1 the arguments, both read; 2 the results, written; 3 the number of rows.
    pub(super) fn run(
        &self,
        module: &wgpu::ShaderModule,
        entry: &str,
        [tables, arguments]: [&[u8]; 2],
        [rows, results]: [usize; 2],
    ) -> Vec<f32> {
        let size = |bytes: usize| u64::try_from(bytes).unwrap_or(u64::MAX);
        let read = |bytes: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
            let buffer = self.buffer(size(bytes.len()), usage);
            self.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let count = u32::try_from(rows).unwrap_or(u32::MAX).to_le_bytes();
        let length = size(4 * rows * results);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let written = self.buffer(length, usage);
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        let here = self.buffer(length, usage);
        let buffers = [read(tables), read(arguments), written.clone(), read(&count)];
        let (pipeline, group) = self.pipeline(module, entry, &buffers);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            let groups = rows.div_ceil(GROUP);
            let [x, y] = [groups.min(ROW), groups.div_ceil(ROW)]
                .map(|n| u32::try_from(n).unwrap_or(u32::MAX));
            pass.dispatch_workgroups(x, y, 1);
        }
        encoder.copy_buffer_to_buffer(&written, 0, &here, 0, length);
        self.queue.submit([encoder.finish()]);
        here.map_async(wgpu::MapMode::Read, .., |mapped| {
            mapped.unwrap_or_else(|error| panic!("{error}"));
        });
        let wait = self.device.poll(wgpu::PollType::wait_indefinitely());
        wait.unwrap_or_else(|error| panic!("{error}"));
        let view = here.get_mapped_range(..);
        let view = view.unwrap_or_else(|error| panic!("{error}"));
        let bytes = view.as_chunks().0.iter();
        bytes.map(|bytes| f32::from_le_bytes(*bytes)).collect()
    }

    fn buffer(&self, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("parity"),
            size,
            usage,
            mapped_at_creation: false,
        })
    }

    /// An entry point's pipeline with its arrays.
    fn pipeline(
        &self,
        module: &wgpu::ShaderModule,
        entry: &str,
        buffers: &[wgpu::Buffer],
    ) -> (wgpu::ComputePipeline, wgpu::BindGroup) {
        let slot = |binding: u32| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage {
                    read_only: binding != 2,
                },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let slots = [0, 1, 2, 3].map(slot);
        let device = &self.device;
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("parity"),
            entries: &slots,
        });
        let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("parity"),
            bind_group_layouts: &[Some(&layout)],
            ..Default::default()
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&whole),
            module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let bound: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("parity"),
            layout: &layout,
            entries: &bound,
        });
        (pipeline, group)
    }
}
