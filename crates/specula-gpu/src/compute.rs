//! One compute kernel over arrays: upload, run, read back.

use std::borrow::Cow;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use crate::adapter::{Gpu, GpuError};
use crate::dead_branches;
use crate::queries::Structures;
use crate::shader::{Shader, Slot};
use crate::stage::{RayBindings, Stage, filled, layout};

/// A compiled compute shader that reads arrays and writes one.
///
/// In group 0 the bindings `0..inputs` are the arrays that it reads
/// (`var<storage, read>`), and the binding `inputs` is the one that it writes
/// (`var<storage, read_write>`). It need not use all of them.
#[derive(Debug)]
pub struct ComputeKernel {
    label: String,
    inputs: usize,
    stage: Stage,
}

/// The arrays of a [`ComputeKernel`], on the device.
#[derive(Debug)]
pub struct Arrays {
    group: wgpu::BindGroup,
    output: wgpu::Buffer,
}

impl Gpu {
    /// Compiles WGSL, without branches that its constants rule out; of the same text the second time, the first
    /// shader.
    ///
    /// # Errors
    /// [`GpuError::Shader`] with the compiler's text where it does not compile.
    pub fn shader(&self, label: &str, source: &str) -> Result<Shader, GpuError> {
        self.check()?;
        self.shaders.get(source, || {
            // What is no WGSL is refused with the text that tells where.
            let source = match dead_branches::parsed(source) {
                Some(module) => wgpu::ShaderSource::Naga(Cow::Owned(module)),
                None => wgpu::ShaderSource::Wgsl(source.into()),
            };
            let module = self.caught(|gpu| {
                gpu.device
                    .create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: Some(label),
                        source,
                    })
            });
            module.map_err(|error| error.of_shader(label))
        })
    }

    /// Copies the first `size` bytes of a buffer here; its usage must include `COPY_SRC`.
    ///
    /// # Errors
    /// Where memory does not suffice or the device was lost.
    pub fn read(&self, buffer: &wgpu::Buffer, size: u64) -> Result<Vec<u8>, GpuError> {
        let (staging, submission) = self.caught(|gpu| {
            let staging = gpu.staging(size);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, size);
            (staging, gpu.queue.submit([encoder.finish()]))
        })?;
        self.fetched(&staging, size, submission, <[u8]>::to_vec)
    }

    /// A buffer to be read here.
    pub(crate) fn staging(&self, size: u64) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// The first bytes of a staging buffer, once the submission that writes it is done.
    pub(crate) fn fetched<T>(
        &self,
        staging: &wgpu::Buffer,
        size: u64,
        submission: wgpu::SubmissionIndex,
        read: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, GpuError> {
        let (sender, receiver) = channel();
        self.caught(|_| {
            staging.map_async(wgpu::MapMode::Read, ..size, move |mapped| {
                // The receiver waits below; where it is gone, so is the interest.
                let _ = sender.send(mapped);
            });
        })?;
        let lost = |reason: &dyn std::fmt::Display| GpuError::Lost(reason.to_string());
        // Where several threads wait, another one may be about to make the call.
        let mapped = loop {
            self.wait_for(Some(submission.clone()))?;
            match receiver.recv_timeout(Duration::from_millis(10)) {
                Err(RecvTimeoutError::Timeout) => {}
                other => break other,
            }
        };
        mapped.map_err(|e| lost(&e))?.map_err(|e| lost(&e))?;
        let view = staging.get_mapped_range(..size).map_err(|e| lost(&e))?;
        let value = read(&view);
        drop(view);
        staging.unmap();
        Ok(value)
    }
}

impl ComputeKernel {
    /// Compiles the entry point `entry` of a shader that reads so many arrays.
    ///
    /// # Errors
    /// [`GpuError::Shader`] where the driver does not compile it.
    pub fn new(gpu: &Gpu, shader: &Shader, entry: &str, inputs: usize) -> Result<Self, GpuError> {
        Self::build(gpu, shader, entry, inputs, None)
    }

    /// The same for a shader that casts rays by queries: in group 1 the binding 0 is the scene's
    /// `acceleration_structure`.
    ///
    /// # Errors
    /// [`GpuError::Shader`] where the driver does not compile it.
    pub fn with_structures(
        gpu: &Gpu,
        shader: &Shader,
        entry: &str,
        inputs: usize,
        structures: &Structures,
    ) -> Result<Self, GpuError> {
        Self::build(gpu, shader, entry, inputs, Some(structures.bindings()))
    }

    fn build(
        gpu: &Gpu,
        shader: &Shader,
        entry: &str,
        inputs: usize,
        structures: Option<&RayBindings>,
    ) -> Result<Self, GpuError> {
        let slots = (0_u32..).zip(0..=inputs).map(|(binding, place)| Slot {
            binding,
            is_written: place >= inputs,
        });
        let layout = layout(gpu, slots).map_err(|error| error.of_shader(entry))?;
        Ok(Self {
            label: entry.to_owned(),
            inputs,
            stage: Stage::new(gpu, &layout, shader, entry, structures)?,
        })
    }

    /// Uploads what the kernel reads and makes room for what it writes, cleared to 0.
    ///
    /// * `inputs`: bytes of each array, in the order of the bindings; no array is empty.
    /// * `output`: size in bytes of the array that is written, a multiple of 4.
    ///
    /// # Errors
    /// Where the number of arrays is not the kernel's or memory does not suffice.
    pub fn upload(&self, gpu: &Gpu, inputs: &[&[u8]], output: u64) -> Result<Arrays, GpuError> {
        if inputs.len() != self.inputs {
            return Err(GpuError::Refused(format!(
                "kernel '{}' reads {} arrays, got {}",
                self.label,
                self.inputs,
                inputs.len()
            )));
        }
        let read = |contents: &&[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            filled(gpu, &self.label, contents, usage)
        };
        let mut buffers = inputs.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        gpu.caught(|gpu| {
            let output = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&self.label),
                size: output,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            buffers.push(output.clone());
            let buffers: Vec<_> = buffers.iter().collect();
            let group = self.stage.group(gpu, &buffers);
            Arrays { group, output }
        })
    }

    /// Runs the kernel and waits for it.
    ///
    /// # Errors
    /// Where the device refuses the number of workgroups or is lost.
    pub fn run(&self, gpu: &Gpu, arrays: &Arrays, workgroups: [u32; 3]) -> Result<(), GpuError> {
        gpu.caught(|gpu| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some(&self.label),
                    timestamp_writes: None,
                });
                self.stage.bind(&mut pass, &arrays.group);
                let [x, y, z] = workgroups;
                pass.dispatch_workgroups(x, y, z);
            }
            gpu.queue.submit([encoder.finish()]);
        })?;
        gpu.wait()
    }
}

impl Arrays {
    /// The bytes that the kernel wrote.
    ///
    /// # Errors
    /// Where memory does not suffice or the device was lost.
    pub fn output(&self, gpu: &Gpu) -> Result<Vec<u8>, GpuError> {
        gpu.read(&self.output, self.output.size())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common;

    const DOUBLING: &str = "
        @group(0) @binding(0) var<storage, read> numbers: array<f32>;
        @group(0) @binding(1) var<storage, read_write> doubled: array<f32>;
        @compute @workgroup_size(4)
        fn main(@builtin(global_invocation_id) place: vec3u) {
            doubled[place.x] = 2.0 * numbers[place.x];
        }";

    #[test]
    fn a_kernel_reads_and_writes_arrays() {
        let Some(gpu) = common::gpu("kernels") else {
            return;
        };
        let shader = gpu.shader("doubling", DOUBLING).unwrap();
        let kernel = ComputeKernel::new(gpu, &shader, "main", 1).unwrap();
        let numbers = [1.0_f32, -2.5, 3.0, 1e30];
        let bytes = bytemuck::bytes_of(&numbers);
        let arrays = kernel.upload(gpu, &[bytes], 16).unwrap();
        kernel.run(gpu, &arrays, [1, 1, 1]).unwrap();
        let output = arrays.output(gpu).unwrap();
        let doubled: &[f32] = bytemuck::cast_slice(&output);
        assert_eq!(doubled, numbers.map(|x| 2.0 * x));
    }

    #[test]
    fn mistakes_are_errors_and_leave_the_device_whole() {
        let Some(gpu) = common::gpu("kernels") else {
            return;
        };
        let wrong = gpu
            .shader("wrong", "fn main() { undefined(); }")
            .unwrap_err();
        assert!(
            matches!(&wrong, GpuError::Shader { label, text }
                if label == "wrong" && text.contains("undefined")),
            "{wrong}"
        );
        let shader = gpu.shader("doubling", DOUBLING).unwrap();
        let missing = ComputeKernel::new(gpu, &shader, "absent", 1);
        assert!(matches!(missing, Err(GpuError::Shader { .. })));
        let kernel = ComputeKernel::new(gpu, &shader, "main", 1).unwrap();
        let too_few = kernel.upload(gpu, &[], 16);
        assert!(matches!(too_few, Err(GpuError::Refused(_))));
        let too_large = kernel.upload(gpu, &[&[0; 16]], 1 << 50);
        assert!(matches!(
            too_large,
            Err(GpuError::Refused(_) | GpuError::OutOfMemory(_))
        ));
        let arrays = kernel.upload(gpu, &[&[0; 16]], 16).unwrap();
        let too_many = kernel.run(gpu, &arrays, [1 << 30, 1, 1]);
        assert!(matches!(too_many, Err(GpuError::Refused(_))));
        assert!(kernel.run(gpu, &arrays, [1, 1, 1]).is_ok());
    }
}
