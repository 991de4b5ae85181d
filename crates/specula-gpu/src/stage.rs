//! A compiled kernel, and its arrays.

use crate::adapter::{Gpu, GpuError};
use crate::shader::{Entry, Shader, Slot};

/// Threads of a workgroup, as the shaders say.
pub(crate) const WORKGROUP: usize = 64;

/// The arrays of kernels that share them.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    slots: Vec<Slot>,
    handle: wgpu::BindGroupLayout,
}

/// The arrays of kernels that share them, as the device knows them.
pub(crate) fn layout(gpu: &Gpu, slots: impl IntoIterator<Item = Slot>) -> Result<Layout, GpuError> {
    let slots: Vec<Slot> = slots.into_iter().collect();
    let entry = |slot: &Slot| wgpu::BindGroupLayoutEntry {
        binding: slot.binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: !slot.is_written,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = slots.iter().map(entry).collect();
    let handle = gpu.caught(|gpu| {
        let device = &gpu.device;
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("arrays"),
            entries: &entries,
        })
    })?;
    Ok(Layout { slots, handle })
}

/// The acceleration structure of ray queries: group 1 of shaders.
#[derive(Clone, Debug)]
pub(crate) struct RayBindings {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
}

/// A compiled kernel.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    pipeline: wgpu::ComputePipeline,
    layout: Layout,
    /// Group 1, of a kernel that casts rays by ray queries.
    structures: Option<wgpu::BindGroup>,
}

impl Stage {
    /// Compiles an entry point of a shader.
    ///
    /// * `structures`: where it casts rays by ray queries.
    pub(crate) fn new(
        gpu: &Gpu,
        layout: &Layout,
        shader: &Shader,
        entry: &str,
        structures: Option<&RayBindings>,
    ) -> Result<Self, GpuError> {
        let make = |module: &wgpu::ShaderModule| {
            let made = gpu.caught(|gpu| {
                let device = &gpu.device;
                let whole = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: Some(entry),
                    bind_group_layouts: &[Some(&layout.handle), structures.map(|s| &s.layout)],
                    ..Default::default()
                });
                device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: Some(&whole),
                    module,
                    entry_point: Some(entry),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                })
            });
            made.map_err(|error| error.of_shader(entry))
        };
        let key = Entry {
            name: entry.to_owned(),
            slots: layout.slots.clone(),
            casts_queries: structures.is_some(),
        };
        Ok(Self {
            pipeline: shader.kernel(key, make)?,
            layout: layout.clone(),
            structures: structures.map(|s| s.group.clone()),
        })
    }

    #[cfg(test)]
    pub(crate) fn pipeline(&self) -> &wgpu::ComputePipeline {
        &self.pipeline
    }

    /// The kernel's arrays, in the order of their bindings.
    pub(crate) fn group(&self, gpu: &Gpu, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries: Vec<_> = self
            .layout
            .slots
            .iter()
            .zip(buffers)
            .map(|(slot, buffer)| wgpu::BindGroupEntry {
                binding: slot.binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("arrays"),
            layout: &self.layout.handle,
            entries: &entries,
        })
    }

    /// Sets the kernel and its arrays.
    pub(crate) fn bind(&self, pass: &mut wgpu::ComputePass<'_>, group: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        if let Some(structures) = &self.structures {
            pass.set_bind_group(1, structures, &[]);
        }
    }

    /// Runs a thread for each of `count`.
    pub(crate) fn run(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        group: &wgpu::BindGroup,
        count: usize,
    ) {
        let workgroups = u32::try_from(count.div_ceil(WORKGROUP)).unwrap_or(u32::MAX);
        self.bind(pass, group);
        pass.dispatch_workgroups(workgroups, 1, 1);
    }

    /// Runs as many workgroups as a buffer on the device says.
    pub(crate) fn run_indirect(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        group: &wgpu::BindGroup,
        workgroups: &wgpu::Buffer,
    ) {
        self.bind(pass, group);
        pass.dispatch_workgroups_indirect(workgroups, 0);
    }
}

/// Submits the commands that `record` records.
pub(crate) fn submit(
    gpu: &Gpu,
    record: impl FnOnce(&mut wgpu::ComputePass<'_>),
) -> Result<(), GpuError> {
    gpu.caught(|gpu| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        record(&mut encoder.begin_compute_pass(&Default::default()));
        gpu.queue.submit([encoder.finish()]);
    })
}

/// An array on the device.
pub(crate) fn array(gpu: &Gpu, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::STORAGE | usage,
        mapped_at_creation: false,
    })
}

/// Most bytes of an upload at once.
const CHUNK: usize = 1 << 24;

/// An array on the device with contents, and zeros up to a multiple of four bytes.
///
/// # Errors
/// Where memory does not suffice or the device was lost. (wgpu's `create_buffer_init` panics instead, and needs
/// memory for all of the contents once more.)
pub(crate) fn filled(
    gpu: &Gpu,
    label: &str,
    contents: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, GpuError> {
    let buffer = gpu.caught(|gpu| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: contents.len().next_multiple_of(4) as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    })?;
    for (chunk, index) in contents.chunks(CHUNK).zip(0_u64..) {
        let (whole, last) = chunk.split_at(chunk.len() / 4 * 4);
        let mut end = [0; 4];
        end[..last.len()].copy_from_slice(last);
        let place = index * CHUNK as u64;
        gpu.caught(|gpu| {
            gpu.queue.write_buffer(&buffer, place, whole);
            if !last.is_empty() {
                let place = place + whole.len() as u64;
                gpu.queue.write_buffer(&buffer, place, &end);
            }
            gpu.queue.submit([]);
        })?;
        // So that the next chunk reuses the staging memory of this one.
        gpu.wait()?;
    }
    Ok(buffer)
}
