//! Narrowing of numbers.

/// The nearest `f32`. The readers accept no number beyond `f32::MAX`, so that no infinity arises.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to f32 is what this function is for"
)]
pub(crate) fn f32_of(x: f64) -> f32 {
    x as f32
}
