//! Arguments of cases: directions, alphas, indices, sequences, and their products.

use specula_bsdf::{Alpha, Real, Vec3};

/// Cosines of views above the horizon.
pub(crate) const ABOVE: [f64; 5] = [1.0, 0.7, 0.3, 0.05, 0.005];
/// Cosines of views below it: backfacing shading normals.
pub(crate) const BELOW: [f64; 3] = [-0.05, -0.3, -0.9];
/// Azimuths, radians.
pub(crate) const AZIMUTHS: [f64; 2] = [0.3, 2.1];
/// Alphas along x and y: those of the statistical proof, and the ends of the range.
pub(crate) const ALPHAS: [[f32; 2]; 14] = [
    [1e-4, 1e-4],
    [1e-3, 1e-3],
    [0.05, 0.05],
    [0.3, 0.3],
    [0.6, 0.6],
    [1.0, 1.0],
    [1.5, 1.5],
    [10.0, 10.0],
    [1e-4, 10.0],
    [0.05, 0.5],
    [0.2, 0.8],
    [0.6, 1.0],
    [1.2, 3.0],
    [8.0, 0.01],
];
/// Relative indices of refraction, inside over outside.
pub(crate) const ETAS: [f32; 4] = [1.5, 1.0 / 1.5, 1.1, 2.4];

/// The unit direction of a cosine and an azimuth, rounded to `f32`.
pub(crate) fn direction(cosine: f64, azimuth: f64) -> [f32; 3] {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    let w = [sine * azimuth.cos(), sine * azimuth.sin(), cosine];
    w.map(round)
}

/// Every cosine at every azimuth.
pub(crate) fn views(cosines: &[f64]) -> Vec<[f32; 3]> {
    let at = |&cosine: &f64| AZIMUTHS.map(|azimuth| direction(cosine, azimuth));
    cosines.iter().flat_map(at).collect()
}

/// Views above and below the horizon.
pub(crate) fn both_sides() -> Vec<[f32; 3]> {
    views(&[&ABOVE[..], &BELOW[..]].concat())
}

/// Point `i` of the two-dimensional R2 sequence, below 1 in `f32` too.
pub(crate) fn r2(i: usize) -> [f32; 2] {
    let at = |step: f64| {
        let i = u32::try_from(i).map_or(0.0, f64::from);
        // 24 digits: rounding up to 1 would be no random number.
        ((0.5 + i * step).fract() * 16_777_216.0).floor() / 16_777_216.0
    };
    [at(0.754_877_666_246_693), at(0.569_840_290_998_053)].map(round)
}

/// A number rounded to `f32`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding is what it is for"
)]
pub(crate) fn round(x: f64) -> f32 {
    x as f32
}

/// Arguments `x[at..at + 3]` as a vector.
pub(crate) fn vector<T: Real>(x: &[T], at: usize) -> Vec3<T> {
    Vec3 {
        x: x[at],
        y: x[at + 1],
        z: x[at + 2],
    }
}

/// Arguments `x[at..at + 2]` as alphas.
pub(crate) fn alpha<T: Real>(x: &[T], at: usize) -> Alpha<T> {
    Alpha {
        x: x[at],
        y: x[at + 1],
    }
}

/// Every one of `a` before every one of `b`, as one row of arguments.
pub(crate) fn product<const A: usize, const B: usize, const N: usize>(
    a: &[[f32; A]],
    b: &[[f32; B]],
) -> Vec<[f32; N]> {
    const { assert!(A + B == N) };
    let joined = |x: &[f32; A], y: &[f32; B]| {
        let mut row = [0.0; N];
        row[..A].copy_from_slice(x);
        row[A..].copy_from_slice(y);
        row
    };
    let rows = a.iter().flat_map(|x| b.iter().map(move |y| joined(x, y)));
    rows.collect()
}
