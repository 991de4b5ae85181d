//! Coated diffuse against pbrt-v4's walk: shares of light that a material in a white furnace sends
//! to the viewer.
//!
//! Measured with pbrt-v4 (commit 5f7a6068): a disk under an infinite light of radiance 1, seen at
//! the cosine `mu`, `simplepath` that samples the BSDF alone, a million walks each; in brackets the
//! standard error. Index 1.5, thickness 0.01 and `maxdepth` 10, pbrt's defaults, unless said
//! otherwise.
#![allow(clippy::print_stdout, reason = "a suite says what it found")]

use specula_bsdf::bsdf::{CoatLayer, CoatScattering, CoatedDiffuse};
use specula_bsdf::math::vec3;
use specula_bsdf::ndf::Ggx;
use specula_bsdf::{Alpha, Bsdf, Rgb, Transport};

/// pbrt-v4's coat: its facets scatter once.
fn pbrt(thickness: f64, max_depth: u32) -> CoatLayer<f64> {
    CoatLayer {
        thickness,
        max_depth: Some(max_depth),
        scattering: CoatScattering::Single,
    }
}

fn coated(alpha: [f64; 2], eta: f64, albedo: f64, layer: CoatLayer<f64>) -> CoatedDiffuse<f64> {
    let coat = (alpha[0] > 0.0).then(|| Ggx::new(Alpha::clamped(alpha[0], alpha[1])));
    CoatedDiffuse::over_layer(coat, eta, Rgb::splat(albedo), layer)
}

/// Share of constant light that the lobe sends to the cosine `mu`.
fn furnace(lobe: &CoatedDiffuse<f64>, mu: f64) -> f64 {
    const N: u32 = 40_000;
    let wo = vec3((1.0 - mu * mu).sqrt(), 0.0, mu);
    let point = |i: u32| {
        let at = |step: f64| (0.5 + f64::from(i) * step).fract();
        [at(0.819_172_513), at(0.671_043_607), at(0.549_700_478)]
    };
    let sampled = (0..N).filter_map(|i| lobe.sample(wo, point(i), Transport::Radiance));
    sampled.map(|s| s.weight.g).sum::<f64>() / f64::from(N)
}

/// Holds shares against pbrt's: within `relative`, and three standard errors.
fn hold(name: &str, got: f64, (expected, error): (f64, f64), relative: f64) {
    let off = got / expected - 1.0;
    println!("{name}: {got:.4} {expected:.4} {:+.2} %", 100.0 * off);
    assert!(
        (got - expected).abs() < relative * expected + 3.0 * error,
        "{name}: {got} {expected} {error}"
    );
}

/// Cosines of the views of [`BY_VIEW`].
const VIEWS: [f64; 4] = [1.0, 0.7, 0.4, 0.15];

/// Albedo, alpha, and pbrt's share and its error by view.
type Row = (f64, f64, [(f64, f64); 4]);

#[rustfmt::skip]
const BY_VIEW: [Row; 12] = [
    (0.5, 0.00, [(0.30385, 30e-5), (0.31126, 31e-5), (0.37032, 36e-5), (0.59205, 42e-5)]),
    (0.5, 0.10, [(0.29885, 29e-5), (0.30623, 30e-5), (0.35341, 33e-5), (0.45095, 35e-5)]),
    (0.5, 0.32, [(0.26732, 26e-5), (0.26861, 26e-5), (0.27956, 26e-5), (0.31164, 31e-5)]),
    (0.5, 0.55, [(0.23001, 23e-5), (0.22449, 24e-5), (0.22216, 23e-5), (0.24051, 25e-5)]),
    (0.8, 0.00, [(0.58474, 45e-5), (0.58761, 45e-5), (0.62317, 45e-5), (0.75659, 44e-5)]),
    (0.8, 0.10, [(0.56368, 46e-5), (0.56661, 43e-5), (0.59194, 44e-5), (0.63328, 44e-5)]),
    (0.8, 0.32, [(0.46931, 41e-5), (0.46470, 38e-5), (0.45997, 38e-5), (0.47274, 35e-5)]),
    (0.8, 0.55, [(0.38489, 35e-5), (0.37063, 37e-5), (0.35425, 33e-5), (0.36147, 31e-5)]),
    (1.0, 0.00, [(0.86514, 28e-5), (0.86508, 29e-5), (0.87571, 29e-5), (0.91971, 24e-5)]),
    (1.0, 0.10, [(0.82101, 33e-5), (0.81999, 32e-5), (0.82342, 33e-5), (0.80970, 31e-5)]),
    (1.0, 0.32, [(0.64356, 42e-5), (0.63372, 43e-5), (0.61625, 42e-5), (0.61180, 38e-5)]),
    (1.0, 0.55, [(0.50588, 41e-5), (0.48534, 44e-5), (0.45773, 39e-5), (0.45624, 35e-5)]),
];

#[test]
fn a_white_furnace_by_albedo_roughness_and_view() {
    for (albedo, alpha, shares) in BY_VIEW {
        let lobe = coated([alpha; 2], 1.5, albedo, pbrt(0.01, 10));
        for (mu, expected) in VIEWS.into_iter().zip(shares) {
            let name = format!("albedo {albedo} alpha {alpha} mu {mu}");
            hold(&name, furnace(&lobe, mu), expected, 4e-3);
        }
    }
}
