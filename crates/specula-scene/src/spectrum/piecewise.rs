//! Piecewise-linear spectra.

use thiserror::Error;

/// A function of wavelength, linear between samples and constant outside them.
///
/// The constant extension is pbrt's rule for its built-in and interleaved spectra
/// (`PiecewiseLinearSpectrum::FromInterleaved`).
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// `(nm, value)`, at least one, wavelengths strictly increasing, all finite.
    samples: Vec<(f64, f64)>,
}

/// Why samples are not a spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpectrumError {
    /// There is no sample.
    #[error("a spectrum needs at least one sample")]
    Empty,
    /// A wavelength is not a positive finite number, or a value is not finite.
    #[error("sample {index}: expected a positive finite wavelength and a finite value")]
    NotFinite {
        /// Which sample, from 0.
        index: usize,
    },
    /// A wavelength does not exceed the one before it.
    #[error("sample {index}: expected a wavelength above {previous} nm, found {found} nm")]
    NotIncreasing {
        /// Which sample, from 0.
        index: usize,
        /// The wavelength before it, in nm.
        previous: f64,
        /// Its wavelength, in nm.
        found: f64,
    },
}

impl Spectrum {
    /// The spectrum through `samples`.
    ///
    /// * `samples`: `(wavelength in nm, value)`, wavelengths strictly increasing.
    ///
    /// # Errors
    ///
    /// [`SpectrumError`], naming the first sample that is wrong.
    ///
    /// # Examples
    ///
    /// ```
    /// use specula_scene::spectrum::Spectrum;
    /// let s = Spectrum::new(vec![(400.0, 0.0), (600.0, 1.0)])?;
    /// assert_eq!(s.value(500.0), 0.5);
    /// assert_eq!(s.value(900.0), 1.0);
    /// # Ok::<(), specula_scene::spectrum::SpectrumError>(())
    /// ```
    pub fn new(samples: Vec<(f64, f64)>) -> Result<Self, SpectrumError> {
        if samples.is_empty() {
            return Err(SpectrumError::Empty);
        }
        let mut previous = 0.0;
        for (index, &(found, value)) in samples.iter().enumerate() {
            if !(found.is_finite() && found > 0.0 && value.is_finite()) {
                return Err(SpectrumError::NotFinite { index });
            }
            if found <= previous {
                return Err(SpectrumError::NotIncreasing {
                    index,
                    previous,
                    found,
                });
            }
            previous = found;
        }
        Ok(Self { samples })
    }

    /// The spectrum that is `value` everywhere.
    ///
    /// * `value`: finite; anything else counts as 0.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        let value = if value.is_finite() { value } else { 0.0 };
        Self {
            samples: vec![(550.0, value)],
        }
    }

    /// The value at a wavelength in nm.
    #[must_use]
    pub fn value(&self, nm: f64) -> f64 {
        let above = self.samples.partition_point(|&(w, _)| w <= nm);
        match (above.checked_sub(1), self.samples.get(above)) {
            (Some(below), Some(&(w1, v1))) => {
                let (w0, v0) = self.samples[below];
                v0 + (v1 - v0) * ((nm - w0) / (w1 - w0))
            }
            (None, Some(&(_, first))) => first,
            (Some(last), None) => self.samples[last].1,
            (None, None) => 0.0,
        }
    }

    /// The same spectrum, 0 beyond its first and last sample; one of a single sample stays as it is.
    pub(crate) fn zero_outside(&self) -> Self {
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last()) else {
            return self.clone();
        };
        if self.samples.len() == 1 {
            return self.clone();
        }
        // A step cannot be vertical; this one is narrower than any sum's.
        let before = (first.0 * (1.0 - 1e-9), 0.0);
        let after = (last.0 * (1.0 + 1e-9), 0.0);
        let inner = self.samples.iter().copied();
        Self {
            samples: std::iter::once(before)
                .chain(inner)
                .chain([after])
                .collect(),
        }
    }

    /// `(nm, value)`, wavelengths strictly increasing; never empty.
    #[must_use]
    pub fn samples(&self) -> &[(f64, f64)] {
        &self.samples
    }

    /// `f` of every `step_nm` from `first_nm` to `last_nm`, where `f` is finite.
    pub(super) fn sampled(
        first_nm: f64,
        last_nm: f64,
        step_nm: f64,
        f: impl Fn(f64) -> f64,
    ) -> Self {
        let wavelengths = (0..).map(|i| first_nm + f64::from(i) * step_nm);
        Self::from_ordered(
            wavelengths
                .take_while(|&nm| nm <= last_nm)
                .map(|nm| (nm, f(nm)))
                .collect(),
        )
    }

    /// The spectrum through samples that this module's own tables and formulas made: ordered and
    /// finite by construction, which the tests of [`super::named()`] check for each of them.
    pub(super) fn from_ordered(samples: Vec<(f64, f64)>) -> Self {
        debug_assert!(Self::new(samples.clone()).is_ok());
        Self { samples }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_linear_between_and_constant_outside() {
        let s = Spectrum::new(vec![(400.0, 1.0), (500.0, 3.0), (510.0, 0.0)]).unwrap();
        for (nm, v) in [
            (0.0, 1.0),
            (400.0, 1.0),
            (450.0, 2.0),
            (500.0, 3.0),
            (505.0, 1.5),
            (510.0, 0.0),
            (2000.0, 0.0),
        ] {
            assert_eq!(s.value(nm), v, "{nm} nm");
        }
    }

    #[test]
    fn bad_samples_are_named() {
        assert_eq!(Spectrum::new(vec![]), Err(SpectrumError::Empty));
        assert_eq!(
            Spectrum::new(vec![(400.0, 1.0), (410.0, f64::NAN)]),
            Err(SpectrumError::NotFinite { index: 1 })
        );
        assert_eq!(
            Spectrum::new(vec![(-1.0, 1.0)]),
            Err(SpectrumError::NotFinite { index: 0 })
        );
        let e = Spectrum::new(vec![(400.0, 1.0), (400.0, 1.0)]).unwrap_err();
        assert_eq!(
            e.to_string(),
            "sample 1: expected a wavelength above 400 nm, found 400 nm"
        );
    }

    #[test]
    fn nothing_is_left_outside() {
        let s = Spectrum::new(vec![(400.0, 1.0), (500.0, 3.0)]).unwrap();
        let z = s.zero_outside();
        assert!(Spectrum::new(z.samples().to_vec()).is_ok());
        for (nm, v) in [
            (399.0, 0.0),
            (400.0, 1.0),
            (450.0, 2.0),
            (500.0, 3.0),
            (501.0, 0.0),
        ] {
            assert_eq!(z.value(nm), v, "{nm} nm");
        }
    }

    #[test]
    fn constant_is_constant() {
        assert_eq!(Spectrum::constant(0.3).value(1.0), 0.3);
        assert_eq!(Spectrum::constant(0.3).value(1e4), 0.3);
        assert_eq!(Spectrum::constant(f64::NAN).value(500.0), 0.0);
    }
}
