//! Consent to an interface of wgpu that is not finished.
#![allow(
    unsafe_code,
    reason = "wgpu asks for consent by a function that is unsafe to call"
)]

/// Lets a device be opened with ray queries.
pub(crate) fn consent() -> wgpu::ExperimentalFeatures {
    // SAFETY: the call does nothing but to state that we know of possible faults in what it allows. Of that
    // we ask for ray queries alone. Shaders stay validated, and naga checks at run time that queries
    // are used in order (`ray_query_initialization_tracking`, on by default).
    unsafe { wgpu::ExperimentalFeatures::enabled() }
}
