//! The instruction sets that the kernels are compiled for, and the choice among them.

use core::fmt;

#[cfg(feature = "std")]
use multiversion::multiversion;
#[cfg(feature = "std")]
use multiversion::target::match_target;

use crate::math::Real;

/// A set of vector instructions that the batch kernels are compiled for.
///
/// The two upper levels multiply and add in one rounding, and agree with each other bit for bit;
/// [`Level::Baseline`] agrees bit for bit with the scalar functions. Without the feature `std` there
/// is the baseline alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Level {
    /// What the crate is compiled for: by default SSE2 on x86-64, NEON on aarch64.
    Baseline,
    /// AVX2 with fused multiply-add (x86-64-v3): 8 lanes of `f32`, 4 of `f64`.
    Avx2,
    /// AVX-512 (x86-64-v4, Ice Lake and later): 16 lanes of `f32`, 8 of `f64`.
    Avx512,
}

impl Level {
    /// Every level, the slowest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The best level that this machine runs.
    #[inline]
    pub fn best() -> Self {
        highest()
    }

    /// Whether this machine runs it. One that it does not run works as the best below it.
    pub fn is_available(self) -> bool {
        self <= highest()
    }

    /// Runs a task compiled for this level.
    #[inline]
    pub(super) fn run(self, task: impl Task) {
        #[cfg(feature = "std")]
        match self {
            Self::Baseline => baseline(task),
            Self::Avx2 => avx2(task),
            Self::Avx512 => avx512(task),
        }
        #[cfg(not(feature = "std"))]
        baseline(task);
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "AVX2",
            Self::Avx512 => "AVX-512",
        })
    }
}

/// Which scalar stands in for `f32` and `f64` within a kernel.
pub trait Arithmetic {
    /// The scalar to compute in.
    type Of<T: Real>: Real;
}

/// The scalars as they are.
pub(super) struct Plain;

/// Fused multiply-add.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub(super) struct Fusing;

impl Arithmetic for Plain {
    type Of<T: Real> = T;
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl Arithmetic for Fusing {
    type Of<T: Real> = T::Fused;
}

/// A loop over slices, to be compiled once per level. Its `run` must be inlined, so that it takes
/// on the instructions of the function that calls it.
pub(super) trait Task {
    fn run<A: Arithmetic>(self);
}

/// Compiles a function once for each of the named instruction sets, and once for the baseline. It
/// chooses among them where it runs.
///
/// Left to itself, LLVM uses 512-bit registers with the features of `avx512`: the preference for 256
/// bits belongs to named processors only.
#[cfg(feature = "std")]
macro_rules! compiled_for {
    ([$($level:ident)*] $($function:tt)*) => {
        compiled_for!(@targets [] [$($level)*] $($function)*);
    };
    (@targets [$($target:literal)*] [avx512 $($rest:ident)*] $($function:tt)*) => {
        compiled_for!(
            @targets
            [$($target)* "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+fma+bmi1+bmi2"]
            [$($rest)*]
            $($function)*
        );
    };
    (@targets [$($target:literal)*] [avx2 $($rest:ident)*] $($function:tt)*) => {
        compiled_for!(
            @targets
            [$($target)* "x86_64+avx2+fma+bmi1+bmi2"]
            [$($rest)*]
            $($function)*
        );
    };
    (@targets [$($target:literal)*] [] $($function:tt)*) => {
        #[multiversion(targets($($target),*))]
        $($function)*
    };
}

// Each level falls back to the one below by a call, so that every task is compiled three times in all.

#[cfg(feature = "std")]
compiled_for! {
    [avx512]
    fn avx512<K: Task>(task: K) {
        match_target! {
            "x86_64+avx512f" => task.run::<Fusing>(),
            _ => avx2(task),
        }
    }
}

#[cfg(feature = "std")]
compiled_for! {
    [avx2]
    fn avx2<K: Task>(task: K) {
        match_target! {
            "x86_64+fma" => task.run::<Fusing>(),
            _ => baseline(task),
        }
    }
}

#[inline(never)]
fn baseline<K: Task>(task: K) {
    task.run::<Plain>();
}

#[cfg(feature = "std")]
compiled_for! {
    [avx512 avx2]
    fn highest() -> Level {
        match_target! {
            "x86_64+avx512f" => Level::Avx512,
            "x86_64+avx2" => Level::Avx2,
            _ => Level::Baseline,
        }
    }
}

/// Without the standard library nobody knows what the machine runs.
#[cfg(not(feature = "std"))]
fn highest() -> Level {
    Level::Baseline
}
