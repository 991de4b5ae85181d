//! The GPU of the tests, where it offers ray queries.

use std::sync::LazyLock;

use specula_gpu::{AdapterChoice, Gpu, adapters};

/// One that offers ray queries, beside the GPU of the tests that does not.
static BESIDE: LazyLock<Option<Gpu>> = LazyLock::new(|| {
    let adapter = adapters().into_iter().find(|a| a.ray_queries)?;
    Gpu::open(&AdapterChoice::Index(adapter.index)).ok()
});

/// The GPU of the tests, or another where that offers no ray queries; where none does, a loud line that `what` is
/// skipped.
///
/// # Panics
/// Where there are none though `SPECULA_RAY_QUERIES` asks for them, by `require` or `all`.
#[track_caller]
pub(crate) fn gpu_with_queries(what: &str) -> Option<&'static Gpu> {
    let gpu = super::common::gpu(what);
    if let Some(gpu) = gpu.filter(|gpu| gpu.has_ray_queries()) {
        return Some(gpu);
    }
    if let Some(gpu) = &*BESIDE {
        return Some(gpu);
    }
    let required = std::env::var("SPECULA_RAY_QUERIES").is_ok_and(|v| v == "require" || v == "all");
    assert!(
        !required,
        "SPECULA_RAY_QUERIES asks for them, but no GPU offers them"
    );
    if gpu.is_some() {
        specula_testing::skip(
            what,
            "no GPU offers ray queries",
            "Mesa's software GPU has them from 25.0 on: on Debian 12, apt-get install -t \
             bookworm-backports mesa-vulkan-drivers",
        );
    }
    None
}
