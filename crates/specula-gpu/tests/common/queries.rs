//! The GPU of the tests, where it offers ray queries.

use specula_gpu::Gpu;

/// The GPU; where there is none or it offers no ray queries, a loud line that `what` is skipped.
///
/// # Panics
/// Where there are none though `SPECULA_RAY_QUERIES` asks for them, by `require` or `all`.
#[track_caller]
pub(crate) fn gpu_with_queries(what: &str) -> Option<&'static Gpu> {
    let gpu = super::common::gpu(what);
    if let Some(gpu) = gpu.filter(|gpu| gpu.has_ray_queries()) {
        return Some(gpu);
    }
    let required = std::env::var("SPECULA_RAY_QUERIES").is_ok_and(|v| v == "require" || v == "all");
    assert!(
        !required,
        "SPECULA_RAY_QUERIES asks for them, but the GPU offers none"
    );
    if gpu.is_some() {
        specula_testing::skip(
            what,
            "the GPU offers no ray queries",
            "Mesa's software GPU has them from 25.0 on: on Debian 12, apt-get install -t \
             bookworm-backports mesa-vulkan-drivers",
        );
    }
    None
}
