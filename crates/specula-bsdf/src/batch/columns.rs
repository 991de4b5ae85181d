//! Lobes that differ from element to element in all that they have, or that look up tables of more than the cosine.
//!
//! A table's place differs from lane to lane, which no loop of vectors may have. So a batch is in stages, each a loop over a
//! short chunk: the elements' numbers are put into columns; places in tables are computed in vectors; what lies there is
//! looked up one after the other; and the rest is vectors again. Elements of a lobe's rarer forms are computed one by one
//! at the end.
#![allow(
    clippy::needless_range_loop,
    reason = "an index below the arrays' length is what the compiler makes vectors of"
)]

use super::kernels::{EvalPdf, Sample, range, triple};
use super::level::Arithmetic;
use super::lobes::{Kernel, Lobes};
use super::recast::convert;
use super::slices::{Directions, LengthMismatch, check};
use crate::bsdf::in_columns::InColumns;
use crate::bsdf::{BsdfSample, Gltf, Principled};
use crate::math::{Real, Rgb, Vec3};

/// Elements between two stages, few enough for their columns to stay in the nearest cache.
const CHUNK: usize = 128;

/// A lobe that each element has its own: any array of them.
///
/// Element `i` is `lobes[i]`, exactly at every level. Vectors are [`Gltf`] without coat, sheen and transmission, and
/// [`Principled`] that is closed and does not transmit; their other forms are computed one by one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Each<'a, L>(pub &'a [L]);

/// Lobes by index.
#[doc(hidden)]
pub trait LobeAt<L>: Copy {
    /// The lobe at `i`.
    fn at(&self, i: usize) -> &L;
}

/// The same for all.
#[derive(Clone, Copy)]
struct One<'a, L>(&'a L);

impl<L: Copy> LobeAt<L> for One<'_, L> {
    #[inline(always)]
    fn at(&self, _i: usize) -> &L {
        self.0
    }
}

/// Each its own.
impl<L: Copy> LobeAt<L> for Each<'_, L> {
    #[inline(always)]
    fn at(&self, i: usize) -> &L {
        &self.0[i]
    }
}

/// The columns of a chunk.
struct Chunk<U, const N: usize, const P: usize, const Q: usize> {
    columns: [[U; CHUNK]; N],
    places: [[U; CHUNK]; P],
    /// Of the views, and of the directions to the light.
    looked_up: [[[U; CHUNK]; Q]; 2],
    /// The elements that are computed one by one.
    alone: [bool; CHUNK],
    alone_count: usize,
}

/// The numbers of an element. A plain loop of constant length, which is unrolled.
#[inline(always)]
fn at<U: Real, const N: usize>(columns: &[[U; CHUNK]; N], i: usize) -> [U; N] {
    let mut values = [U::ZERO; N];
    let mut c = 0;
    while c < N {
        values[c] = columns[c][i];
        c += 1;
    }
    values
}

#[inline(always)]
fn set<U: Real, const N: usize>(columns: &mut [[U; CHUNK]; N], i: usize, values: [U; N]) {
    let mut c = 0;
    while c < N {
        columns[c][i] = values[c];
        c += 1;
    }
}

/// The two directions of an element.
const VIEW: usize = 0;
const LIGHT: usize = 1;

impl<U: Real, const N: usize, const P: usize, const Q: usize> Chunk<U, N, P, Q> {
    #[inline(always)]
    fn new() -> Self {
        Self {
            columns: [[U::ZERO; CHUNK]; N],
            places: [[U::ZERO; CHUNK]; P],
            looked_up: [[[U::ZERO; CHUNK]; Q]; 2],
            alone: [false; CHUNK],
            alone_count: 0,
        }
    }

    /// Puts the elements from `start` to before `end` into the columns.
    #[inline(always)]
    fn load<L: InColumns<U, N, P, Q>>(
        &mut self,
        lobes: impl LobeAt<L>,
        start: usize,
        count: usize,
    ) {
        self.alone_count = 0;
        for i in 0..count.min(CHUNK) {
            let columns = lobes.at(start + i).columns();
            self.alone[i] = columns.is_none();
            self.alone_count += usize::from(columns.is_none());
            set(&mut self.columns, i, columns.unwrap_or([U::ZERO; N]));
        }
    }

    /// Asks the tables about directions: places in vectors, then one after the other what lies there.
    ///
    /// * `which`: [`VIEW`], or [`LIGHT`], of which those below the horizon are left out.
    #[inline(always)]
    fn look_up<T: Real, L: InColumns<U, N, P, Q>>(
        &mut self,
        lobes: impl LobeAt<L>,
        start: usize,
        which: usize,
        w: Directions<&[T]>,
    ) {
        if Q == 0 {
            return;
        }
        let count = w.x.len().min(CHUNK);
        let w = w.first(count);
        for i in 0..count {
            let places = L::places(at(&self.columns, i), w.get_as(i));
            set(&mut self.places, i, places);
        }
        for i in 0..count {
            let w: Vec3<U> = w.get_as(i);
            let is_asked = !self.alone[i] && (which == VIEW || w.z > U::ZERO);
            let values = if is_asked {
                lobes.at(start + i).look_up(at(&self.places, i), w)
            } else {
                [U::ZERO; Q]
            };
            set(&mut self.looked_up[which], i, values);
        }
    }

    #[inline(always)]
    fn eval_pdf<L: InColumns<U, N, P, Q>>(
        &self,
        i: usize,
        wo: Vec3<U>,
        wi: Vec3<U>,
    ) -> (Rgb<U>, U) {
        let looked_up = [at(&self.looked_up[VIEW], i), at(&self.looked_up[LIGHT], i)];
        L::eval_pdf_of(at(&self.columns, i), looked_up, wo, wi)
    }
}

#[inline(always)]
pub(super) fn eval_pdf<T, U, L, const N: usize, const P: usize, const Q: usize>(
    mut task: EvalPdf<'_, T>,
    lobes: impl LobeAt<L>,
) where
    T: Real,
    U: Real,
    L: InColumns<U, N, P, Q>,
{
    let n = task.pdf.len();
    let mut chunk = Chunk::<U, N, P, Q>::new();
    let mut start = 0;
    while start < n {
        let end = n.min(start + CHUNK);
        let count = end - start;
        let wo = task.wo.range(start, end).first(count);
        let wi = task.wi.range(start, end).first(count);
        let mut f_cos = task.f_cos.range(start, end).first(count);
        let pdf = &mut task.pdf[start..end][..count];
        chunk.load(lobes, start, count);
        if chunk.alone_count < count {
            chunk.look_up(lobes, start, VIEW, wo);
            chunk.look_up(lobes, start, LIGHT, wi);
            for i in 0..count {
                let (value, density) = chunk.eval_pdf::<L>(i, wo.get_as(i), wi.get_as(i));
                f_cos.set_from(i, value);
                pdf[i] = convert(density);
            }
        }
        for i in 0..count {
            if chunk.alone[i] {
                let (wo, wi) = (wo.get_as(i), wi.get_as(i));
                let (value, density) = lobes.at(start + i).eval_pdf(wo, wi, task.transport);
                f_cos.set_from(i, value);
                pdf[i] = convert(density);
            }
        }
        start = end;
    }
}

#[inline(always)]
pub(super) fn sample<T, U, L, const N: usize, const P: usize, const Q: usize>(
    mut task: Sample<'_, T>,
    lobes: impl LobeAt<L>,
) where
    T: Real,
    U: Real,
    L: InColumns<U, N, P, Q>,
{
    let n = task.samples.pdf.len();
    let mut chunk = Chunk::<U, N, P, Q>::new();
    let mut start = 0;
    while start < n {
        let end = n.min(start + CHUNK);
        let count = end - start;
        let wo = task.wo.range(start, end).first(count);
        let u = range(task.u, start, end);
        let mut samples = task.samples.range(start, end).first(count);
        chunk.load(lobes, start, count);
        if chunk.alone_count < count {
            chunk.look_up(lobes, start, VIEW, wo);
            for i in 0..count {
                let of_wo = at(&chunk.looked_up[VIEW], i);
                let (columns, u) = (at(&chunk.columns, i), triple(u, i));
                let wi = L::sample_wi_of(columns, of_wo, wo.get_as(i), u);
                samples.wi.set_from(i, wi);
            }
            chunk.look_up(lobes, start, LIGHT, samples.wi.as_read());
            for i in 0..count {
                let (wo, wi) = (wo.get_as(i), samples.wi.as_read().get_as(i));
                let (f_cos, pdf) = chunk.eval_pdf::<L>(i, wo, wi);
                samples.set_from(i, BsdfSample::reflected(wi, f_cos / pdf, pdf));
            }
        }
        for i in 0..count {
            if chunk.alone[i] {
                let (wo, u) = (wo.get_as(i), triple(u, i));
                samples.set_from(i, lobes.at(start + i).sample(wo, u, task.transport));
            }
        }
        start = end;
    }
}

macro_rules! in_columns {
    ($($lobe:ident),*) => {
        $(impl<T: Real> Lobes<T> for $lobe<T> {
            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
                kernel.run_in_columns::<T, _, _, _, _>(One(self));
            }
        }

        impl<T: Real> Lobes<T> for Each<'_, $lobe<T>> {
            fn check(&self, n: usize) -> Result<(), LengthMismatch> {
                check(n, [("lobes", self.0.len())])
            }

            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
                kernel.run_in_columns::<T, _, _, _, _>(Each(&self.0[..n]));
            }
        })*
    };
}

in_columns!(Gltf, Principled);
