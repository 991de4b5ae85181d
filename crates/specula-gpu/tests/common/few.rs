//! What a GPU in software renders: few pictures, as it compiles a shader for each, for up to a minute.

use specula_gpu::AdapterKind;

use crate::common::gpu;

/// Whether all pictures are rendered: by a real GPU, and with `SPECULA_GPU_PICTURES=all`.
pub(crate) fn renders_all() -> bool {
    let all = std::env::var("SPECULA_GPU_PICTURES").is_ok_and(|v| v == "all");
    all || gpu("all pictures").is_some_and(|gpu| gpu.adapter.kind != AdapterKind::Software)
}

/// Of variants those that are rendered: the first `few` where not all are.
pub(crate) fn some<T, const N: usize>(variants: [T; N], few: usize) -> impl Iterator<Item = T> {
    let count = if renders_all() { N } else { few };
    variants.into_iter().take(count)
}
