//! The functions over lobes: eval, pdf, both, and sample.

use core::marker::PhantomData;

use super::kernels::{Eval, EvalPdf, Pdf, Sample, SampleWi};
use super::level::{Arithmetic, Level, Task};
use super::lobes::{Kernel, Lobes};
use super::slices::{Colours, Directions, LengthMismatch, SampleOutcome, Samples, check};
#[cfg(doc)]
use crate::bsdf::Bsdf;
use crate::bsdf::Transport;
use crate::math::Real;

const WO: [&str; 3] = ["wo.x", "wo.y", "wo.z"];
const WI: [&str; 3] = ["wi.x", "wi.y", "wi.z"];
const F_COS: [&str; 3] = ["f_cos.r", "f_cos.g", "f_cos.b"];

impl Level {
    /// [`Bsdf::eval`] of every element: `f(wo, wi) |cos theta_i|` in 1/sr.
    ///
    /// * `wo: (n, 3) T`, `wi: (n, 3) T -> f_cos: (n, 3) T`
    ///
    /// # Errors
    /// Where a slice is not as long as `f_cos.r`; nothing is written then.
    pub fn eval<T: Real, L: Lobes<T>>(
        self,
        lobes: &L,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        transport: Transport,
        f_cos: Colours<&mut [T]>,
    ) -> Result<(), LengthMismatch> {
        let n = f_cos.r.len();
        check(n, f_cos.lengths(F_COS))?;
        check(n, wo.lengths(WO).into_iter().chain(wi.lengths(WI)))?;
        lobes.check(n)?;
        let kernel = Eval {
            wo,
            wi,
            transport,
            f_cos,
        };
        self.run(Over::new(lobes, n, kernel));
        Ok(())
    }

    /// [`Bsdf::pdf`] of every element, in 1/sr.
    ///
    /// * `wo: (n, 3) T`, `wi: (n, 3) T -> pdf: (n,) T`
    ///
    /// # Errors
    /// Where a slice is not as long as `pdf`; nothing is written then.
    pub fn pdf<T: Real, L: Lobes<T>>(
        self,
        lobes: &L,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        let n = pdf.len();
        check(n, wo.lengths(WO).into_iter().chain(wi.lengths(WI)))?;
        lobes.check(n)?;
        let kernel = Pdf { wo, wi, pdf };
        self.run(Over::new(lobes, n, kernel));
        Ok(())
    }

    /// [`Bsdf::eval_pdf`] of every element: [`eval`](Level::eval) and [`pdf`](Level::pdf) at the
    /// price of little more than one.
    ///
    /// * `wo: (n, 3) T`, `wi: (n, 3) T -> f_cos: (n, 3) T`, `pdf: (n,) T`
    ///
    /// # Errors
    /// Where a slice is not as long as `f_cos.r`; nothing is written then.
    pub fn eval_pdf<T: Real, L: Lobes<T>>(
        self,
        lobes: &L,
        wo: Directions<&[T]>,
        wi: Directions<&[T]>,
        transport: Transport,
        f_cos: Colours<&mut [T]>,
        pdf: &mut [T],
    ) -> Result<(), LengthMismatch> {
        let n = f_cos.r.len();
        check(n, f_cos.lengths(F_COS))?;
        check(n, [("pdf", pdf.len())])?;
        check(n, wo.lengths(WO).into_iter().chain(wi.lengths(WI)))?;
        lobes.check(n)?;
        let kernel = EvalPdf {
            wo,
            wi,
            transport,
            f_cos,
            pdf,
        };
        self.run(Over::new(lobes, n, kernel));
        Ok(())
    }

    /// [`Bsdf::sample`] of every element: directions, densities and weights. A rejected sample is
    /// [`SampleOutcome::Rejected`] with `wi`, `weight` and `pdf` all zero.
    ///
    /// * `wo: (n, 3) T`, `u: (n, 3) T` in `[0, 1)` `-> wi: (n, 3) T`, `weight: (n, 3) T`,
    ///   `pdf: (n,) T`, `outcome: (n,) u8`
    ///
    /// # Errors
    /// Where a slice is not as long as `wi.x`; nothing is written then.
    pub fn sample<T: Real, L: Lobes<T>>(
        self,
        lobes: &L,
        wo: Directions<&[T]>,
        u: [&[T]; 3],
        transport: Transport,
        samples: Samples<&mut [T], &mut [SampleOutcome]>,
    ) -> Result<(), LengthMismatch> {
        let n = samples.pdf.len();
        check(n, samples.lengths())?;
        check(n, wo.lengths(WO))?;
        check(
            n,
            ["u[0]", "u[1]", "u[2]"].into_iter().zip(u.map(<[T]>::len)),
        )?;
        lobes.check(n)?;
        let kernel = Sample {
            wo,
            u,
            transport,
            samples,
        };
        self.run(Over::new(lobes, n, kernel));
        Ok(())
    }

    /// The directions alone of [`sample`](Level::sample): `(0, 0, 0)` where rejected.
    ///
    /// * `wo: (n, 3) T`, `u: (n, 3) T` in `[0, 1)` `-> wi: (n, 3) T`
    ///
    /// # Errors
    /// Where a slice is not as long as `wi.x`; nothing is written then.
    pub fn sample_wi<T: Real, L: Lobes<T>>(
        self,
        lobes: &L,
        wo: Directions<&[T]>,
        u: [&[T]; 3],
        transport: Transport,
        wi: Directions<&mut [T]>,
    ) -> Result<(), LengthMismatch> {
        let n = wi.x.len();
        check(n, wi.lengths(WI))?;
        check(n, wo.lengths(WO))?;
        check(
            n,
            ["u[0]", "u[1]", "u[2]"].into_iter().zip(u.map(<[T]>::len)),
        )?;
        lobes.check(n)?;
        let kernel = SampleWi {
            wo,
            u,
            transport,
            wi,
        };
        self.run(Over::new(lobes, n, kernel));
        Ok(())
    }
}

/// A kernel over `n` lobes, as a task for a level.
struct Over<'a, T, L, K> {
    lobes: &'a L,
    n: usize,
    kernel: K,
    scalar: PhantomData<T>,
}

impl<'a, T: Real, L: Lobes<T>, K: Kernel> Over<'a, T, L, K> {
    fn new(lobes: &'a L, n: usize, kernel: K) -> Self {
        Self {
            lobes,
            n,
            kernel,
            scalar: PhantomData,
        }
    }
}

impl<T: Real, L: Lobes<T>, K: Kernel> Task for Over<'_, T, L, K> {
    #[inline(always)]
    fn run<A: Arithmetic>(self) {
        self.lobes.run::<A, K>(self.n, self.kernel);
    }
}
