//! Errors of the tables against quadrature at random points.

use std::f64::consts::FRAC_PI_2;

use specula_bsdf::Alpha;
use specula_bsdf::energy::{DielectricLoss, Loss};
use specula_bsdf::internal::albedo::Tabulated;
use specula_bsdf::math::{Stream, Vec3};
use specula_bsdf::ndf::{Beckmann, Ggx};

use super::rule::{MASKINGS, Rule, view};

/// Largest and root of the mean squared difference.
#[derive(Default)]
struct Errors {
    largest: f64,
    squares: f64,
    count: f64,
    at: String,
}

impl Errors {
    fn push(&mut self, got: f64, expected: f64, at: impl Fn() -> String) {
        let error = (got - expected).abs();
        assert!(error.is_finite(), "{}", at());
        self.squares += error * error;
        self.count += 1.0;
        if error > self.largest {
            self.largest = error;
            self.at = at();
        }
    }

    fn rms(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }

    /// Prints and holds the bounds of the largest and of the mean error.
    fn hold(&self, name: &str, largest: f64, rms: f64) {
        println!(
            "{name}: largest {:.2e} at {}, rms {:.2e}",
            self.largest,
            self.at,
            self.rms()
        );
        assert!(
            self.count > 100.0 && self.largest > 1e-9,
            "{name} compares nothing"
        );
        assert!(self.largest < largest && self.rms() < rms, "{name}");
    }
}

/// A width, half the time uniform and half the time uniform in its logarithm.
fn width(stream: &mut Stream, [low, high]: [f64; 2]) -> f64 {
    let (kind, u): (f64, f64) = (stream.next(), stream.next());
    if kind < 0.5 {
        low + u * (high - low)
    } else {
        low * (high / low).powf(u)
    }
}

/// A cosine, half the time about as small as the width.
fn cosine(stream: &mut Stream, width: f64) -> f64 {
    let (kind, u): (f64, f64) = (stream.next(), stream.next());
    let cosine = if kind < 0.5 { u } else { 3.0 * u * u * width };
    cosine.clamp(1e-6, 1.0)
}

/// Two alphas and a view: a third of the alphas at the ends of the range, a third of the azimuths
/// near the narrow axis.
fn stretched_view(stream: &mut Stream, range: [f64; 2]) -> (Alpha<f64>, Vec3<f64>) {
    let (kind, turn, u): (f64, f64, f64) = (stream.next(), stream.next(), stream.next());
    let (mut x, mut y) = (width(stream, range), width(stream, range));
    if kind < 1.0 / 3.0 {
        let middle = (range[0] * range[1]).sqrt();
        (x, y) = (
            width(stream, [range[0], middle]),
            width(stream, [middle, range[1]]),
        );
    }
    let near = 3.0 * u * u * x.min(y) / x.max(y);
    let azimuth = match turn {
        t if t < 1.0 / 3.0 && x < y => near.atan(),
        t if t < 1.0 / 3.0 => FRAC_PI_2 - near.atan(),
        _ => FRAC_PI_2 * u,
    };
    let share = azimuth.sin().powi(2);
    let along = (x * x * (1.0 - share) + y * y * share).sqrt();
    (Alpha { x, y }, view(cosine(stream, along), share))
}

fn losses<N: Tabulated<f64>>(ndf: N, wo: Vec3<f64>) -> [f64; 2] {
    MASKINGS.map(|masking| Loss::new(ndf, masking).directional(wo))
}

fn isotropic_errors<N: Tabulated<f64>>(ndf: impl Fn(Alpha<f64>) -> N, range: [f64; 2]) -> Errors {
    let (rule, mut stream, mut errors) = (Rule::new(64, 32), Stream::new(1), Errors::default());
    for _ in 0..2000 {
        let a = width(&mut stream, range);
        let wo = view(cosine(&mut stream, a), 0.3);
        let ndf = ndf(Alpha { x: a, y: a });
        let exact = rule.albedo(&ndf, wo);
        for (loss, albedo) in losses(ndf, wo).into_iter().zip(exact) {
            errors.push(1.0 - loss, albedo, || {
                format!("alpha {a:.4}, mu {:.5}", wo.z)
            });
        }
    }
    errors
}

#[test]
fn isotropic_tables_hold_their_bounds() {
    let (usual, whole) = ([1e-4, 2.0], [1e-4, 10.0]);
    let ggx = |range| isotropic_errors(Ggx::new, range);
    ggx(usual).hold("GGX, usual alphas", 1e-4, 4e-6);
    ggx(whole).hold("GGX, all alphas", 5e-4, 2e-5);
    let beckmann = |range| isotropic_errors(Beckmann::new, range);
    beckmann(usual).hold("Beckmann, usual alphas", 2e-5, 4e-6);
    beckmann(whole).hold("Beckmann, all alphas", 1e-4, 5e-6);
}

/// Errors of the anisotropic tables, and of the isotropic ones at `sqrt(ax ay)`.
fn anisotropic_errors<N: Tabulated<f64>>(
    ndf: impl Fn(Alpha<f64>) -> N,
    range: [f64; 2],
) -> [Errors; 2] {
    let (rule, mut stream) = (Rule::new(40, 24), Stream::new(2));
    let mut errors = [Errors::default(), Errors::default()];
    for _ in 0..3000 {
        let (alpha, wo) = stretched_view(&mut stream, range);
        let mean = Alpha::isotropic((alpha.x * alpha.y).sqrt());
        let exact = rule.albedo(&ndf(alpha), wo);
        for (got, errors) in [losses(ndf(alpha), wo), losses(ndf(mean), wo)]
            .into_iter()
            .zip(&mut errors)
        {
            for (loss, albedo) in got.into_iter().zip(exact) {
                errors.push(1.0 - loss, albedo, || format!("{alpha:.4?}, {wo:.4?}"));
            }
        }
    }
    errors
}

#[test]
fn anisotropic_tables_hold_their_bounds() {
    let (usual, wide, whole) = ([0.02, 2.0], [1e-3, 2.0], [1e-4, 10.0]);
    let [specula, mean] = anisotropic_errors(Ggx::new, usual);
    specula.hold("GGX, [0.02, 2]", 1e-3, 1e-4);
    mean.hold("GGX, [0.02, 2], isotropic table", 1.0, 1.0);
    assert!(mean.rms() > 1000.0 * specula.rms());
    let [specula, _] = anisotropic_errors(Ggx::new, wide);
    specula.hold("GGX, [1e-3, 2]", 1e-3, 1e-4);
    let [specula, _] = anisotropic_errors(Ggx::new, whole);
    specula.hold("GGX, all alphas", 2e-2, 1e-3);
    let [specula, mean] = anisotropic_errors(Beckmann::new, usual);
    specula.hold("Beckmann, [0.02, 2]", 1e-3, 1e-4);
    mean.hold("Beckmann, [0.02, 2], isotropic table", 1.0, 1.0);
    assert!(mean.rms() > 1000.0 * specula.rms());
    let [specula, _] = anisotropic_errors(Beckmann::new, wide);
    specula.hold("Beckmann, [1e-3, 2]", 2e-3, 2e-4);
    let [specula, _] = anisotropic_errors(Beckmann::new, whole);
    specula.hold("Beckmann, all alphas", 2e-2, 1e-3);
}

fn interface_errors<N: Tabulated<f64>>(
    ndf: impl Fn(Alpha<f64>) -> N,
    range: [f64; 2],
    isotropic: bool,
) -> Errors {
    let (rule, mut stream, mut errors) = (Rule::new(28, 16), Stream::new(3), Errors::default());
    for _ in 0..800 {
        let (mut alpha, mut wo) = stretched_view(&mut stream, range);
        if isotropic {
            let a = width(&mut stream, range);
            (alpha, wo) = (Alpha::isotropic(a), view(cosine(&mut stream, a), 0.3));
        }
        let u: f64 = stream.next();
        let eta = if u < 0.5 {
            1.1 + 2.6 * u
        } else {
            1.0 / (1.1 + 2.6 * (u - 0.5))
        };
        let ndf = ndf(alpha);
        let exact = rule.dielectric_albedo(&ndf, eta, wo);
        for (masking, albedo) in MASKINGS.into_iter().zip(exact) {
            let loss = DielectricLoss::new(ndf, masking, eta).directional(wo);
            errors.push(1.0 - loss, albedo, || {
                format!("{alpha:.3?} eta {eta:.3} {wo:.4?}")
            });
        }
    }
    errors
}

#[test]
fn interface_tables_hold_their_bounds() {
    let (usual, wide) = ([0.05, 1.5], [0.02, 2.0]);
    interface_errors(Ggx::new, wide, true).hold("GGX interface", 8e-3, 1e-3);
    interface_errors(Beckmann::new, wide, true).hold("Beckmann interface", 8e-3, 1e-3);
    interface_errors(Ggx::new, usual, false).hold("GGX, [0.05, 1.5]", 2e-2, 2e-3);
    interface_errors(Ggx::new, wide, false).hold("GGX, [0.02, 2]", 5e-2, 4e-3);
    interface_errors(Beckmann::new, usual, false).hold("Beckmann, [0.05, 1.5]", 2e-2, 3e-3);
    interface_errors(Beckmann::new, wide, false).hold("Beckmann, [0.02, 2]", 5e-2, 4e-3);
}
