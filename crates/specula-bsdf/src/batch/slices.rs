//! Structures of arrays: what the batch functions read and write.

use alloc::vec;
use alloc::vec::Vec;

use crate::bsdf::{BsdfSample, Event};
use crate::math::{Real, Rgb, Vec3, rgb, vec3};

/// Directions or other vectors, one array per component: `(n, 3)`.
///
/// `S` is a `Vec<T>`, a `&[T]` to read or a `&mut [T]` to write.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Directions<S> {
    /// First components.
    pub x: S,
    /// Second components.
    pub y: S,
    /// Third components, along the surface's normal.
    pub z: S,
}

/// Colours, one array per channel: `(n, 3)`. `S` as for [`Directions`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Colours<S> {
    /// Reds.
    pub r: S,
    /// Greens.
    pub g: S,
    /// Blues.
    pub b: S,
}

/// What became of a sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum SampleOutcome {
    /// No direction: `wi`, `weight` and `pdf` are zero.
    #[default]
    Rejected,
    /// `wi` on the side of `wo`.
    Reflection,
    /// `wi` on the other side.
    Transmission,
    /// A mirrored direction; `pdf` is its probability.
    SpecularReflection,
    /// A refracted or straight direction; `pdf` is its probability.
    SpecularTransmission,
}

/// Samples, one array per component. `S` as for [`Directions`]; `O` likewise for [`SampleOutcome`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Samples<S, O> {
    /// Towards the light, unit; `(0, 0, 0)` where rejected.
    pub wi: Directions<S>,
    /// `f |cos theta_i| / pdf`; 0 where rejected.
    pub weight: Colours<S>,
    /// Density in 1/sr, or probability where specular; 0 where rejected.
    pub pdf: S,
    /// What became of the sample.
    pub outcome: O,
}

/// Slices of one call that differ in length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` holds {found} elements, but the first slice written holds {expected}")]
#[non_exhaustive]
pub struct LengthMismatch {
    /// The slice that differs.
    pub name: &'static str,
    /// Its length.
    pub found: usize,
    /// The length of the call: that of the first slice written.
    pub expected: usize,
}

/// Fails unless every named slice is as long as the first slice written.
pub(super) fn check(
    expected: usize,
    slices: impl IntoIterator<Item = (&'static str, usize)>,
) -> Result<(), LengthMismatch> {
    match slices.into_iter().find(|&(_, found)| found != expected) {
        None => Ok(()),
        Some((name, found)) => Err(LengthMismatch {
            name,
            found,
            expected,
        }),
    }
}

impl<T: Real> Directions<Vec<T>> {
    /// `n` zero vectors.
    pub fn zeroed(n: usize) -> Self {
        let zeros = || vec![T::ZERO; n];
        Self {
            x: zeros(),
            y: zeros(),
            z: zeros(),
        }
    }

    /// To read.
    pub fn as_slices(&self) -> Directions<&[T]> {
        Directions {
            x: &self.x,
            y: &self.y,
            z: &self.z,
        }
    }

    /// To write.
    pub fn as_mut_slices(&mut self) -> Directions<&mut [T]> {
        Directions {
            x: &mut self.x,
            y: &mut self.y,
            z: &mut self.z,
        }
    }
}

impl<T: Real> FromIterator<Vec3<T>> for Directions<Vec<T>> {
    fn from_iter<I: IntoIterator<Item = Vec3<T>>>(vectors: I) -> Self {
        let mut all = Self::default();
        for v in vectors {
            all.x.push(v.x);
            all.y.push(v.y);
            all.z.push(v.z);
        }
        all
    }
}

impl<T: Real> Directions<&[T]> {
    /// The vector at `i`; `None` where a slice has no element `i`.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Option<Vec3<T>> {
        Some(vec3(*self.x.get(i)?, *self.y.get(i)?, *self.z.get(i)?))
    }

    /// The vector at `i`, which is known to exist.
    #[inline(always)]
    pub(super) fn at(&self, i: usize) -> Vec3<T> {
        vec3(self.x[i], self.y[i], self.z[i])
    }

    /// The slices' lengths, `names` being those of the components.
    pub(super) fn lengths(&self, names: [&'static str; 3]) -> [(&'static str, usize); 3] {
        let [x, y, z] = names;
        [(x, self.x.len()), (y, self.y.len()), (z, self.z.len())]
    }

    /// The first `n`: tells the compiler that indices below `n` need no check.
    #[inline(always)]
    pub(super) fn first(self, n: usize) -> Self {
        Self {
            x: &self.x[..n],
            y: &self.y[..n],
            z: &self.z[..n],
        }
    }

    #[inline(always)]
    pub(super) fn range(&self, start: usize, end: usize) -> Self {
        Self {
            x: &self.x[start..end],
            y: &self.y[start..end],
            z: &self.z[start..end],
        }
    }

    /// The vector at `i` in another scalar.
    #[inline(always)]
    pub(super) fn get_as<U: Real>(&self, i: usize) -> Vec3<U> {
        self.at(i).cast()
    }
}

impl<T: Real> Directions<&mut [T]> {
    pub(super) fn lengths(&self, names: [&'static str; 3]) -> [(&'static str, usize); 3] {
        let [x, y, z] = names;
        [(x, self.x.len()), (y, self.y.len()), (z, self.z.len())]
    }

    #[inline(always)]
    pub(super) fn first(self, n: usize) -> Self {
        Self {
            x: &mut self.x[..n],
            y: &mut self.y[..n],
            z: &mut self.z[..n],
        }
    }

    #[inline(always)]
    pub(super) fn range(&mut self, start: usize, end: usize) -> Directions<&mut [T]> {
        Directions {
            x: &mut self.x[start..end],
            y: &mut self.y[start..end],
            z: &mut self.z[start..end],
        }
    }

    /// To read what was written.
    #[inline(always)]
    pub(super) fn as_read(&self) -> Directions<&[T]> {
        Directions {
            x: &*self.x,
            y: &*self.y,
            z: &*self.z,
        }
    }

    #[inline(always)]
    pub(super) fn set_from<U: Real>(&mut self, i: usize, v: Vec3<U>) {
        let v = v.cast();
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }
}

impl<T: Real> Colours<Vec<T>> {
    /// `n` times black.
    pub fn zeroed(n: usize) -> Self {
        let zeros = || vec![T::ZERO; n];
        Self {
            r: zeros(),
            g: zeros(),
            b: zeros(),
        }
    }

    /// To read.
    pub fn as_slices(&self) -> Colours<&[T]> {
        Colours {
            r: &self.r,
            g: &self.g,
            b: &self.b,
        }
    }

    /// To write.
    pub fn as_mut_slices(&mut self) -> Colours<&mut [T]> {
        Colours {
            r: &mut self.r,
            g: &mut self.g,
            b: &mut self.b,
        }
    }
}

impl<T: Real> Colours<&[T]> {
    /// The colour at `i`; `None` where a slice has no element `i`.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Option<Rgb<T>> {
        Some(rgb(*self.r.get(i)?, *self.g.get(i)?, *self.b.get(i)?))
    }

    /// The colour at `i`, which is known to exist.
    #[inline(always)]
    pub(super) fn at(&self, i: usize) -> Rgb<T> {
        rgb(self.r[i], self.g[i], self.b[i])
    }

    pub(super) fn lengths(&self, names: [&'static str; 3]) -> [(&'static str, usize); 3] {
        let [r, g, b] = names;
        [(r, self.r.len()), (g, self.g.len()), (b, self.b.len())]
    }

    #[inline(always)]
    pub(super) fn first(self, n: usize) -> Self {
        Self {
            r: &self.r[..n],
            g: &self.g[..n],
            b: &self.b[..n],
        }
    }

    #[inline(always)]
    pub(super) fn range(&self, start: usize, end: usize) -> Self {
        Self {
            r: &self.r[start..end],
            g: &self.g[start..end],
            b: &self.b[start..end],
        }
    }
}

impl<T: Real> Colours<&mut [T]> {
    pub(super) fn lengths(&self, names: [&'static str; 3]) -> [(&'static str, usize); 3] {
        let [r, g, b] = names;
        [(r, self.r.len()), (g, self.g.len()), (b, self.b.len())]
    }

    #[inline(always)]
    pub(super) fn first(self, n: usize) -> Self {
        Self {
            r: &mut self.r[..n],
            g: &mut self.g[..n],
            b: &mut self.b[..n],
        }
    }

    #[inline(always)]
    pub(super) fn range(&mut self, start: usize, end: usize) -> Colours<&mut [T]> {
        Colours {
            r: &mut self.r[start..end],
            g: &mut self.g[start..end],
            b: &mut self.b[start..end],
        }
    }

    #[inline(always)]
    pub(super) fn set_from<U: Real>(&mut self, i: usize, c: Rgb<U>) {
        let c = c.cast();
        self.r[i] = c.r;
        self.g[i] = c.g;
        self.b[i] = c.b;
    }
}

impl<T: Real> Samples<Vec<T>, Vec<SampleOutcome>> {
    /// `n` rejected samples.
    pub fn rejected(n: usize) -> Self {
        Self {
            wi: Directions::zeroed(n),
            weight: Colours::zeroed(n),
            pdf: vec![T::ZERO; n],
            outcome: vec![SampleOutcome::Rejected; n],
        }
    }

    /// To read.
    pub fn as_slices(&self) -> Samples<&[T], &[SampleOutcome]> {
        Samples {
            wi: self.wi.as_slices(),
            weight: self.weight.as_slices(),
            pdf: &self.pdf,
            outcome: &self.outcome,
        }
    }

    /// To write.
    pub fn as_mut_slices(&mut self) -> Samples<&mut [T], &mut [SampleOutcome]> {
        Samples {
            wi: self.wi.as_mut_slices(),
            weight: self.weight.as_mut_slices(),
            pdf: &mut self.pdf,
            outcome: &mut self.outcome,
        }
    }
}

impl<T: Real> Samples<&mut [T], &mut [SampleOutcome]> {
    pub(super) fn lengths(&self) -> [(&'static str, usize); 8] {
        let [x, y, z] = self.wi.lengths(["wi.x", "wi.y", "wi.z"]);
        let [r, g, b] = self.weight.lengths(["weight.r", "weight.g", "weight.b"]);
        let (pdf, outcome) = (("pdf", self.pdf.len()), ("outcome", self.outcome.len()));
        [x, y, z, r, g, b, pdf, outcome]
    }

    #[inline(always)]
    pub(super) fn first(self, n: usize) -> Self {
        Self {
            wi: self.wi.first(n),
            weight: self.weight.first(n),
            pdf: &mut self.pdf[..n],
            outcome: &mut self.outcome[..n],
        }
    }

    #[inline(always)]
    pub(super) fn range(
        &mut self,
        start: usize,
        end: usize,
    ) -> Samples<&mut [T], &mut [SampleOutcome]> {
        Samples {
            wi: self.wi.range(start, end),
            weight: self.weight.range(start, end),
            pdf: &mut self.pdf[start..end],
            outcome: &mut self.outcome[start..end],
        }
    }

    #[inline(always)]
    pub(super) fn set_from<U: Real>(&mut self, i: usize, sample: Option<BsdfSample<U>>) {
        // As a whole, so that the loop stays free of branches.
        let (wi, weight, pdf, outcome) = match sample {
            Some(s) => (s.wi, s.weight, s.pdf, SampleOutcome::of(&s)),
            None => (Vec3::ZERO, Rgb::BLACK, U::ZERO, SampleOutcome::Rejected),
        };
        self.wi.set_from(i, wi);
        self.weight.set_from(i, weight);
        self.pdf[i] = T::of(pdf.to_f64());
        self.outcome[i] = outcome;
    }
}

impl SampleOutcome {
    #[inline(always)]
    fn of<T: Real>(sample: &BsdfSample<T>) -> Self {
        match (sample.event, sample.specular) {
            (Event::Reflection, false) => Self::Reflection,
            (Event::Transmission, false) => Self::Transmission,
            (Event::Reflection, true) => Self::SpecularReflection,
            (Event::Transmission, true) => Self::SpecularTransmission,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_beyond_the_shortest_slice_do_not_exist() {
        let directions = Directions {
            x: &[1.0_f32, 4.0][..],
            y: &[2.0][..],
            z: &[3.0, 6.0, 9.0][..],
        };
        assert_eq!(directions.get(0), Some(vec3(1.0, 2.0, 3.0)));
        assert_eq!(directions.get(1), None);
        let colours = Colours {
            r: &[1.0_f64][..],
            g: &[][..],
            b: &[3.0][..],
        };
        assert_eq!(colours.get(0), None);
    }
}
