//! Shaders and kernels that a device has compiled. The same text is compiled once, so that renders that differ by their
//! seed alone share what was compiled.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Shaders that a device keeps, with their kernels: enough for the parts of a scene and its variants side by side.
const MOST: usize = 16;

/// A compiled shader. Clones share it and its kernels.
#[derive(Clone, Debug)]
pub struct Shader(Arc<Compiled>);

#[derive(Debug)]
struct Compiled {
    text: String,
    module: wgpu::ShaderModule,
    kernels: Mutex<Vec<(Entry, wgpu::ComputePipeline)>>,
}

/// An array of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot {
    pub(crate) binding: u32,
    pub(crate) is_written: bool,
}

/// An entry point, and how its arrays are bound.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) slots: Vec<Slot>,
    /// Whether it casts rays by ray queries.
    pub(crate) casts_queries: bool,
}

impl Shader {
    /// The kernel of an entry point, made if there is none yet.
    pub(crate) fn kernel<E>(
        &self,
        entry: Entry,
        make: impl FnOnce(&wgpu::ShaderModule) -> Result<wgpu::ComputePipeline, E>,
    ) -> Result<wgpu::ComputePipeline, E> {
        // Locked while it compiles: who wants the same kernel waits for it.
        let mut kernels = locked(&self.0.kernels);
        if let Some((_, kernel)) = kernels.iter().find(|(e, _)| *e == entry) {
            return Ok(kernel.clone());
        }
        let kernel = make(&self.0.module)?;
        kernels.push((entry, kernel.clone()));
        Ok(kernel)
    }
}

/// The shaders of a device, the latest used last.
#[derive(Debug, Default)]
pub(crate) struct Shaders(Mutex<Vec<Shader>>);

impl Shaders {
    /// The shader of a text, made if there is none yet.
    pub(crate) fn get<E>(
        &self,
        text: &str,
        make: impl FnOnce() -> Result<wgpu::ShaderModule, E>,
    ) -> Result<Shader, E> {
        let mut shaders = locked(&self.0);
        let shader = match shaders.iter().position(|s| s.0.text == text) {
            Some(place) => shaders.remove(place),
            None => Shader(Arc::new(Compiled {
                text: text.to_owned(),
                module: make()?,
                kernels: Mutex::default(),
            })),
        };
        if shaders.len() >= MOST {
            shaders.remove(0);
        }
        shaders.push(shader.clone());
        Ok(shader)
    }
}

fn locked<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::adapter::GpuError;
    use crate::common;

    /// A shader that writes a number.
    fn text(number: usize) -> String {
        format!(
            "@group(0) @binding(0) var<storage, read_write> written: array<u32>;
            @compute @workgroup_size(1) fn main() {{ written[0] = {number}u; }}
            @compute @workgroup_size(1) fn other() {{ written[1] = {number}u; }}"
        )
    }

    #[test]
    fn the_same_text_is_compiled_once() {
        let Some(gpu) = common::gpu("compiled shaders") else {
            return;
        };
        let slot = |binding| Slot {
            binding,
            is_written: true,
        };
        let shader = |number| gpu.shader("numbers", &text(number)).unwrap();
        let kernel = |shader: &Shader, name, slots: &[Slot]| {
            let layout = crate::stage::layout(gpu, slots.iter().copied()).unwrap();
            let stage = crate::stage::Stage::new(gpu, &layout, shader, name, None);
            stage.unwrap().pipeline().clone()
        };
        let main = kernel(&shader(1), "main", &[slot(0)]);
        assert!(main == kernel(&shader(1), "main", &[slot(0)]));
        assert!(main != kernel(&shader(1), "other", &[slot(0)]));
        assert!(main != kernel(&shader(1), "main", &[slot(0), slot(1)]));
        assert!(main != kernel(&shader(2), "main", &[slot(0)]));
    }

    #[test]
    fn the_latest_shaders_are_kept() {
        let Some(gpu) = common::gpu("compiled shaders") else {
            return;
        };
        let shaders = Shaders::default();
        let shader = |number| {
            let text = text(number);
            let source = wgpu::ShaderSource::Wgsl(text.as_str().into());
            let make = || -> Result<_, GpuError> {
                gpu.caught(|gpu| {
                    let device = &gpu.device;
                    device.create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: None,
                        source,
                    })
                })
            };
            shaders.get(&text, make).unwrap()
        };
        let first = shader(0);
        for number in 1..MOST {
            shader(number);
        }
        assert!(Arc::ptr_eq(&first.0, &shader(0).0), "among the latest");
        let second = shader(1);
        for number in 0..MOST {
            shader(100 + number);
        }
        assert!(
            !Arc::ptr_eq(&second.0, &shader(1).0),
            "not among the latest"
        );
        assert!(locked(&shaders.0).len() == MOST);
    }
}
