//! Complex index of a metal over wavelength to one complex index per RGB channel.

use specula_bsdf::Rgb;
use specula_bsdf::fresnel::Conductor;

use super::Spectrum;
use super::colour::{channel_weights, to_f32, under_d65, wavelengths};

/// Cosines at which reflectances are compared: `i / STEPS` for `i` in `1..=STEPS`.
const STEPS: u32 = 48;

/// Range of a fitted `n`.
const N_RANGE: (f64, f64) = (1e-4, 100.0);

/// Range of a fitted `k`; the lowest counts as 0.
const K_RANGE: (f64, f64) = (1e-6, 100.0);

/// Weight of the squared distance from the start (in `ln n`, `ln k`) beside that of the mean
/// squared error. It decides only where the reflectance hardly does: the red of gold, clamped to 1,
/// is that of any `k` with `n` near 0. A tenth of it moves no metal's worst error by more than
/// 0.0004, gold's red excepted.
const PULL: f64 = 1e-5;

/// One complex index per channel, with its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductorFit {
    /// Real parts `n_c`.
    pub eta: [f64; 3],
    /// Imaginary parts `k_c`.
    pub k: [f64; 3],
    /// `max |F(mu; n_c, k_c) - clamp(R_c(mu))|` over the cosines.
    pub error: [f64; 3],
    /// The same of the averaged index (`n` and `k` integrated as if they were colours, negative
    /// values set to 0).
    pub averaged_error: [f64; 3],
    /// `max |R_c(mu) - clamp(R_c(mu))|`: by how much the metal leaves the gamut.
    pub gamut_excess: [f64; 3],
}

/// Complex index of a metal, for rendering in linear sRGB: `(eta, k)`.
///
/// What a picture shows of a metal is its reflectance. Seen under D65, channel `c` reflects
///
/// ```text
/// R_c(mu) = sum W_c(nm) F(mu; n(nm), k(nm)),     W_c = channel weights, sum W_c = 1
/// ```
///
/// and a renderer in RGB can only compute `F(mu; n_c, k_c)`. So `n_c` and `k_c` are chosen to make
/// the two agree, by least squares over the cosine `mu` in `(0, 1]` with weight `mu` (that of a
/// projected solid angle). Averaging `n` and `k` themselves as if they were colours gives wrong
/// ones: `F` is not linear in them, and `W_c` is negative at some wavelengths, so that an average
/// can leave the range of the data.
///
/// * `eta`, `k`: real and imaginary part of the index over wavelength; negative values count as 0.
/// * Returns: linear sRGB, finite, `eta` positive, `k` at least 0.
///
/// Worst difference from `R_c(mu)`, over `mu`, channels and the 22 metals of `data/metals`:
///
/// | index | worst | where | gold: r, g, b |
/// |---|---|---|---|
/// | fitted | 0.0047 | brass, red | 0.0038, 0.0010, 0.0019 |
/// | averaged | 0.0194 | gold, red | 0.0194, 0.0101, 0.0115 |
///
/// Both are measured against `R_c` clamped to `[0, 1]`. Gold alone leaves it: it is more saturated
/// than sRGB can show, its red reaches 1.0376 at normal incidence, and no index reflects more
/// than 1. Its red channel is fitted to 1, which loses 0.04 of the first reflection and never
/// creates energy.
///
/// Invariant: constant `eta` and `k` come back (test `constant_index_comes_back`); the errors are
/// held by the test `metals::tests::fit_errors_are_within_the_documented_bounds` of xtask.
#[must_use]
pub fn conductor_index_to_rgb(eta: &Spectrum, k: &Spectrum) -> (Rgb<f32>, Rgb<f32>) {
    let fit = fit_conductor(eta, k);
    (to_f32(fit.eta), to_f32(fit.k))
}

/// [`conductor_index_to_rgb`] in f64, with its errors.
///
/// Weighted least squares in `(ln n, ln k)`, 48 cosines, by Levenberg and Marquardt's method from
/// the averages of `n` and `k` (Levenberg 1944; Marquardt 1963).
#[must_use]
pub fn fit_conductor(eta: &Spectrum, k: &Spectrum) -> ConductorFit {
    let reflectance: Vec<[f64; 3]> = cosines()
        .map(|mu| under_d65(|nm| fresnel(mu, eta.value(nm).max(0.0), k.value(nm).max(0.0))))
        .collect();
    let (eta_average, k_average) = (
        under_d65(|nm| eta.value(nm)).map(|n| n.max(0.0)),
        under_d65(|nm| k.value(nm)).map(|k| k.max(0.0)),
    );
    let (eta_range, k_range) = (seen_range(eta), seen_range(k));
    let mut fit = ConductorFit {
        eta: eta_average,
        k: k_average,
        error: [0.0; 3],
        averaged_error: [0.0; 3],
        gamut_excess: [0.0; 3],
    };
    for c in 0..3 {
        let raw: Vec<f64> = reflectance.iter().map(|r| r[c]).collect();
        let target: Vec<f64> = raw.iter().map(|r| r.clamp(0.0, 1.0)).collect();
        // The average can leave the data's range (see above); the start must not.
        let start = [
            eta_average[c].clamp(eta_range.0, eta_range.1),
            k_average[c].clamp(k_range.0, k_range.1),
        ];
        let [n, k] = fit_channel(&target, start, PULL);
        (fit.eta[c], fit.k[c]) = (n, if k <= 1.5 * K_RANGE.0 { 0.0 } else { k });
        fit.error[c] = worst_error(&target, fit.eta[c], fit.k[c]);
        fit.averaged_error[c] = worst_error(&target, eta_average[c], k_average[c]);
        fit.gamut_excess[c] = raw
            .iter()
            .zip(&target)
            .map(|(r, t)| (r - t).abs())
            .fold(0.0, f64::max);
    }
    fit
}

fn cosines() -> impl Iterator<Item = f64> {
    (1..=STEPS).map(|i| f64::from(i) / f64::from(STEPS))
}

/// Smallest and largest value that the eye can tell, not negative.
fn seen_range(s: &Spectrum) -> (f64, f64) {
    let seen = wavelengths()
        .zip(channel_weights())
        .filter(|(_, w)| w.abs().max_element() > 1e-4);
    seen.map(|(nm, _)| s.value(nm).max(0.0))
        .fold((f64::INFINITY, 0.0), |(lo, hi), v| (lo.min(v), hi.max(v)))
}

fn worst_error(target: &[f64], n: f64, k: f64) -> f64 {
    cosines()
        .zip(target)
        .map(|(mu, r)| (fresnel(mu, n, k) - r).abs())
        .fold(0.0, f64::max)
}

/// The `[n, k]` whose reflectance is nearest to `target` at [`cosines`]; `pull` as in [`PULL`].
fn fit_channel(target: &[f64], start: [f64; 2], pull: f64) -> [f64; 2] {
    let within = |p: [f64; 2]| {
        [
            p[0].clamp(N_RANGE.0.ln(), N_RANGE.1.ln()),
            p[1].clamp(K_RANGE.0.ln(), K_RANGE.1.ln()),
        ]
    };
    let origin = within(start.map(f64::ln));
    let mut here = origin;
    let mut system = NormalEquations::at(here, origin, target, pull);
    let mut damping = 1e-3;
    for _ in 0..200 {
        let [dn, dk] = system.step(damping);
        let there = within([here[0] + dn, here[1] + dk]);
        let next = NormalEquations::at(there, origin, target, pull);
        if next.cost < system.cost {
            let moved = (there[0] - here[0]).abs() + (there[1] - here[1]).abs();
            (here, system) = (there, next);
            damping = (damping * 0.1).max(1e-12);
            if moved < 1e-12 {
                break;
            }
        } else {
            damping *= 10.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    here.map(f64::exp)
}

/// Cost, gradient and Gauss-Newton matrix at `p = (ln n, ln k)`.
struct NormalEquations {
    cost: f64,
    gradient: [f64; 2],
    /// `[[a, b], [b, d]]` as `[a, b, d]`.
    matrix: [f64; 3],
}

impl NormalEquations {
    fn at(p: [f64; 2], origin: [f64; 2], target: &[f64], pull: f64) -> Self {
        const H: f64 = 1e-5;
        let f = |mu: f64, p0: f64, p1: f64| fresnel(mu, p0.exp(), p1.exp());
        let total: f64 = cosines().sum();
        let away = [p[0] - origin[0], p[1] - origin[1]];
        let mut s = Self {
            cost: pull * (away[0] * away[0] + away[1] * away[1]),
            gradient: away.map(|d| pull * d),
            matrix: [pull, 0.0, pull],
        };
        for (mu, r) in cosines().zip(target) {
            let weight = mu / total;
            let e = f(mu, p[0], p[1]) - r;
            let dn = (f(mu, p[0] + H, p[1]) - f(mu, p[0] - H, p[1])) / (2.0 * H);
            let dk = (f(mu, p[0], p[1] + H) - f(mu, p[0], p[1] - H)) / (2.0 * H);
            s.cost += weight * e * e;
            s.gradient[0] += weight * e * dn;
            s.gradient[1] += weight * e * dk;
            s.matrix[0] += weight * dn * dn;
            s.matrix[1] += weight * dn * dk;
            s.matrix[2] += weight * dk * dk;
        }
        s
    }

    /// Solves `(A + damping diag A) x = -g`; `A` is positive definite by the pull.
    fn step(&self, damping: f64) -> [f64; 2] {
        let [a, b, d] = self.matrix;
        let (a, d) = (a * (1.0 + damping), d * (1.0 + damping));
        let [g0, g1] = self.gradient;
        let det = a * d - b * b;
        [(b * g1 - d * g0) / det, (b * g0 - a * g1) / det]
    }
}

/// Unpolarised reflectance `F(mu; n, k)`: the renderer's own, for one index.
fn fresnel(mu: f64, n: f64, k: f64) -> f64 {
    let metal = Conductor {
        eta: Rgb::splat(n),
        k: Rgb::splat(k),
    };
    metal.eval(mu).r
}

#[cfg(test)]
mod tests {
    use super::super::named;
    use super::*;

    #[test]
    fn constant_index_comes_back() {
        for (n, k) in [(0.2, 3.9), (2.9, 3.1), (1.5, 0.0), (13.0, 2.0), (1e-3, 8.0)] {
            let fit = fit_conductor(&Spectrum::constant(n), &Spectrum::constant(k));
            for c in 0..3 {
                assert!((fit.eta[c] / n - 1.0).abs() < 1e-6, "{n}, {k}: {fit:?}");
                assert!((fit.k[c] - k).abs() <= 1e-6 * k, "{n}, {k}: {fit:?}");
                assert!(fit.error[c] < 1e-9, "{n}, {k}: {fit:?}");
            }
        }
    }

    /// Without its pull, the fit finds an index that it was not started from.
    #[test]
    fn fit_recovers_an_index_from_far_away() {
        for (n, k) in [(0.2, 3.9), (2.9, 3.1), (0.9, 6.0), (1.4, 1.8)] {
            let target: Vec<f64> = cosines().map(|mu| fresnel(mu, n, k)).collect();
            for start in [[1.0, 1.0], [5.0, 8.0], [0.05, 2.0]] {
                let found = fit_channel(&target, start, 1e-14);
                assert!(
                    (found[0] / n - 1.0).abs() < 1e-4,
                    "{n}, {k} from {start:?}: {found:?}"
                );
                assert!(
                    (found[1] / k - 1.0).abs() < 1e-4,
                    "{n}, {k} from {start:?}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn copper_is_copper_and_the_fit_beats_the_average() {
        let (eta, k) = (named("metal-Cu-eta").unwrap(), named("metal-Cu-k").unwrap());
        let fit = fit_conductor(&eta, &k);
        let f0: Vec<f64> = (0..3).map(|c| fresnel(1.0, fit.eta[c], fit.k[c])).collect();
        for (found, expected) in f0.iter().zip([0.952, 0.639, 0.536]) {
            assert!((found - expected).abs() < 0.005, "{f0:?}");
        }
        for c in 0..3 {
            assert!(fit.error[c] < 0.006, "{fit:?}");
            assert!(fit.error[c] < 0.5 * fit.averaged_error[c], "{fit:?}");
        }
    }

    #[test]
    fn gold_leaves_the_gamut_and_is_clamped() {
        let (eta, k) = (named("metal-Au-eta").unwrap(), named("metal-Au-k").unwrap());
        let fit = fit_conductor(&eta, &k);
        assert!((fit.gamut_excess[0] - 0.0527).abs() < 1e-3, "{fit:?}");
        assert_eq!(fit.gamut_excess[1..], [0.0, 0.0]);
        for (error, bound) in fit.error.iter().zip([0.005, 0.001, 0.0025]) {
            assert!(*error < bound, "{fit:?}");
        }
        assert!(
            (0.0..0.1).contains(&fit.eta[0]) && (2.0..12.0).contains(&fit.k[0]),
            "{fit:?}"
        );
        assert!(fresnel(1.0, fit.eta[0], fit.k[0]) <= 1.0);
    }

    #[test]
    fn bad_data_gives_finite_indices() {
        for (n, k) in [(0.0, 0.0), (-1.0, -1.0), (1e9, 1e9), (1.0, 0.0)] {
            let fit = fit_conductor(&Spectrum::constant(n), &Spectrum::constant(k));
            for v in fit.eta.into_iter().chain(fit.k) {
                assert!(v.is_finite() && v >= 0.0, "{n}, {k}: {fit:?}");
            }
        }
    }
}
