//! An array of words: numbers, indices and vectors one after the other.

use specula_bsdf::{Rgb, Vec3};

use crate::convert::{Affine, id};

/// Words that a shader reads by their place; `f32` as its bits.
#[derive(Clone, Debug, Default)]
pub(crate) struct Words {
    words: Vec<u32>,
    constants: Vec<(&'static str, u32)>,
    floats: Vec<(&'static str, f32)>,
}

impl Words {
    /// The place of the next word.
    pub(crate) fn place(&self) -> u32 {
        id(self.words.len())
    }

    /// Names the place of the next word for shaders.
    pub(crate) fn begin(&mut self, name: &'static str) {
        let place = self.place();
        self.constant(name, place);
    }

    /// Checks that the next word is a record's field at `offset`, as [`crate::layout`] tells shaders. At the record's
    /// end, `offset` is its size.
    ///
    /// * `record`: place of its first word.
    ///
    /// # Panics
    ///
    /// In builds with debug assertions, where it is another.
    #[track_caller]
    pub(crate) fn field(&self, record: u32, offset: u32) {
        debug_assert_eq!(self.place() - record, offset, "layout of a record");
    }

    /// Names an index, a count or a code for shaders.
    pub(crate) fn constant(&mut self, name: &'static str, value: u32) {
        self.constants.push((name, value));
    }

    /// Names a number for shaders.
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

    pub(crate) fn floats(&mut self, numbers: impl IntoIterator<Item = f32>) {
        self.words.extend(numbers.into_iter().map(f32::to_bits));
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

    /// The words, and what is named: places, counts and codes, then numbers.
    pub(crate) fn finish(self) -> (Vec<u32>, Constants) {
        (self.words, (self.constants, self.floats))
    }
}

/// Values by the names that shaders have for them.
pub(crate) type Constants = (Vec<(&'static str, u32)>, Vec<(&'static str, f32)>);
