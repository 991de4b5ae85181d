//! The GPU of the tests.

use std::io::Write as _;
use std::sync::LazyLock;

use specula_gpu::{Gpu, GpuError};

/// One for all tests, `Err` where the machine has none.
///
/// `SPECULA_GPU_ADAPTER` chooses one by its place or a part of its name; else the best one.
static GPU: LazyLock<Result<Gpu, GpuError>> = LazyLock::new(|| {
    let choice = std::env::var("SPECULA_GPU_ADAPTER").unwrap_or_else(|_| "best".to_owned());
    let gpu = Gpu::open(&choice.parse().unwrap_or_default());
    if let Ok(gpu) = &gpu {
        say(&format!("GPU {}", gpu.adapter));
    }
    gpu
});

/// A line that is seen though the test passes.
fn say(line: &str) {
    // Not `eprintln`, whose output tests keep to themselves.
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// The GPU; where there is none, a loud line that `what` is skipped.
///
/// # Panics
/// Where there is none though `SPECULA_GPU=require` asks for it.
#[track_caller]
pub(crate) fn gpu(what: &str) -> Option<&'static Gpu> {
    match &*GPU {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            let required = std::env::var("SPECULA_GPU").is_ok_and(|v| v == "require");
            assert!(!required, "SPECULA_GPU=require, but: {error}");
            specula_testing::skip(what, error, "apt-get install mesa-vulkan-drivers");
            None
        }
    }
}
