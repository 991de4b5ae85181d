//! Text files of spectra: pairs of wavelength and value, as pbrt's `.spd` files have them.

use thiserror::Error;

use super::{Spectrum, SpectrumError};

/// What is wrong with a spectrum file, and where.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("line {line}, column {column}: {kind}")]
#[non_exhaustive]
pub struct SpdError {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What was expected.
    pub kind: SpdErrorKind,
}

/// What is wrong with a spectrum file.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpdErrorKind {
    /// A word is not a number.
    #[error("expected a number, found `{found}`")]
    NotANumber {
        /// The word.
        found: String,
    },
    /// The last wavelength has no value.
    #[error("expected a value for the wavelength {nm} nm")]
    MissingValue {
        /// The wavelength, in nm.
        nm: f64,
    },
    /// The pairs are not a spectrum.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// Reads pairs `wavelength-in-nm value`, separated by white space; `#` starts a comment.
///
/// As in pbrt, line ends are only white space: a pair may be split over two lines.
/// Departure: pbrt yields 0 outside the samples of a file, but extends its built-in spectra by
/// their end values; here every spectrum is extended, so that a metal file that ends at 780 nm
/// does not turn into air beyond.
///
/// # Errors
///
/// [`SpdError`] with the line and column of the first thing that is wrong.
///
/// # Examples
///
/// ```
/// let s = specula_scene::spectrum::parse_spd("# nm  n\n400 1.5\n700 1.4\n")?;
/// assert_eq!(s.value(400.0), 1.5);
/// # Ok::<(), specula_scene::spectrum::SpdError>(())
/// ```
pub fn parse_spd(text: &str) -> Result<Spectrum, SpdError> {
    let mut pairs: Vec<(f64, f64)> = Vec::new();
    let mut places = Vec::new();
    let mut pending: Option<(f64, Place)> = None;
    for (place, word) in words(text) {
        let number: f64 = word.parse().map_err(|_| {
            place.error(SpdErrorKind::NotANumber {
                found: word.to_owned(),
            })
        })?;
        match pending.take() {
            None => pending = Some((number, place)),
            Some((nm, at)) => {
                pairs.push((nm, number));
                places.push(at);
            }
        }
    }
    if let Some((nm, place)) = pending {
        return Err(place.error(SpdErrorKind::MissingValue { nm }));
    }
    Spectrum::new(pairs).map_err(|e| {
        let index = match e {
            SpectrumError::Empty => 0,
            SpectrumError::NotFinite { index } | SpectrumError::NotIncreasing { index, .. } => {
                index
            }
        };
        let place = places.get(index).copied().unwrap_or(Place::START);
        place.error(e.into())
    })
}

#[derive(Clone, Copy)]
struct Place {
    line: usize,
    column: usize,
}

impl Place {
    const START: Self = Self { line: 1, column: 1 };

    fn error(self, kind: SpdErrorKind) -> SpdError {
        SpdError {
            line: self.line,
            column: self.column,
            kind,
        }
    }
}

/// Words outside comments, with their places.
fn words(text: &str) -> impl Iterator<Item = (Place, &str)> {
    text.lines().enumerate().flat_map(|(i, line)| {
        let code = line.split('#').next().unwrap_or("");
        code.split_whitespace().map(move |word| {
            // The offset of a subslice in its line: both come from the same string.
            let offset = word.as_ptr() as usize - code.as_ptr() as usize;
            let column = code[..offset].chars().count() + 1;
            (
                Place {
                    line: i + 1,
                    column,
                },
                word,
            )
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::fit_conductor;
    use super::*;

    #[test]
    fn reads_pairs_comments_and_split_pairs() {
        let s = parse_spd("# header\n400 1 # end\n\n 500\n2 600 3").unwrap();
        assert_eq!(s.samples(), [(400.0, 1.0), (500.0, 2.0), (600.0, 3.0)]);
    }

    #[test]
    fn errors_are_located() {
        let message = |text: &str| parse_spd(text).unwrap_err().to_string();
        assert_eq!(
            message("400 1\n500  \u{e9} x\n"),
            "line 2, column 6: expected a number, found `\u{e9}`"
        );
        assert_eq!(
            message("400 1\n500"),
            "line 2, column 1: expected a value for the wavelength 500 nm"
        );
        assert_eq!(
            message("400 1\n 390 2"),
            "line 2, column 2: sample 1: expected a wavelength above 400 nm, found 390 nm"
        );
        assert_eq!(
            message("400 inf"),
            "line 1, column 1: sample 0: expected a positive finite wavelength and a finite value"
        );
        assert_eq!(
            message("# nothing\n"),
            "line 1, column 1: a spectrum needs at least one sample"
        );
    }

    #[test]
    fn files_of_a_real_scene_are_gold() {
        let folder = specula_testing::scene("cornell-box/spds");
        let read = |file| std::fs::read_to_string(folder.join(file)).unwrap();
        let [eta, k] = ["Au.eta.spd", "Au.k.spd"].map(|f| parse_spd(&read(f)).unwrap());
        let fit = fit_conductor(&eta, &k);
        // Johnson and Christy's gold, whose green and blue our own table has as well.
        for (c, eta, k) in [(1, 0.498, 2.257), (2, 1.475, 1.776)] {
            assert!((fit.eta[c] - eta).abs() < 0.1, "{fit:?}");
            assert!((fit.k[c] - k).abs() < 0.2, "{fit:?}");
        }
    }
}
