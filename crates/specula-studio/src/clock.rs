//! The time, also where the standard library has no clock.

/// Seconds since some moment, which stays the same.
pub(crate) fn seconds() -> f64 {
    #[cfg(not(target_arch = "wasm32"))]
    {
        static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
        START
            .get_or_init(std::time::Instant::now)
            .elapsed()
            .as_secs_f64()
    }
    #[cfg(target_arch = "wasm32")]
    {
        crate::wasm::milliseconds() * 1e-3
    }
}
