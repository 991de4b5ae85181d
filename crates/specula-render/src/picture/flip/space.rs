//! The colour spaces that FLIP works in: XYZ, YCxCz, Hunt-adjusted L*a*b*.

use specula_bsdf::{Rgb, math::rgb};

/// Linear sRGB to XYZ, rows; IEC 61966-2-1 primaries in full precision.
const XYZ_FROM_RGB: [[f32; 3]; 3] = [
    [0.412_386_56, 0.357_591_5, 0.180_450_5],
    [0.212_636_82, 0.715_183, 0.072_180_2],
    [0.019_330_62, 0.119_197_16, 0.950_372_6],
];

/// The inverse of [`XYZ_FROM_RGB`].
const RGB_FROM_XYZ: [[f32; 3]; 3] = [
    [3.241_003_3, -1.537_398_9, -0.498_615_9],
    [-0.969_224_3, 1.875_93, 0.041_554_226],
    [0.055_639_42, -0.204_011_2, 1.057_149],
];

/// XYZ of linear RGB (1, 1, 1): D65.
fn white() -> [f32; 3] {
    XYZ_FROM_RGB.map(|row| row[0] + row[1] + row[2])
}

fn apply(matrix: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

fn relative_xyz(linear: Rgb<f32>) -> [f32; 3] {
    let xyz = apply(&XYZ_FROM_RGB, linear.to_array());
    let w = white();
    [xyz[0] / w[0], xyz[1] / w[1], xyz[2] / w[2]]
}

/// Linear RGB to the linear opponent space YCxCz (eq. 2).
pub(super) fn to_ycxcz(linear: Rgb<f32>) -> [f32; 3] {
    let [x, y, z] = relative_xyz(linear);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`to_ycxcz`], cut off to `[0, 1]`.
pub(super) fn ycxcz_to_linear(c: [f32; 3]) -> Rgb<f32> {
    let y = (c[0] + 16.0) / 116.0;
    let x = y + c[1] / 500.0;
    let z = y - c[2] / 200.0;
    let w = white();
    let [r, g, b] = apply(&RGB_FROM_XYZ, [x * w[0], y * w[1], z * w[2]]);
    rgb(r, g, b).map(|v| v.clamp(0.0, 1.0))
}

/// Linear RGB to L*a*b* whose a* and b* are scaled by L*/100, as colourfulness falls with
/// luminance (Hunt 1952; eq. 6).
pub(super) fn hunt_lab(linear: Rgb<f32>) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let curve = |t: f32| {
        if t > DELTA * DELTA * DELTA {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    };
    let [x, y, z] = relative_xyz(linear).map(curve);
    let lightness = 116.0 * y - 16.0;
    let scale = 0.01 * lightness;
    [lightness, scale * 500.0 * (x - y), scale * 200.0 * (y - z)]
}

/// The HyAB distance (Abasi et al. 2020; eq. 7): city block in lightness, Euclid in colour.
pub(super) fn hyab(a: [f32; 3], b: [f32; 3]) -> f32 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opponent_space_is_inverted() {
        for c in [
            rgb(0.0, 0.0, 0.0),
            rgb(1.0, 1.0, 1.0),
            rgb(0.2, 0.7, 0.4),
            rgb(0.9, 0.05, 0.3),
        ] {
            let back = ycxcz_to_linear(to_ycxcz(c));
            let error = (back - c).map(f32::abs).max_channel();
            assert!(error < 2e-6, "{c:?} -> {back:?}");
        }
    }

    #[test]
    fn white_is_lightness_100_without_colour() {
        let [l, a, b] = hunt_lab(rgb(1.0, 1.0, 1.0));
        assert!((l - 100.0).abs() < 1e-4 && a.abs() < 1e-4 && b.abs() < 1e-4);
        let [l, a, b] = hunt_lab(rgb(0.0, 0.0, 0.0));
        assert!(l.abs() < 1e-4 && a.abs() < 1e-4 && b.abs() < 1e-4);
    }
}
