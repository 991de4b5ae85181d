//! Instruction sets that loops over batches are compiled for.

/// Compiles a function for AVX-512, for AVX2 and for the baseline; the machine's best is called.
///
/// ```ignore
/// #[apply(simd_levels)]
/// fn add(a: &mut [f32], b: &[f32]) { .. }
/// ```
macro_rules! simd_levels {
    ($($function:tt)*) => {
        #[multiversion::multiversion(targets(
            "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2",
            "x86_64+avx2+fma+bmi1+bmi2"
        ))]
        $($function)*
    };
}

pub(crate) use simd_levels;
