//! False colours for pictures of differences.

use super::finite;

/// Anchors of the map, evenly spaced over `[0, 1]`, sRGB-encoded bytes.
///
/// Sampled from matplotlib's `inferno` (van der Walt and Smith 2015, CC0), which is perceptually
/// uniform; linear interpolation between them stays within 4 steps of 255.
const INFERNO: [[u8; 3]; 17] = [
    [0, 0, 4],
    [10, 7, 34],
    [32, 12, 74],
    [60, 9, 101],
    [87, 16, 110],
    [114, 25, 110],
    [140, 41, 99],
    [165, 44, 96],
    [188, 55, 84],
    [209, 72, 67],
    [227, 89, 51],
    [241, 113, 31],
    [249, 142, 9],
    [252, 173, 18],
    [249, 203, 53],
    [242, 234, 105],
    [252, 255, 164],
];

/// A value in `[0, 1]` as a colour: black through red to pale yellow, sRGB bytes.
///
/// Values outside are held at the ends; NaN is shown as 0.
#[must_use]
pub fn inferno(value: f32) -> [u8; 3] {
    let position = finite(value.clamp(0.0, 1.0)) * 16.0;
    let lower = position.floor().min(15.0);
    let t = position - lower;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "in 0..=15"
    )]
    let index = lower as usize;
    let (a, b) = (INFERNO[index], INFERNO[index + 1]);
    [0, 1, 2]
        .map(|c| super::srgb::to_byte((f32::from(a[c]) * (1.0 - t) + f32::from(b[c]) * t) / 255.0))
}

/// A map of values in `[0, 1]` as sRGB bytes, three per pixel.
#[must_use]
pub fn difference_rgb8(map: &[f32]) -> Vec<u8> {
    map.iter().flat_map(|&v| inferno(v)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_rising_luminance() {
        assert_eq!(inferno(0.0), [0, 0, 4]);
        assert_eq!(inferno(1.0), [252, 255, 164]);
        assert_eq!(inferno(9.0), inferno(1.0));
        assert_eq!(inferno(f32::NAN), inferno(0.0));
        let mut last = -1.0;
        for i in 0..=64u16 {
            let [r, g, b] = inferno(f32::from(i) / 64.0).map(f32::from);
            let luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            assert!(luma > last, "at {i}: {luma} after {last}");
            last = luma;
        }
    }
}
