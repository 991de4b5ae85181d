//! Memory that ends: of a GPU in software it is the process's, which the system can be told to limit.

use super::*;
use crate::AdapterKind;

#[path = "../../../tests/common/limited.rs"]
mod limited;

use limited::{Limit, MIB, is_alone};

/// The GPU, in a process that has this test alone; `None` in the one that started it, where all is done.
fn gpu_alone(test: &str) -> Option<&'static Gpu> {
    let gpu = common::gpu("the tracer's memory")?;
    is_alone(gpu, &format!("tracer::tests::memory::{test}")).then_some(gpu)
}

#[test]
fn what_rust_says_at_an_abort_is_understood() {
    let said = "GPU 0\nmemory allocation of 946176 bytes failed\nstack backtrace:";
    assert_eq!(limited::lacked(said), Some(946_176));
    assert_eq!(limited::lacked("panicked"), None);
}

#[test]
fn batches_shrink_to_what_memory_holds() {
    let Some(gpu) = gpu_alone("batches_shrink_to_what_memory_holds") else {
        return;
    };
    let options = RenderOptions {
        resolution: Some([112, 96]),
        max_depth: 1,
        ..RenderOptions::from_scene(&room())
    };
    let prepared = PreparedScene::new(&room(), &options).unwrap();
    let all = 64 * 112 * 96;
    let schedule = Schedule::Queues;
    let mut render = Render::new(gpu, &prepared, &options, schedule, str::to_owned);
    let mut film = || {
        let mut renderer = Renderer::new(&prepared, options.clone());
        render.tracer.samples = all;
        let go = AtomicBool::new(false);
        let report = render.tracer.render_pass(&mut renderer, 64, &go);
        assert!(report.unwrap().complete);
        render.tracer.batch = None;
        gpu.wait().unwrap();
        (renderer.film().clone(), render.tracer.largest)
    };
    let (right, largest) = film();
    assert!(largest >= all, "{largest} though there is memory");
    // A batch of all samples takes twice as much.
    let limit = Limit::new(64 * MIB);
    let (film, largest) = film();
    limit.lift();
    assert!(largest < all, "memory sufficed");
    assert!(film == right);
}

#[test]
fn scenes_that_memory_does_not_hold_are_errors_and_leave_the_device_whole() {
    let name = "scenes_that_memory_does_not_hold_are_errors_and_leave_the_device_whole";
    let Some(gpu) = gpu_alone(name) else { return };
    let scene = room();
    let options = RenderOptions::from_scene(&scene);
    let prepared = PreparedScene::new(&scene, &options).unwrap();
    let mut program = SceneProgram::new(&prepared, &options).unwrap();
    let text = program.text().unwrap();
    let texts = [text.as_str(), program::SUMS];
    let schedule = (Schedule::Auto, None);
    // As large as the device takes: what matters is the size.
    let size = gpu.adapter.largest_array.min(128 * MIB);
    program
        .flat
        .words
        .resize(usize::try_from(size / 4).unwrap(), 0);
    assert!(Tracer::of_texts(gpu, &program, &options, schedule, texts).is_ok());
    gpu.wait().unwrap();
    let limit = Limit::new(size / 2);
    let schedule = (Schedule::Auto, None);
    let error = Tracer::of_texts(gpu, &program, &options, schedule, texts).unwrap_err();
    assert!(
        matches!(error, TracerError::Gpu(GpuError::OutOfMemory(_))),
        "{error:?}"
    );
    let said = error.to_string();
    assert!(said.starts_with("the GPU is out of memory"), "{said}");
    limit.lift();
    let schedule = (Schedule::Auto, None);
    assert!(Tracer::of_texts(gpu, &program, &options, schedule, texts).is_ok());
}

#[test]
fn arrays_that_memory_does_not_hold_are_errors() {
    let Some(gpu) = gpu_alone("arrays_that_memory_does_not_hold_are_errors") else {
        return;
    };
    let size = 64 << 20;
    let usage = wgpu::BufferUsages::COPY_SRC;
    let contents = vec![1; size];
    let whole = crate::stage::filled(gpu, "whole", &contents, usage).unwrap();
    gpu.wait().unwrap();
    let limit = Limit::new(size as u64 / 2);
    for error in [
        crate::stage::filled(gpu, "more", &contents, usage).unwrap_err(),
        gpu.read(&whole, size as u64).unwrap_err(),
    ] {
        assert!(matches!(error, GpuError::OutOfMemory(_)), "{error:?}");
    }
    limit.lift();
    assert_eq!(gpu.read(&whole, size as u64).unwrap(), contents);
}
