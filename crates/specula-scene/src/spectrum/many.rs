//! Many reflectances over the same wavelengths to linear sRGB.

use specula_bsdf::Rgb;

use super::colour::{channel_weights, to_f32, wavelengths};
use super::{Spectrum, SpectrumError};

/// [`reflectance_to_rgb`](super::reflectance_to_rgb) of spectra that share their wavelengths: one weight of each
/// channel for each of them, as spectra are linear between samples.
#[derive(Clone, Debug)]
pub(crate) struct SpectraToRgb {
    weights: Vec<[f64; 3]>,
}

impl SpectraToRgb {
    /// * `nm`: wavelengths, strictly increasing.
    pub(crate) fn new(nm: &[f64]) -> Result<Self, SpectrumError> {
        // The checks of a spectrum.
        Spectrum::new(nm.iter().map(|&nm| (nm, 0.0)).collect())?;
        let mut weights = vec![[0.0; 3]; nm.len()];
        for (at, weight) in wavelengths().zip(channel_weights()) {
            let next = nm.partition_point(|&w| w <= at);
            let (a, b) = (next.saturating_sub(1), next.min(nm.len() - 1));
            let t = if a == b {
                0.0
            } else {
                (at - nm[a]) / (nm[b] - nm[a])
            };
            // Before the first sample the first is taken.
            let t = t.max(0.0);
            for (channel, w) in weight.to_array().into_iter().enumerate() {
                weights[a][channel] += (1.0 - t) * w;
                weights[b][channel] += t * w;
            }
        }
        Ok(Self { weights })
    }

    /// The colour of a spectrum, one value for each wavelength.
    pub(crate) fn colour(&self, samples: &[f64]) -> Rgb<f32> {
        let mut sum = [0.0; 3];
        for (sample, weight) in samples.iter().zip(&self.weights) {
            for (s, w) in sum.iter_mut().zip(weight) {
                *s += sample * w;
            }
        }
        let largest = samples.iter().copied().fold(1.0, f64::max);
        to_f32(sum.map(|c| c.clamp(0.0, largest)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::reflectance_to_rgb;

    #[test]
    fn many_are_as_one() {
        for nm in [
            vec![360.0, 400.5, 512.0, 650.0, 900.0],
            vec![420.0, 421.0],
            vec![500.0],
        ] {
            let many = SpectraToRgb::new(&nm).unwrap();
            for seed in 0..5_u8 {
                let value =
                    |i: usize| f64::from(seed.wrapping_mul(37)) / 255.0 + (i as f64 * 0.7).sin();
                let samples: Vec<f64> = (0..nm.len()).map(value).collect();
                let pairs = nm.iter().copied().zip(samples.iter().copied()).collect();
                let expected = reflectance_to_rgb(&Spectrum::new(pairs).unwrap());
                let found = many.colour(&samples);
                for (f, e) in found.to_array().into_iter().zip(expected.to_array()) {
                    assert!((f - e).abs() < 1e-6, "{nm:?}: {found:?} {expected:?}");
                }
            }
        }
    }
}
