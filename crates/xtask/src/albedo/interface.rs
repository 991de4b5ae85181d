//! Tables of rough dielectric interfaces.

use specula_bsdf::Alpha;
use specula_bsdf::energy::DielectricLoss;
use specula_bsdf::internal::albedo::Tabulated;
use specula_bsdf::internal::coordinates::{
    AlphaPair, alpha_at, alpha_coordinate, average_scale, edge, interface_cosine_coordinate,
};
use specula_bsdf::internal::dielectric_albedo::{
    self, ALPHAS, ANISOTROPIC_ALPHAS, ANISOTROPIC_AZIMUTHS, ANISOTROPIC_COSINES, ANISOTROPIC_ETAS,
    ANISOTROPIC_PAIRS, ANISOTROPIC_ROWS, COSINES, ETAS, eta_at,
};
use specula_bsdf::internal::rows::{HIGH, LOW, Rows};
use specula_bsdf::internal::spline::{Cubic, Quadratic};
use specula_bsdf::math::Vec3;

use super::digits::Digits;
use super::reflection::{AVERAGE_LIMITS, fold, pairs, unfold};
use super::rule::{Rule, view};
use super::spline::{Axis, coefficients};
use super::{average, azimuthal_average, difference, parallel, root, solve};

const LIMITS: [f64; 2] = [LOW, HIGH];

const AXES: [Axis; 3] = [
    Axis::Cubic(ETAS / 2),
    Axis::Cubic(ALPHAS),
    Axis::Cubic(COSINES),
];

/// Places and indices of both halves of an axis, in the order of the rows.
fn etas(axis: Axis) -> Vec<(f64, f64)> {
    let below = axis.places().into_iter().map(|x| (x, 1.0 / eta_at(x)));
    let above = axis.places().into_iter().map(|x| (x, eta_at(x)));
    below.chain(above).collect()
}

/// Coefficients of the isotropic table, by masking.
pub(super) fn isotropic<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
) -> [Vec<f64>; 2] {
    let [_, alphas, cosines] = AXES.map(Axis::places);
    let etas = etas(AXES[0]);
    let rule = Rule::new(32, 16);
    let rows = parallel(ETAS * ALPHAS, |row| {
        let ((_, eta), width) = (etas[row / ALPHAS], alpha_at(alphas[row % ALPHAS]));
        let ndf = ndf(Alpha { x: width, y: width });
        let value = |&m: &f64| {
            let place = |cosine| interface_cosine_coordinate(cosine, width, edge(eta));
            let wo = view(solve(m, place), 0.0);
            rule.dielectric_albedo(&ndf, eta, wo).map(root)
        };
        cosines.iter().map(value).collect::<Vec<_>>()
    });
    [0, 1].map(|masking| {
        let mut table: Vec<f64> = rows.iter().flatten().map(|roots| roots[masking]).collect();
        let half = table.len() / 2;
        table
            .chunks_mut(half)
            .for_each(|half| coefficients(&AXES, half));
        table
    })
}

/// The texts of the isotropic table and of its averages.
pub(super) fn with_averages(table: &[f64]) -> (Digits, Digits) {
    let mut digits = Digits::default();
    for row in table.chunks(COSINES) {
        digits.line(row, 2, LIMITS);
    }
    let rows = Rows::new(digits.text.as_bytes(), ETAS * ALPHAS);
    let (etas, alphas) = (etas(AXES[0]), AXES[1].places());
    let mut averages = parallel(ETAS * ALPHAS, |row| {
        let ((x, eta), width) = (etas[row / ALPHAS], alpha_at(alphas[row % ALPHAS]));
        let start = dielectric_albedo::half(eta, ETAS);
        let knots = Cubic::cubic(x, ETAS / 2);
        let alpha = Cubic::cubic(alpha_coordinate(width), ALPHAS);
        let loss = average(|cosine| {
            let m = interface_cosine_coordinate(cosine, width, edge(eta));
            dielectric_albedo::isotropic(rows, start, [&knots, &alpha], m).powi(2)
        });
        loss.sqrt() / average_scale(width, width)
    });
    let mut text = Digits::default();
    for half in averages.chunks_mut(ETAS * ALPHAS / 2) {
        coefficients(&AXES[..2], half);
        for row in half.chunks(ALPHAS) {
            text.line(row, 4, AVERAGE_LIMITS);
        }
    }
    (digits, text)
}

const ANISOTROPIC_AXES: [Axis; 5] = [
    Axis::Quadratic(ANISOTROPIC_ETAS / 2),
    Axis::Quadratic(ANISOTROPIC_ALPHAS),
    Axis::Quadratic(ANISOTROPIC_ALPHAS),
    Axis::Quadratic(ANISOTROPIC_AZIMUTHS),
    Axis::Quadratic(ANISOTROPIC_COSINES),
];

/// The view at coordinates of the anisotropic table.
fn stretched_view(eta: f64, low: f64, high: f64, v: f64, m: f64) -> Vec3<f64> {
    let (alpha_values, edge) = (AlphaPair::new(low, high), edge(eta));
    let at = |share: f64| alpha_values.azimuth((1.0 - share).sqrt(), share.sqrt());
    // Isotropic alphas have the same value at every azimuth.
    let share = match low < high {
        true => solve(v, |share| at(share).interface(edge)),
        false => 0.5,
    };
    let along = at(share).alpha;
    let cosine = solve(m, |cosine| interface_cosine_coordinate(cosine, along, edge));
    view(cosine, share)
}

fn stretched_rule() -> Rule {
    Rule::new(20, 12)
}

/// Coefficients of the anisotropic table, by masking.
pub(super) fn stretched<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
) -> [Vec<f64>; 2] {
    let [_, alphas, _, azimuths, cosines] = ANISOTROPIC_AXES.map(Axis::places);
    let etas = etas(ANISOTROPIC_AXES[0]);
    let rule = stretched_rule();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    let rows = parallel(ANISOTROPIC_ETAS * ANISOTROPIC_PAIRS, |row| {
        let (_, eta) = etas[row / ANISOTROPIC_PAIRS];
        let [low, high] = pairs[row % ANISOTROPIC_PAIRS].map(|i| alpha_at(alphas[i]));
        let ndf = ndf(Alpha { x: low, y: high });
        let mut values = Vec::with_capacity(azimuths.len() * cosines.len());
        for &v in &azimuths {
            for &m in &cosines {
                let wo = stretched_view(eta, low, high, v, m);
                values.push(rule.dielectric_albedo(&ndf, eta, wo).map(root));
            }
        }
        values
    });
    [0, 1].map(|masking| {
        let rows: Vec<f64> = rows.iter().flatten().map(|roots| roots[masking]).collect();
        let each = rows.len() / ANISOTROPIC_ETAS;
        let mut table: Vec<f64> = rows
            .chunks(each)
            .flat_map(|rows| unfold(rows, ANISOTROPIC_ALPHAS, ANISOTROPIC_AZIMUTHS))
            .collect();
        let half = table.len() / 2;
        for half in table.chunks_mut(half) {
            coefficients(&ANISOTROPIC_AXES, half);
        }
        table
    })
}

/// The texts of the anisotropic table and of its averages.
pub(super) fn with_stretched_averages(table: &[f64]) -> (Digits, Digits) {
    const BLOCK: usize = ANISOTROPIC_AZIMUTHS * ANISOTROPIC_COSINES;
    let mut digits = Digits::default();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    for table in table.chunks(table.len() / ANISOTROPIC_ETAS) {
        for &[i, j] in &pairs {
            let block = &table[(i * ANISOTROPIC_ALPHAS + j) * BLOCK..][..BLOCK];
            for row in block.chunks(ANISOTROPIC_COSINES) {
                digits.line(row, 2, LIMITS);
            }
        }
    }
    let rows = Rows::new(digits.text.as_bytes(), ANISOTROPIC_ROWS);
    let (etas, alphas) = (etas(ANISOTROPIC_AXES[0]), ANISOTROPIC_AXES[1].places());
    let quotients = parallel(ANISOTROPIC_ETAS * ANISOTROPIC_PAIRS, |row| {
        let (x, eta) = etas[row / ANISOTROPIC_PAIRS];
        let [low, high] = pairs[row % ANISOTROPIC_PAIRS].map(|i| alpha_at(alphas[i]));
        let start = dielectric_albedo::half(eta, ANISOTROPIC_ETAS);
        let knots = Quadratic::quadratic(x, ANISOTROPIC_ETAS / 2);
        let [first, second] = [low, high]
            .map(|width| Quadratic::quadratic(alpha_coordinate(width), ANISOTROPIC_ALPHAS));
        let (alpha_values, edge) = (AlphaPair::new(low, high), edge(eta));
        let loss = azimuthal_average(|[x, y]| {
            let azimuth = alpha_values.azimuth(x, y);
            let v = azimuth.interface(edge);
            average(|cosine| {
                let m = interface_cosine_coordinate(cosine, azimuth.alpha, edge);
                let stencils = [&knots, &first, &second];
                dielectric_albedo::anisotropic(rows, start, stencils, [v, m]).powi(2)
            })
        });
        loss.sqrt() / average_scale(low, high)
    });
    let mut text = Digits::default();
    for half in quotients.chunks(ANISOTROPIC_ETAS / 2 * ANISOTROPIC_PAIRS) {
        let mut averages: Vec<f64> = half
            .chunks(ANISOTROPIC_PAIRS)
            .flat_map(|rows| unfold(rows, ANISOTROPIC_ALPHAS, 1))
            .collect();
        coefficients(&ANISOTROPIC_AXES[..3], &mut averages);
        for table in averages.chunks(ANISOTROPIC_ALPHAS * ANISOTROPIC_ALPHAS) {
            text.line(&fold(table, ANISOTROPIC_ALPHAS), 4, AVERAGE_LIMITS);
        }
    }
    (digits, text)
}

/// Largest difference of the root of a loss between the crate's tables and every so manieth knot.
///
/// Coefficients at the limits are rounded down to them: only alphas up to 2 are compared.
pub(super) fn largest_difference<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
    step: usize,
) -> f64 {
    let [_, alphas, _, azimuths, cosines] = ANISOTROPIC_AXES.map(Axis::places);
    let etas = etas(ANISOTROPIC_AXES[0]);
    let rule = stretched_rule();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    let block = azimuths.len() * cosines.len();
    let differences = parallel(ANISOTROPIC_ETAS * ANISOTROPIC_PAIRS * block / step, |n| {
        let (row, knot) = (n * step / block, n * step % block);
        let (_, eta) = etas[row / ANISOTROPIC_PAIRS];
        let [low, high] = pairs[row % ANISOTROPIC_PAIRS].map(|i| alpha_at(alphas[i]));
        if low == high || high > 2.0 {
            return 0.0;
        }
        let (v, m) = (
            azimuths[knot / cosines.len()],
            cosines[knot % cosines.len()],
        );
        let wo = stretched_view(eta, low, high, v, m);
        let ndf = ndf(Alpha { x: low, y: high });
        let exact = rule.dielectric_albedo(&ndf, eta, wo);
        let loss = |masking| DielectricLoss::new(ndf, masking, eta).directional(wo);
        difference(exact, loss)
    });
    differences.into_iter().fold(0.0, f64::max)
}
