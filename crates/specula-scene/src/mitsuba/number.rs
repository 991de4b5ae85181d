//! Numbers in attributes.

use crate::num::shorten;

/// A finite number that `f32` can hold.
///
/// # Errors
///
/// A message that quotes the word.
pub(super) fn number(text: &str) -> Result<f64, String> {
    let word = text.trim();
    let value: f64 = word
        .parse()
        .map_err(|_| format!("expected a number, found \"{}\"", shorten(word)))?;
    if value.abs() <= f64::from(f32::MAX) {
        Ok(value)
    } else {
        Err(format!(
            "expected a finite number, found \"{}\"",
            shorten(word)
        ))
    }
}

/// Words between commas and blanks.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == ',' || c.is_whitespace())
        .filter(|w| !w.is_empty())
}

/// Numbers between commas and blanks.
///
/// # Errors
///
/// A message about the first word that is no number.
pub(super) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    words(text).map(number).collect()
}

/// Three numbers, or one for all three.
///
/// # Errors
///
/// A message that says how many were found.
pub(super) fn triple(text: &str) -> Result<[f64; 3], String> {
    match numbers(text)?.as_slice() {
        &[x] => Ok([x; 3]),
        &[x, y, z] => Ok([x, y, z]),
        other => Err(format!(
            "expected one or three numbers, found {}",
            other.len()
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_finite_and_separated_by_commas_or_blanks() {
        assert_eq!(numbers(" 1, -2.5\t3e2 "), Ok(vec![1.0, -2.5, 300.0]));
        assert_eq!(triple("0.5"), Ok([0.5; 3]));
        assert_eq!(
            triple("1 2"),
            Err("expected one or three numbers, found 2".to_owned())
        );
        for bad in ["x", "", "nan", "inf", "1e39", "1.0f"] {
            assert!(number(bad).is_err(), "{bad}");
        }
    }
}
