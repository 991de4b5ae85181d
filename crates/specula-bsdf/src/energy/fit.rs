//! The lost energy of isotropic GGX as a short formula: 30 coefficients, one square root.
//!
//! ```text
//! p = sqrt(mu (1 + alpha) / (mu + alpha)),   q = alpha / (1 + alpha)
//! sqrt(1 - E) = sum_i sum_j c_ij p^i q^j  clamped to [0, 1],    i < 6, j < 5
//! ```
//!
//! for height-correlated masking and alpha in `[1e-4, 1]`: error of E at most 4e-3 (3.0e-3 measured,
//! rms 1.4e-3; test `the_fit_holds_its_bound`), for shaders that hold no table. The root is what is
//! smooth where little is lost.
//!
//! Coefficients: weighted least squares of the root over 64 x 32 knots, uniform in `alpha^(1/4)` up
//! to alpha 1.05 and in the cosine's coordinate (`coordinates`); the weights are raised in 300 rounds where the error of E is largest
//! (Lawson's iteration, exponent 1/2). The coefficients are those of the best round.

use crate::math::Real;

/// `1 - E(mu)` of height-correlated isotropic GGX, in `[0, 1]`.
///
/// * `alpha`: in `[1e-4, 1]`; beyond, the nearest is taken.
/// * `cosine`: in `[0, 1]`.
#[inline]
pub fn ggx_loss<T: Real>(alpha: T, cosine: T) -> T {
    let alpha = alpha.within(T::of(1e-4), T::ONE);
    let p = (cosine * (T::ONE + alpha) / (cosine + alpha)).sqrt();
    let q = alpha / (T::ONE + alpha);
    let horner = |x: T, values: [T; 6]| values.into_iter().rev().fold(T::ZERO, |s, c| s * x + c);
    let root = horner(
        p,
        COEFFICIENTS.map(|row| {
            row.into_iter()
                .rev()
                .fold(T::ZERO, |sum, c| sum * q + T::of(c))
        }),
    );
    root.within(T::ZERO, T::ONE).squared()
}

/// `c_ij`, a row for each power of `p`.
const COEFFICIENTS: [[f64; 5]; 6] = [
    [
        -0.245_901_0,
        -0.655_554_6,
        11.829_469_5,
        -28.312_673_5,
        18.529_209_0,
    ],
    [
        3.613_493_9,
        6.439_166_3,
        -130.391_143_4,
        324.052_491_5,
        -207.869_257_9,
    ],
    [
        -14.143_201_9,
        -22.847_436_5,
        567.807_967_5,
        -1_389.720_719_5,
        879.686_702_7,
    ],
    [
        28.299_140_5,
        32.968_836_2,
        -1_118.351_096_5,
        2_829.565_950_2,
        -1_854.924_241_0,
    ],
    [
        -24.664_690_1,
        -22.153_752_1,
        1_018.577_510_0,
        -2_706.787_869_6,
        1_876.129_181_6,
    ],
    [
        7.089_739_4,
        7.888_514_7,
        -349.807_865_8,
        976.852_741_9,
        -720.493_902_5,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::alpha::Alpha;
    use crate::energy::Loss;
    use crate::math::vec3;
    use crate::ndf::{Ggx, Masking};

    #[test]
    fn the_fit_holds_its_bound() {
        let mut worst = 0.0_f64;
        for i in 0..=200 {
            let alpha = 1e-4 + (f64::from(i) / 200.0).powi(3) * (1.0 - 1e-4);
            let loss = Loss::new(Ggx::new(Alpha::isotropic(alpha)), Masking::default());
            for k in 0..=400 {
                let cosine = (f64::from(k) / 400.0).powi(4);
                let wo = vec3((1.0 - cosine * cosine).sqrt(), 0.0, cosine);
                let error = (ggx_loss(alpha, cosine) - loss.directional(wo)).abs();
                assert!(error < 4e-3, "{alpha} {cosine}: {error}");
                worst = worst.max(error);
            }
        }
        println!("largest error {worst:.1e}");
        assert!(worst > 1e-3, "the comparison compares nothing");
        // The same in f32, where a shader runs.
        let single = f64::from(ggx_loss(0.37_f32, 0.21));
        assert!((single - ggx_loss(0.37, 0.21)).abs() < 1e-4);
    }
}
