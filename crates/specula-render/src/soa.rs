//! Structures of arrays: the components of many elements, each component in an array of its own.
//!
//! Loops over them become the machine's vectors. The library's batches borrow slices of them
//! ([`Directions`], [`Colours`]).

use core::ops::{Deref, DerefMut, Range};

use specula_bsdf::batch::{Colours, Directions};
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Rgb, Vec3};

/// One value of each element.
///
/// Its size is an odd number of cache lines. Columns of 2048 bytes, one after the other, have their `i`-th elements in
/// two of the 64 sets of a first-level cache: more than 16 of them, and they evict each other.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Column<T, const N: usize> {
    values: [T; N],
    padding: [u32; 16],
}

/// One number of each element.
pub(crate) type Floats<const N: usize> = Column<f32, N>;

impl<T: Copy, const N: usize> Column<T, N> {
    /// The same value for all.
    pub(crate) const fn of(value: T) -> Self {
        Self {
            values: [value; N],
            padding: [0; 16],
        }
    }
}

impl<T, const N: usize> Deref for Column<T, N> {
    type Target = [T; N];

    #[inline(always)]
    fn deref(&self) -> &[T; N] {
        &self.values
    }
}

impl<T, const N: usize> DerefMut for Column<T, N> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T; N] {
        &mut self.values
    }
}

/// One vector or colour of each element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors<const N: usize> {
    pub(crate) x: Floats<N>,
    pub(crate) y: Floats<N>,
    pub(crate) z: Floats<N>,
}

impl<const N: usize> Vectors<N> {
    pub(crate) const ZERO: Self = Self {
        x: Floats::of(0.0),
        y: Floats::of(0.0),
        z: Floats::of(0.0),
    };

    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> Vec3<f32> {
        vec3(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, v: Vec3<f32>) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }

    #[inline(always)]
    pub(crate) fn set_array(&mut self, i: usize, [x, y, z]: &[f32; 3]) {
        self.x[i] = *x;
        self.y[i] = *y;
        self.z[i] = *z;
    }

    #[inline(always)]
    pub(crate) fn colour(&self, i: usize) -> Rgb<f32> {
        rgb(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub(crate) fn set_colour(&mut self, i: usize, c: Rgb<f32>) {
        self.set(i, vec3(c.r, c.g, c.b));
    }

    /// Sets the components of the elements of a range to one value.
    #[inline(always)]
    pub(crate) fn fill(&mut self, range: Range<usize>, value: f32) {
        self.x[range.clone()].fill(value);
        self.y[range.clone()].fill(value);
        self.z[range].fill(value);
    }

    pub(crate) fn directions(&self, range: Range<usize>) -> Directions<&[f32]> {
        Directions {
            x: &self.x[range.clone()],
            y: &self.y[range.clone()],
            z: &self.z[range],
        }
    }

    pub(crate) fn directions_mut(&mut self, range: Range<usize>) -> Directions<&mut [f32]> {
        Directions {
            x: &mut self.x[range.clone()],
            y: &mut self.y[range.clone()],
            z: &mut self.z[range],
        }
    }

    pub(crate) fn colours(&self, range: Range<usize>) -> Colours<&[f32]> {
        Colours {
            r: &self.x[range.clone()],
            g: &self.y[range.clone()],
            b: &self.z[range],
        }
    }

    pub(crate) fn colours_mut(&mut self, range: Range<usize>) -> Colours<&mut [f32]> {
        Colours {
            r: &mut self.x[range.clone()],
            g: &mut self.y[range.clone()],
            b: &mut self.z[range],
        }
    }
}
