//! Tables of facets that reflect everything.

use specula_bsdf::Alpha;
use specula_bsdf::energy::Loss;
use specula_bsdf::internal::albedo::{
    self, ANISOTROPIC_ALPHAS, ANISOTROPIC_AZIMUTHS, ANISOTROPIC_COSINES, ANISOTROPIC_PAIRS,
    ANISOTROPIC_ROWS, ISOTROPIC_ALPHAS, ISOTROPIC_COSINES, Tabulated,
};
use specula_bsdf::internal::coordinates::{
    AlphaPair, alpha_at, alpha_coordinate, average_scale, cosine_coordinate,
};
use specula_bsdf::internal::rows::{AVERAGE_HIGH, AVERAGE_LOW, HIGH, LOW, Rows};
use specula_bsdf::internal::spline::Cubic;
use specula_bsdf::math::Vec3;

use super::digits::Digits;
use super::rule::{Rule, view};
use super::spline::{Axis, coefficients};
use super::{average, azimuthal_average, difference, parallel, root, solve};

const LIMITS: [f64; 2] = [LOW, HIGH];
pub(super) const AVERAGE_LIMITS: [f64; 2] = [AVERAGE_LOW, AVERAGE_HIGH];

/// Coefficients of the isotropic table, by masking.
pub(super) fn isotropic<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
) -> [Vec<f64>; 2] {
    let axes = [
        Axis::Cubic(ISOTROPIC_ALPHAS),
        Axis::Cubic(ISOTROPIC_COSINES),
    ];
    let rule = Rule::new(64, 32);
    let (alphas, cosines) = (axes[0].places(), axes[1].places());
    let rows = parallel(alphas.len(), |i| {
        let width = alpha_at(alphas[i]);
        let ndf = ndf(Alpha { x: width, y: width });
        cosines
            .iter()
            .map(|&m| {
                let cosine = solve(m, |cosine| cosine_coordinate(cosine, width));
                rule.albedo(&ndf, view(cosine, 0.0)).map(root)
            })
            .collect::<Vec<_>>()
    });
    [0, 1].map(|masking| {
        let mut table: Vec<f64> = rows.iter().flatten().map(|roots| roots[masking]).collect();
        coefficients(&axes, &mut table);
        table
    })
}

/// The text of the isotropic table and its averages.
pub(super) fn isotropic_with_averages(table: &[f64]) -> Digits {
    let mut digits = Digits::default();
    let mut single = [[0.0_f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS];
    for (row, own) in table.chunks(ISOTROPIC_COSINES).zip(&mut single) {
        digits.line(row, 3, LIMITS);
        for (&value, own) in row.iter().zip(own) {
            #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
            let value = value as f32;
            *own = value;
        }
    }
    let axis = Axis::Cubic(ISOTROPIC_ALPHAS);
    let mut averages: Vec<f64> = axis
        .places()
        .iter()
        .map(|&t| {
            let (stencil, width) = (Cubic::cubic(t, ISOTROPIC_ALPHAS), alpha_at(t));
            let loss = average(|cosine| {
                albedo::isotropic(&single, &stencil, cosine_coordinate(cosine, width)).powi(2)
            });
            loss.sqrt() / average_scale(width, width)
        })
        .collect();
    coefficients(&[axis], &mut averages);
    digits.line(&averages, 4, AVERAGE_LIMITS);
    digits
}

const ANISOTROPIC_AXES: [Axis; 4] = [
    Axis::Cubic(ANISOTROPIC_ALPHAS),
    Axis::Cubic(ANISOTROPIC_ALPHAS),
    Axis::Cubic(ANISOTROPIC_AZIMUTHS),
    Axis::Cubic(ANISOTROPIC_COSINES),
];

/// The pairs of `count` indices, the lower first, in the order of their rows.
pub(super) fn pairs(count: usize) -> Vec<[usize; 2]> {
    (0..count)
        .flat_map(|j| (0..=j).map(move |i| [i, j]))
        .collect()
}

/// The view at coordinates of the anisotropic table.
fn anisotropic_view(low: f64, high: f64, v: f64, m: f64) -> Vec3<f64> {
    let along = low.powf(1.0 - v) * high.powf(v);
    // Isotropic alphas have the same value at every azimuth.
    let share = match low < high {
        true => (along - low) * (along + low) / ((high - low) * (high + low)),
        false => 0.5,
    };
    let cosine = solve(m, |cosine| cosine_coordinate(cosine, along));
    view(cosine, share.clamp(0.0, 1.0))
}

/// Coefficients of the anisotropic table, by masking.
pub(super) fn anisotropic<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
) -> [Vec<f64>; 2] {
    let [alphas, _, azimuths, cosines] = ANISOTROPIC_AXES.map(Axis::places);
    let rule = anisotropic_rule();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    let rows = parallel(pairs.len(), |p| {
        let [low, high] = pairs[p].map(|i| alpha_at(alphas[i]));
        let ndf = ndf(Alpha { x: low, y: high });
        let mut values = Vec::with_capacity(azimuths.len() * cosines.len());
        for &v in &azimuths {
            for &m in &cosines {
                let wo = anisotropic_view(low, high, v, m);
                values.push(rule.albedo(&ndf, wo).map(root));
            }
        }
        values
    });
    [0, 1].map(|masking| {
        let rows: Vec<f64> = rows.iter().flatten().map(|roots| roots[masking]).collect();
        let mut table = unfold(&rows, ANISOTROPIC_ALPHAS, ANISOTROPIC_AZIMUTHS);
        coefficients(&ANISOTROPIC_AXES, &mut table);
        table
    })
}

fn anisotropic_rule() -> Rule {
    Rule::new(32, 20)
}

/// Largest difference of the root of a loss between the crate's tables and every so manieth knot.
///
/// Coefficients at the limits are rounded down to them: only alphas up to 2 are compared.
pub(super) fn largest_difference<N: Tabulated<f64>>(
    ndf: &(impl Fn(Alpha<f64>) -> N + Sync),
    step: usize,
) -> f64 {
    let [alphas, _, azimuths, cosines] = ANISOTROPIC_AXES.map(Axis::places);
    let rule = anisotropic_rule();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    let count = pairs.len() * azimuths.len() * cosines.len();
    let differences = parallel(count / step, |n| {
        let knot = n * step;
        let [low, high] =
            pairs[knot / (azimuths.len() * cosines.len())].map(|i| alpha_at(alphas[i]));
        let (v, m) = (knot / cosines.len() % azimuths.len(), knot % cosines.len());
        if high > 2.0 {
            return 0.0;
        }
        let wo = anisotropic_view(low, high, azimuths[v], cosines[m]);
        let ndf = ndf(Alpha { x: low, y: high });
        let exact = rule.albedo(&ndf, wo);
        difference(exact, |masking| Loss::new(ndf, masking).directional(wo))
    });
    differences.into_iter().fold(0.0, f64::max)
}

/// A table by both alphas of one by pairs.
pub(super) fn unfold(rows: &[f64], alphas: usize, azimuths: usize) -> Vec<f64> {
    let line = rows.len() / (alphas * (alphas + 1) / 2 * azimuths);
    let mut table = Vec::with_capacity(alphas * alphas * azimuths * line);
    for i in 0..alphas {
        for j in 0..alphas {
            for v in 0..azimuths {
                let row = specula_bsdf::internal::pairs::row(i, j, v, azimuths);
                table.extend_from_slice(&rows[row * line..][..line]);
            }
        }
    }
    table
}

/// The texts of the anisotropic table and of its averages.
pub(super) fn with_averages(table: &[f64]) -> (Digits, Digits) {
    let mut digits = Digits::default();
    let pairs = pairs(ANISOTROPIC_ALPHAS);
    for &[i, j] in &pairs {
        let block = ANISOTROPIC_AZIMUTHS * ANISOTROPIC_COSINES;
        let block = &table[(i * ANISOTROPIC_ALPHAS + j) * block..][..block];
        for row in block.chunks(ANISOTROPIC_COSINES) {
            digits.line(row, 2, LIMITS);
        }
    }
    let rows = Rows::new(digits.text.as_bytes(), ANISOTROPIC_ROWS);
    let axis = ANISOTROPIC_AXES[0];
    let places = axis.places();
    let quotients = parallel(ANISOTROPIC_PAIRS, |p| {
        let [low, high] = pairs[p].map(|i| alpha_at(places[i]));
        let stencils =
            [low, high].map(|width| Cubic::cubic(alpha_coordinate(width), ANISOTROPIC_ALPHAS));
        let alpha_values = AlphaPair::new(low, high);
        let loss = azimuthal_average(|[x, y]| {
            let azimuth = alpha_values.azimuth(x, y);
            average(|cosine| {
                let m = cosine_coordinate(cosine, azimuth.alpha);
                albedo::anisotropic(rows, [&stencils[0], &stencils[1]], azimuth.v, m).powi(2)
            })
        });
        loss.sqrt() / average_scale(low, high)
    });
    let mut averages = unfold(&quotients, ANISOTROPIC_ALPHAS, 1);
    coefficients(&[axis, axis], &mut averages);
    let averages = fold(&averages, ANISOTROPIC_ALPHAS);
    let mut text = Digits::default();
    text.line(&averages, 4, AVERAGE_LIMITS);
    (digits, text)
}

/// The values by pairs of a table by both alphas.
pub(super) fn fold(table: &[f64], alphas: usize) -> Vec<f64> {
    pairs(alphas)
        .iter()
        .map(|&[i, j]| table[i * alphas + j])
        .collect()
}
