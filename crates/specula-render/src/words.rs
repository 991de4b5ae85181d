//! An array of 32-bit words for shaders: floats, indices and vectors one after the other.

use specula_bsdf::{Rgb, Vec3};

use crate::convert::{Affine, id};

/// Words that a shader reads by their offsets, `f32` as its bits, and named constants.
#[derive(Clone, Debug, Default)]
pub(crate) struct Words {
    words: Vec<u32>,
    constants: Vec<(&'static str, u32)>,
    floats: Vec<(&'static str, f32)>,
}

impl Words {
    /// The offset of the next word.
    pub(crate) fn offset(&self) -> u32 {
        id(self.words.len())
    }

    /// Adds a constant: the offset of the next word.
    pub(crate) fn begin(&mut self, name: &'static str) {
        let offset = self.offset();
        self.constant(name, offset);
    }

    /// Checks that the next word is a record's field at `offset`, as [`crate::layout`] tells shaders. At the record's
    /// end, `offset` is its size.
    ///
    /// * `record`: offset of its first word.
    ///
    /// # Panics
    ///
    /// In builds with debug assertions, where it is another.
    #[track_caller]
    pub(crate) fn field(&self, record: u32, offset: u32) {
        debug_assert_eq!(self.offset() - record, offset, "layout of a record");
    }

    /// Adds a constant: an index, a count or a code.
    pub(crate) fn constant(&mut self, name: &'static str, value: u32) {
        self.constants.push((name, value));
    }

    /// Adds a constant: a float.
    pub(crate) fn float_constant(&mut self, name: &'static str, value: f32) {
        self.floats.push((name, value));
    }

    pub(crate) fn id(&mut self, word: u32) {
        self.words.push(word);
    }

    pub(crate) fn ids(&mut self, words: impl IntoIterator<Item = u32>) {
        self.words.extend(words);
    }

    pub(crate) fn flag(&mut self, flag: bool) {
        self.words.push(u32::from(flag));
    }

    pub(crate) fn number(&mut self, x: f32) {
        self.words.push(x.to_bits());
    }

    pub(crate) fn floats(&mut self, values: impl IntoIterator<Item = f32>) {
        self.words.extend(values.into_iter().map(f32::to_bits));
    }

    pub(crate) fn vector(&mut self, v: Vec3<f32>) {
        self.floats(v.to_array());
    }

    pub(crate) fn colour(&mut self, c: Rgb<f32>) {
        self.floats(c.to_array());
    }

    /// 12 words: three columns, then the translation.
    pub(crate) fn affine(&mut self, m: &Affine) {
        for v in m.columns {
            self.vector(v);
        }
        self.vector(m.translation);
    }

    /// The words, and the constants: offsets, counts and codes, then floats.
    pub(crate) fn finish(self) -> (Vec<u32>, Constants) {
        (self.words, (self.constants, self.floats))
    }
}

/// Constants of shaders by name.
pub(crate) type Constants = (Vec<(&'static str, u32)>, Vec<(&'static str, f32)>);
