//! The values after the header, in order.

use super::header::{Element, Encoding, Scalar};
use crate::num::parsed;

/// Reads numbers in order.
pub(super) struct Values<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

const TRUNCATED: &str = "it is truncated";

impl<'a> Values<'a> {
    pub(super) fn new(rest: &'a [u8], encoding: Encoding) -> Self {
        Self { rest, encoding }
    }

    /// Whether the file is binary.
    pub(super) fn is_binary(&self) -> bool {
        self.encoding != Encoding::Text
    }

    /// The next number; every type fits `f64`.
    #[inline]
    pub(super) fn next(&mut self, scalar: Scalar) -> Result<f64, String> {
        if self.encoding == Encoding::Text {
            return self.word(scalar);
        }
        let (value, rest) = self.rest.split_at_checked(scalar.size()).ok_or(TRUNCATED)?;
        self.rest = rest;
        Ok(decode(value, scalar, self.encoding))
    }

    /// The next number as the count of a list.
    #[inline]
    pub(super) fn count(&mut self, scalar: Scalar) -> Result<usize, String> {
        let count = self.next(scalar)?;
        // Every value takes a byte at least: longer lists are not there.
        if count < 0.0 || count.fract() != 0.0 {
            return Err(format!("a list has {count} values"));
        }
        if count > self.rest.len() as f64 {
            return Err(TRUNCATED.to_owned());
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 0 to the file's length"
        )]
        Ok(count as usize)
    }

    /// Skips one property.
    pub(super) fn skip(&mut self, element: &Element) -> Result<(), String> {
        for _ in 0..element.count {
            for property in &element.properties {
                let count = match property.count {
                    Some(scalar) => self.count(scalar)?,
                    None => 1,
                };
                for _ in 0..count {
                    self.next(property.value)?;
                }
            }
        }
        Ok(())
    }

    /// The bytes of `count` records of `stride` bytes each; only for binary files.
    pub(super) fn records(&mut self, count: usize, stride: usize) -> Result<&'a [u8], String> {
        let length = count.checked_mul(stride).ok_or(TRUNCATED)?;
        let (records, rest) = self.rest.split_at_checked(length).ok_or(TRUNCATED)?;
        self.rest = rest;
        Ok(records)
    }

    /// What is left.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// Goes on after `bytes` more.
    pub(super) fn advance(&mut self, bytes: usize) {
        self.rest = &self.rest[bytes.min(self.rest.len())..];
    }

    fn word(&mut self, scalar: Scalar) -> Result<f64, String> {
        let start = self
            .rest
            .iter()
            .position(|b| !b.is_ascii_whitespace())
            .ok_or(TRUNCATED)?;
        let rest = &self.rest[start..];
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        self.rest = &rest[end..];
        number(&rest[..end], scalar)
    }
}

/// A word of a text as a number.
///
/// # Errors
///
/// A message where it is none of the type.
pub(super) fn number(word: &[u8], scalar: Scalar) -> Result<f64, String> {
    match parsed(word) {
        Some(x) if !scalar.is_integer() || f64::fract(x) == 0.0 => Ok(x),
        _ => {
            let found = String::from_utf8_lossy(&word[..word.len().min(40)]);
            let found: String = found.chars().flat_map(char::escape_debug).collect();
            let what = if scalar.is_integer() {
                "an integer"
            } else {
                "a number"
            };
            Err(format!("expected {what}, found `{found}`"))
        }
    }
}

/// A number of exactly its size in bytes.
#[inline]
pub(super) fn decode(bytes: &[u8], scalar: Scalar, encoding: Encoding) -> f64 {
    /// The first `N` bytes in little-endian order; callers pass slices of the scalar's size.
    #[inline]
    fn little<const N: usize>(bytes: &[u8], encoding: Encoding) -> [u8; N] {
        let mut array = [0; N];
        array.copy_from_slice(&bytes[..N]);
        if encoding == Encoding::Big {
            array.reverse();
        }
        array
    }
    match scalar {
        Scalar::I8 => f64::from(i8::from_le_bytes(little(bytes, encoding))),
        Scalar::U8 => f64::from(bytes[0]),
        Scalar::I16 => f64::from(i16::from_le_bytes(little(bytes, encoding))),
        Scalar::U16 => f64::from(u16::from_le_bytes(little(bytes, encoding))),
        Scalar::I32 => f64::from(i32::from_le_bytes(little(bytes, encoding))),
        Scalar::U32 => f64::from(u32::from_le_bytes(little(bytes, encoding))),
        Scalar::F32 => f64::from(f32::from_le_bytes(little(bytes, encoding))),
        Scalar::F64 => f64::from_le_bytes(little(bytes, encoding)),
    }
}
