//! Diffuse bases under coats. What a coat's tables say at its roughness and index is a row over the cosine, which is made
//! once for a batch and looked up for each element.

use super::level::Arithmetic;
use super::lobes::{Family, InStages, Kernel, Lobes, Same};
use super::slices::{Colours, LengthMismatch, check};
use crate::alpha::Alpha;
use crate::bsdf::under_coat::{UnderRough, UnderSmooth};
use crate::bsdf::{CoatedDiffuse, Plastic};
use crate::energy::interface_coat::Entrance;
use crate::math::{Real, Rgb};
use crate::ndf::{Ggx, Ndf};
use crate::vndf::Sampler;

impl<U: Real, I: Entrance<U>> InStages<U> for UnderRough<U, Ggx<U>, I> {
    const HAS_SAMPLER: bool = true;

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        self.ndf.alpha().x == self.ndf.alpha().y
    }

    #[inline(always)]
    fn isotropic(self) -> Self {
        let ndf = Ggx::new(Alpha::isotropic(self.ndf.alpha().x));
        Self { ndf, ..self }
    }

    #[inline(always)]
    fn sampler(&self) -> Sampler {
        self.sampler
    }

    #[inline(always)]
    fn choose_sampler(self, sampler: Sampler) -> Self {
        Self { sampler, ..self }
    }
}

impl<U: Real, I: Entrance<U>> InStages<U> for UnderSmooth<U, I> {}

/// A coat over diffuse bases whose colours differ from element to element, as from a texture.
///
/// * `lobe`: everything else of it, a [`CoatedDiffuse`] or a [`Plastic`]; the colour of its own base is not used.
/// * `albedo`: `(n, 3)`, of the bases, in `[0, 1]`.
/// * `base`: `(n, 3)`, what [`CoatedDiffuse::base`] or [`Plastic::base`] returns of the coat over each of them.
#[derive(Clone, Copy, Debug)]
pub struct PerElementBase<'a, T, L> {
    /// What the elements have in common.
    pub lobe: L,
    /// Albedos of the bases.
    pub albedo: Colours<&'a [T]>,
    /// The same with all bounces.
    pub base: Colours<&'a [T]>,
}

/// Bases of elements, and the coat over them.
#[derive(Clone, Copy)]
struct Coloured<'a, T, L> {
    lobe: L,
    albedo: Colours<&'a [T]>,
    base: Colours<&'a [T]>,
}

/// A coat that can be laid over another base.
trait Coat<T: Real>: InStages<T> {
    fn over(self, albedo: Rgb<T>, base: Rgb<T>) -> Self;
}

impl<T: Real, I: Entrance<T>> Coat<T> for UnderRough<T, Ggx<T>, I> {
    #[inline(always)]
    fn over(mut self, albedo: Rgb<T>, base: Rgb<T>) -> Self {
        self.under.albedo = albedo;
        self.under.base = base;
        self
    }
}

impl<T: Real, I: Entrance<T>> Coat<T> for UnderSmooth<T, I> {
    #[inline(always)]
    fn over(mut self, albedo: Rgb<T>, base: Rgb<T>) -> Self {
        self.0.albedo = albedo;
        self.0.base = base;
        self
    }
}

impl<T: Real, L: Coat<T>> Family<T> for Coloured<'_, T, L> {
    type Lobe = L;

    #[inline(always)]
    fn at(&self, i: usize) -> L {
        self.lobe.over(self.albedo.at(i), self.base.at(i))
    }

    #[inline(always)]
    fn range(&self, start: usize, end: usize) -> Self {
        let count = end - start;
        Self {
            lobe: self.lobe,
            albedo: self.albedo.range(start, end).first(count),
            base: self.base.range(start, end).first(count),
        }
    }

    #[inline(always)]
    fn with(self, change: impl FnOnce(L) -> L) -> Self {
        Self {
            lobe: change(self.lobe),
            ..self
        }
    }

    #[inline(always)]
    fn common(&self) -> &L {
        &self.lobe
    }

    #[inline(always)]
    fn is_isotropic(&self) -> bool {
        self.lobe.is_isotropic()
    }
}

/// What becomes of a coat once its row is made: the family of a batch.
trait OverBases<T: Real>: Copy {
    fn run<K: Kernel, L: Coat<T>>(self, coat: L, kernel: K);
}

/// The coat's own base.
#[derive(Clone, Copy)]
struct OwnBase;

/// A base for each element: albedos, and with all bounces.
#[derive(Clone, Copy)]
struct Bases<'a, T>(Colours<&'a [T]>, Colours<&'a [T]>);

impl<T: Real> OverBases<T> for OwnBase {
    #[inline(always)]
    fn run<K: Kernel, L: Coat<T>>(self, coat: L, kernel: K) {
        kernel.run::<T, _>(Same(coat));
    }
}

impl<T: Real> OverBases<T> for Bases<'_, T> {
    #[inline(always)]
    fn run<K: Kernel, L: Coat<T>>(self, coat: L, kernel: K) {
        let Self(albedo, base) = self;
        kernel.run::<T, _>(Coloured {
            lobe: coat,
            albedo,
            base,
        });
    }
}

/// A lobe whose coat is looked up in a row. In the scalar as it is, so that it is exact at every level: there is nothing
/// to fuse.
trait Coated<T: Real> {
    fn run_over<K: Kernel>(&self, bases: impl OverBases<T>, kernel: K);
}

impl<T: Real> Coated<T> for CoatedDiffuse<T> {
    #[inline(always)]
    fn run_over<K: Kernel>(&self, bases: impl OverBases<T>, kernel: K) {
        if let (Some(ggx), Some(rows)) = (self.coat, self.interface.rows()) {
            let interface = self.interface.in_rows(rows);
            bases.run(self.under_rough(ggx, interface), kernel);
        } else {
            bases.run(self.under_smooth(self.interface.smooth()), kernel);
        }
    }
}

impl<T: Real> Coated<T> for Plastic<T> {
    #[inline(always)]
    fn run_over<K: Kernel>(&self, bases: impl OverBases<T>, kernel: K) {
        if let Some(ggx) = self.coat {
            bases.run(self.under_rough(ggx, self.entrance_in_row()), kernel);
        } else {
            bases.run(self.under_smooth(), kernel);
        }
    }
}

macro_rules! coats {
    ($($lobe:ident),*) => {
        $(impl<T: Real> Lobes<T> for $lobe<T> {
            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, _n: usize, kernel: K) {
                self.run_over(OwnBase, kernel);
            }
        }

        impl<T: Real> Lobes<T> for PerElementBase<'_, T, $lobe<T>> {
            fn check(&self, n: usize) -> Result<(), LengthMismatch> {
                let albedo = self.albedo.lengths(["albedo.r", "albedo.g", "albedo.b"]);
                let base = self.base.lengths(["base.r", "base.g", "base.b"]);
                check(n, albedo.into_iter().chain(base))
            }

            #[inline(always)]
            fn run<A: Arithmetic, K: Kernel>(&self, n: usize, kernel: K) {
                let bases = Bases(self.albedo.first(n), self.base.first(n));
                self.lobe.run_over(bases, kernel);
            }
        })*
    };
}

coats!(CoatedDiffuse, Plastic);
