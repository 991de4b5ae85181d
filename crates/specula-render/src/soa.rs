//! Structures of arrays: the components of many elements, each component in an array of its own.
//!
//! Loops over them become the machine's vectors. The library's batches borrow slices of them
//! ([`Directions`], [`Colours`]).

use core::ops::Range;

use specula_bsdf::batch::{Colours, Directions};
use specula_bsdf::math::{rgb, vec3};
use specula_bsdf::{Rgb, Vec3};

/// One value of each element.
pub(crate) type Floats<const N: usize> = [f32; N];

/// One vector or colour of each element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors<const N: usize> {
    pub(crate) x: Floats<N>,
    pub(crate) y: Floats<N>,
    pub(crate) z: Floats<N>,
}

impl<const N: usize> Vectors<N> {
    pub(crate) const ZERO: Self = Self {
        x: [0.0; N],
        y: [0.0; N],
        z: [0.0; N],
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

    pub(crate) fn colours_mut(&mut self, range: Range<usize>) -> Colours<&mut [f32]> {
        Colours {
            r: &mut self.x[range.clone()],
            g: &mut self.y[range.clone()],
            b: &mut self.z[range],
        }
    }
}
