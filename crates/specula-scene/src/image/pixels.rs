//! A picture's pixels in the depth of their file: linear values, stored as
//! indices into a table of them where a file has 8 or 16 bits.

use std::sync::Arc;

/// Linear RGB values in order, in the depth in which they were stored.
///
/// A pixel has one value where all of the picture is grey, else three. A value is an `f32`, or an
/// index of 8 or 16 bits into a table of linear values, which does not round.
#[derive(Clone, Debug, Default)]
pub struct Pixels {
    samples: Samples,
    is_colour: bool,
}

#[derive(Clone, Debug)]
enum Samples {
    Bytes {
        table: Box<[f32; 256]>,
        indices: Vec<u8>,
    },
    Words {
        table: Arc<[f32; 65536]>,
        indices: Vec<u16>,
    },
    Floats(Vec<f32>),
}

/// Pixels whose memory is given back at once.
const FREED_AT_ONCE: usize = 1 << 22;

impl Default for Samples {
    fn default() -> Self {
        Self::Floats(Vec::new())
    }
}

/// Tables and indices of pixels: what a shader reads.
#[derive(Clone, Copy, Debug)]
pub struct Indexed<'a> {
    /// Linear values.
    pub table: &'a [f32; 256],
    /// One or three indices for each pixel.
    pub indices: &'a [u8],
    /// Three indices for each pixel, or one for all channels.
    pub is_colour: bool,
}

impl Pixels {
    /// Pixels of 8 bits.
    ///
    /// * `table`: linear values.
    /// * `indices`: one for each pixel, or three where `is_colour`.
    pub(super) fn bytes(table: Box<[f32; 256]>, indices: Vec<u8>, is_colour: bool) -> Self {
        Self {
            samples: Samples::Bytes { table, indices },
            is_colour,
        }
    }

    /// Pixels of 16 bits, as [`Self::bytes`].
    pub(super) fn words(table: Arc<[f32; 65536]>, indices: Vec<u16>, is_colour: bool) -> Self {
        Self {
            samples: Samples::Words { table, indices },
            is_colour,
        }
    }

    /// Pixels of linear floats.
    ///
    /// * `values`: one for each pixel, or three where `is_colour`.
    #[must_use]
    pub fn floats(values: Vec<f32>, is_colour: bool) -> Self {
        Self {
            samples: Samples::Floats(values),
            is_colour,
        }
    }

    /// `count` pixels that are 1.
    pub(super) fn ones(count: usize) -> Self {
        Self::bytes(Box::new([1.0; 256]), vec![0; count], false)
    }

    /// The mean of the channels of each pixel.
    pub(super) fn means(self) -> Self {
        let mean = |[r, g, b]: [f32; 3]| (r + g + b) / 3.0;
        if !self.is_colour {
            return self.each(|v| mean([v; 3]));
        }
        // From the last pixel on, so that what was read goes while its means come.
        let mut pixels = self;
        let mut means = vec![0.0; pixels.len()];
        while !pixels.is_empty() {
            let first = (pixels.len() - 1) / FREED_AT_ONCE * FREED_AT_ONCE;
            for (of_pixel, i) in means[first..].iter_mut().zip(first..pixels.len()) {
                *of_pixel = mean(pixels.rgb(i));
            }
            pixels.truncate(first);
        }
        Self::floats(means, false)
    }

    /// Leaves the first pixels, and frees the rest.
    fn truncate(&mut self, count: usize) {
        fn cut<T>(samples: &mut Vec<T>, count: usize) {
            samples.truncate(count);
            samples.shrink_to_fit();
        }
        let count = count * if self.is_colour { 3 } else { 1 };
        match &mut self.samples {
            Samples::Bytes { indices, .. } => cut(indices, count),
            Samples::Words { indices, .. } => cut(indices, count),
            Samples::Floats(values) => cut(values, count),
        }
    }

    /// How many pixels there are.
    #[must_use]
    pub fn len(&self) -> usize {
        let samples = match &self.samples {
            Samples::Bytes { indices, .. } => indices.len(),
            Samples::Words { indices, .. } => indices.len(),
            Samples::Floats(values) => values.len(),
        };
        samples / if self.is_colour { 3 } else { 1 }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether each has three values, rather than one for all channels.
    #[must_use]
    pub fn is_colour(&self) -> bool {
        self.is_colour
    }

    /// Bytes of memory that they take.
    #[must_use]
    pub fn size(&self) -> u64 {
        let size = match &self.samples {
            Samples::Bytes { indices, .. } => indices.capacity() + size_of::<[f32; 256]>(),
            Samples::Words { indices, .. } => 2 * indices.capacity() + size_of::<[f32; 65536]>(),
            Samples::Floats(values) => 4 * values.capacity(),
        };
        size as u64
    }

    /// The pixel at `index`, linear RGB.
    ///
    /// # Panics
    ///
    /// Where `index` is not below [`Self::len`].
    #[inline]
    #[must_use]
    pub fn rgb(&self, index: usize) -> [f32; 3] {
        match (&self.samples, self.is_colour) {
            (Samples::Bytes { table, indices }, true) => {
                triple(indices, index).map(|i| table[usize::from(i)])
            }
            (Samples::Bytes { table, indices }, false) => [table[usize::from(indices[index])]; 3],
            (Samples::Words { table, indices }, true) => {
                triple(indices, index).map(|i| table[usize::from(i)])
            }
            (Samples::Words { table, indices }, false) => [table[usize::from(indices[index])]; 3],
            (Samples::Floats(values), true) => triple(values, index),
            (Samples::Floats(values), false) => [values[index]; 3],
        }
    }

    /// [`Self::rgb`] of several pixels at once.
    ///
    /// # Panics
    ///
    /// As [`Self::rgb`].
    #[inline]
    #[must_use]
    pub fn rgb_of<const N: usize>(&self, pixels: [usize; N]) -> [[f32; 3]; N] {
        match (&self.samples, self.is_colour) {
            (Samples::Bytes { table, indices }, true) => {
                let triples = indices.as_chunks().0;
                pixels.map(|at| triples[at].map(|i: u8| table[usize::from(i)]))
            }
            (Samples::Floats(values), true) => {
                let triples = values.as_chunks().0;
                pixels.map(|at| triples[at])
            }
            _ => pixels.map(|at| self.rgb(at)),
        }
    }

    /// All pixels in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = [f32; 3]> + Clone + '_ {
        (0..self.len()).map(|i| self.rgb(i))
    }

    /// The pixels row by row.
    pub fn rows(
        &self,
        width: u32,
    ) -> impl Iterator<Item = impl Iterator<Item = [f32; 3]> + '_> + '_ {
        let (width, count) = (width.max(1) as usize, self.len());
        (0..count)
            .step_by(width)
            .map(move |first| (first..(first + width).min(count)).map(|i| self.rgb(i)))
    }

    /// Whether no pixel has a colour.
    #[must_use]
    pub fn is_grey(&self) -> bool {
        !self.is_colour || self.iter().all(|[r, g, b]| r == g && g == b)
    }

    /// Table and indices of pixels of 8 bits; `None` of others.
    #[must_use]
    pub fn indexed(&self) -> Option<Indexed<'_>> {
        match &self.samples {
            Samples::Bytes { table, indices } => Some(Indexed {
                table,
                indices,
                is_colour: self.is_colour,
            }),
            Samples::Words { .. } | Samples::Floats(_) => None,
        }
    }

    /// Index of the first pixel with a value for which `is` holds.
    pub(crate) fn position(&self, is: impl Fn(f32) -> bool) -> Option<usize> {
        // If it holds for no value of the table, it holds for no pixel.
        let table: &[f32] = match &self.samples {
            Samples::Bytes { table, .. } => &table[..],
            Samples::Words { table, .. } => &table[..],
            Samples::Floats(values) => values,
        };
        if !table.iter().any(|v| is(*v)) {
            return None;
        }
        self.iter().position(|p| p.into_iter().any(&is))
    }

    /// Every value with `change` applied.
    pub(super) fn each(mut self, change: impl Fn(f32) -> f32) -> Self {
        let change = |values: &mut [f32]| values.iter_mut().for_each(|v| *v = change(*v));
        match &mut self.samples {
            Samples::Bytes { table, .. } => change(&mut table[..]),
            Samples::Words { table, .. } => change(&mut Arc::make_mut(table)[..]),
            Samples::Floats(values) => change(values),
        }
        self
    }

    /// The same pixels in less memory, where they are grey or have at most 256 different values.
    #[must_use]
    pub fn compacted(self) -> Self {
        let Self {
            mut samples,
            mut is_colour,
        } = self;
        if is_colour {
            let is_grey = match &mut samples {
                Samples::Bytes { indices, .. } => take_grey(indices, |a, b| a == b),
                Samples::Words { indices, .. } => take_grey(indices, |a, b| a == b),
                Samples::Floats(values) => take_grey(values, |a, b| a.to_bits() == b.to_bits()),
            };
            is_colour = !is_grey;
        }
        let indexed = match &samples {
            Samples::Bytes { .. } => None,
            Samples::Words { table, indices } => {
                palette(indices.iter().map(|i| table[usize::from(*i)]))
            }
            Samples::Floats(values) => palette(values.iter().copied()),
        };
        match indexed {
            Some((table, indices)) => Self::bytes(table, indices, is_colour),
            None => Self { samples, is_colour },
        }
    }
}

impl From<Vec<[f32; 3]>> for Pixels {
    fn from(pixels: Vec<[f32; 3]>) -> Self {
        Self {
            samples: Samples::Floats(pixels.into_flattened()),
            is_colour: true,
        }
    }
}

impl FromIterator<[f32; 3]> for Pixels {
    fn from_iter<T: IntoIterator<Item = [f32; 3]>>(pixels: T) -> Self {
        pixels.into_iter().collect::<Vec<_>>().into()
    }
}

/// Equal where the pixels are, however they are stored.
impl PartialEq for Pixels {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().eq(other.iter())
    }
}

#[inline]
fn triple<T: Copy>(samples: &[T], index: usize) -> [T; 3] {
    samples.as_chunks().0[index]
}

/// Leaves the values of the channels `keep` of `stride` for each pixel, and frees the rest.
pub(super) fn take_channels<T: Copy>(
    samples: &mut Vec<T>,
    stride: usize,
    keep: core::ops::Range<usize>,
) {
    let (pixels, count) = (samples.len() / stride, keep.len());
    for pixel in 0..pixels {
        let from = pixel * stride + keep.start;
        samples.copy_within(from..from + count, pixel * count);
    }
    samples.truncate(pixels * count);
    samples.shrink_to_fit();
}

/// Leaves one value of each pixel where the three are equal; returns whether they were.
fn take_grey<T: Copy>(samples: &mut Vec<T>, is_same: impl Fn(T, T) -> bool) -> bool {
    let triples = samples.as_chunks::<3>().0;
    let is_grey = triples
        .iter()
        .all(|[r, g, b]| is_same(*r, *g) && is_same(*r, *b));
    if is_grey {
        take_channels(samples, 3, 0..1);
    }
    is_grey
}

/// Values as indices into a table; `None` where that would need more than 256 places.
fn palette(values: impl ExactSizeIterator<Item = f32>) -> Option<(Box<[f32; 256]>, Vec<u8>)> {
    /// A free place of the table.
    const FREE: u16 = u16::MAX;
    const PLACES: usize = 1024;
    // Values by their bits, with open addressing.
    let mut places = [(0_u32, FREE); PLACES];
    let mut table = Box::new([0.0; 256]);
    let mut known = 0_u16;
    let mut index_of = |value: f32| {
        let bits = value.to_bits();
        let mut place = (bits.wrapping_mul(0x9e37_79b9) >> 22) as usize;
        loop {
            match places[place] {
                (b, n) if b == bits && n != FREE => return u8::try_from(n).ok(),
                (_, FREE) => {
                    let n = u8::try_from(known).ok()?;
                    table[usize::from(n)] = value;
                    places[place] = (bits, known);
                    known += 1;
                    return Some(n);
                }
                _ => place = (place + 1) % PLACES,
            }
        }
    };
    // Pictures with more values exceed the table early: little is allocated for those.
    let (mut indices, count) = (Vec::new(), values.len());
    for (i, value) in values.enumerate() {
        let index = index_of(value)?;
        if i == 1 << 14 {
            indices.reserve_exact(count - i);
        }
        indices.push(index);
    }
    Some((table, indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(count: u16, of: impl Fn(u16) -> [f32; 3]) -> Vec<[f32; 3]> {
        (0..count).map(of).collect()
    }

    #[test]
    fn compacting_changes_no_bit_and_stops_at_256_values() {
        for (count, is_indexed) in [(256, true), (257, false)] {
            let given = pixels(600, |i| {
                [i, i * 7, i * 31].map(|v| f32::from(v % count).sqrt())
            });
            let stored = Pixels::from(given.clone()).compacted();
            assert_eq!(stored.indexed().is_some(), is_indexed);
            assert_eq!(stored.len(), 600);
            assert!(stored.iter().eq(given.iter().copied()));
            assert!(stored.rows(30).flatten().eq(given));
        }
    }

    #[test]
    fn grey_pixels_have_one_sample() {
        let given = pixels(1000, |i| [f32::from(i); 3]);
        let stored = Pixels::from(given.clone()).compacted();
        assert!(stored.is_grey() && stored.iter().eq(given.clone()));
        assert!(stored.size() <= 4 * 1000, "{}", stored.size());
        assert_eq!(stored, Pixels::from(given));
        // Zeros of both signs are different bits, and stay so.
        let signs = Pixels::from(vec![[0.0, -0.0, 0.0]]).compacted();
        assert!(signs.rgb(0)[1].is_sign_negative());
    }

    #[test]
    fn means_of_more_pixels_than_are_freed_at_once() {
        let table = Box::new(std::array::from_fn(|i| i as f32));
        let count = FREED_AT_ONCE + 3;
        let indices: Vec<u8> = (0..=u8::MAX).cycle().step_by(7).take(3 * count).collect();
        let pixels = Pixels::bytes(table, indices, true);
        let expected: Vec<f32> = pixels.iter().map(|[r, g, b]| (r + g + b) / 3.0).collect();
        let means = pixels.means();
        assert_eq!(means.len(), count);
        assert!(means.iter().map(|p| p[0]).eq(expected));
    }

    #[test]
    fn channels_are_taken_in_place() {
        let mut samples: Vec<u8> = (0..12).collect();
        take_channels(&mut samples, 4, 0..3);
        assert_eq!(samples, [0, 1, 2, 4, 5, 6, 8, 9, 10]);
        take_channels(&mut samples, 3, 2..3);
        assert_eq!(samples, [2, 6, 10]);
    }

    #[test]
    fn a_search_looks_at_pixels_where_the_table_has_a_hit() {
        let mut table = Box::new([0.5; 256]);
        table[7] = f32::INFINITY;
        let of = |indices| Pixels::bytes(table.clone(), indices, false);
        assert_eq!(of(vec![0, 1, 2]).position(f32::is_infinite), None);
        assert_eq!(of(vec![0, 7, 2]).position(f32::is_infinite), Some(1));
    }
}
