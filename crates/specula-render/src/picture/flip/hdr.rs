//! HDR-FLIP: the largest LDR-FLIP over the exposures at which a picture can be viewed.

use specula_bsdf::Rgb;

use super::flip_map;

/// Coefficients of the curve `(k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5)`: Narkowicz 2015 with the
/// factor 0.6 on the input, which the metric's authors chose.
const K: [f32; 6] = [
    0.6 * 0.6 * 2.51,
    0.6 * 0.03,
    0.0,
    0.6 * 0.6 * 2.43,
    0.6 * 0.59,
    0.14,
];

/// Tone-mapped value that the brightest pixel has at the first exposure and the median at the last.
const SHOWN_AT: f32 = 0.85;

/// HDR-FLIP of each pixel, in `[0, 1]`.
///
/// ```text
/// max over i in 0..n of LDR-FLIP(tone(2^c_i reference), tone(2^c_i test))
/// c_0 = log2(x / max Y),  c_(n-1) = log2(x / median Y),  tone(x) = 0.85,  n = max(2, ceil(c_(n-1) - c_0))
/// ```
///
/// * `reference`, `test`: linear RGB, unbounded; negative and non-finite values count as 0.
///
/// # Panics
///
/// Where the lengths disagree.
#[must_use]
pub fn hdr_flip_map(reference: &[Rgb<f32>], test: &[Rgb<f32>], width: u32) -> Vec<f32> {
    let (start, stop) = exposure_range(reference);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "bounded by the range of exponents of f32"
    )]
    let count = (stop - start).ceil().max(2.0) as u16;
    let step = (stop - start) / f32::from(count - 1);
    let mut largest = vec![0.0f32; reference.len()];
    for i in 0..count {
        let gain = (start + f32::from(i) * step).exp2();
        let shown = |picture: &[Rgb<f32>]| -> Vec<Rgb<f32>> {
            picture.iter().map(|c| c.map(|v| tone(v, gain))).collect()
        };
        for (l, f) in largest
            .iter_mut()
            .zip(flip_map(&shown(reference), &shown(test), width))
        {
            *l = l.max(f);
        }
    }
    largest
}

fn tone(value: f32, gain: f32) -> f32 {
    if !value.is_finite() {
        return 0.0;
    }
    // Far beyond white: the squares stay finite.
    let x = (value * gain).clamp(0.0, 1.0e6);
    let mapped = (K[0] * x * x + K[1] * x + K[2]) / (K[3] * x * x + K[4] * x + K[5]);
    mapped.clamp(0.0, 1.0)
}

/// First and last exposure in stops; both 0 where the reference is black.
fn exposure_range(reference: &[Rgb<f32>]) -> (f32, f32) {
    // Where tone(x) = SHOWN_AT: the positive root of a x^2 + b x + c.
    let a = K[0] - SHOWN_AT * K[3];
    let b = K[1] - SHOWN_AT * K[4];
    let c = K[2] - SHOWN_AT * K[5];
    let x = (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a);
    let mut luminance: Vec<f32> = reference
        .iter()
        .filter(|c| c.is_finite())
        .map(|c| c.luminance().max(0.0))
        .collect();
    luminance.sort_by(f32::total_cmp);
    let Some(&brightest) = luminance.last() else {
        return (0.0, 0.0);
    };
    if brightest <= f32::MIN_POSITIVE {
        return (0.0, 0.0);
    }
    let middle = luminance.len() / 2;
    let median = if luminance.len().is_multiple_of(2) {
        0.5 * (luminance[middle - 1] + luminance[middle])
    } else {
        luminance[middle]
    };
    // Where more than half of the picture is black there is no median to expose for: 12 stops
    // below the brightest stand in.
    let median = median.max(brightest * 2.0f32.powi(-12));
    ((x / brightest).log2(), (x / median).log2())
}
