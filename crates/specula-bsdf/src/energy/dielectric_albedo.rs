//! Directional albedo of single scattering at a rough dielectric interface, both branches.
//!
//! ```text
//! E(wo) = int f(wo, wi) |cos theta_i| dwi           reflection and refraction, importance
//! ```
//!
//! As in `albedo`, tables hold `sqrt(1 - E)` as coefficients of splines:
//!
//! * isotropic: 2 x 10 indices x 20 alphas x 22 cosines, cubic;
//! * anisotropic: 2 x 6 indices x 12 x 13 / 2 pairs of alphas x 10 azimuths x 14 cosines, quadratic,
//!   so that five dimensions ask for 243 coefficients, as many as the four of `albedo`.
//!
//! The coordinate of an index is `sqrt(|eta - 1| / (eta + 1))`, of indices in `[1.041, 3]` and of
//! their inverses; beyond, the nearest is taken. The others are those of `coordinates`, where total
//! reflection has its edges. The losses are those of `bsdf::RoughDielectric`, whose refraction has
//! the masking of reflection.
//!
//! Errors of E, against quadrature at random points, indices in [1.1, 2.4] and their inverses (tests
//! of the generator):
//!
//! | largest (rms) | GGX | Beckmann |
//! |---|---|---|
//! | isotropic, alpha in [0.02, 2] | 7e-3 (5e-4) | 7e-3 (6e-4) |
//! | anisotropic, alphas in [0.05, 1.5] | 2e-2 (1.2e-3) | 2e-2 (2.6e-3) |
//! | anisotropic, alphas in [0.02, 2] | 3.1e-2 (1.8e-3) | 2e-2 (2.8e-3) |
//!
//! The isotropic table at the alpha along the view instead was wrong by 0.6 (rms 0.075).

use super::albedo::{Tabulated, table_index};
use super::albedo_tables::TABLES;
use super::coordinates::{
    AlphaPair, alpha_coordinate, average_scale, edge, interface_cosine_coordinate,
};
use super::pairs::{pair, row};
use super::rows::Rows;
use super::spline::{Cubic, Quadratic};
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::Masking;

/// Indices of the isotropic tables.
pub const ETAS: usize = 20;
/// Alphas of the isotropic tables.
pub const ALPHAS: usize = 20;
/// Cosines of the isotropic tables.
pub const COSINES: usize = 22;
/// Indices of the anisotropic tables.
pub const ANISOTROPIC_ETAS: usize = 12;
/// Alphas of the anisotropic tables.
pub const ANISOTROPIC_ALPHAS: usize = 12;
/// Azimuths of the anisotropic tables.
pub const ANISOTROPIC_AZIMUTHS: usize = 10;
/// Cosines of the anisotropic tables.
pub const ANISOTROPIC_COSINES: usize = 14;
/// Pairs of alphas of the anisotropic tables.
pub const ANISOTROPIC_PAIRS: usize = ANISOTROPIC_ALPHAS * (ANISOTROPIC_ALPHAS + 1) / 2;
/// Lines of the anisotropic tables.
pub const ANISOTROPIC_ROWS: usize = ANISOTROPIC_ETAS * ANISOTROPIC_PAIRS * ANISOTROPIC_AZIMUTHS;

/// The energy that single scattering loses on one side of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricLoss<T> {
    table: u8,
    /// First index of the half of the tables: losses differ too much across 1 to be interpolated.
    start: u8,
    edge: T,
    interpolation: Interpolation<T>,
    average: T,
}

/// Splines at the alphas and the index of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Interpolation<T> {
    Isotropic {
        alpha: T,
        eta: Cubic<T>,
        stencil: Cubic<T>,
    },
    Anisotropic {
        alpha_values: AlphaPair<T>,
        eta: Quadratic<T>,
        low: Quadratic<T>,
        high: Quadratic<T>,
    },
}

impl<T: Real> DielectricLoss<T> {
    /// The loss seen from the side where the index is 1, with `eta` beyond.
    #[inline]
    pub fn new<N: Tabulated<T>>(ndf: N, masking: Masking, eta: T) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "an index below 4")]
        let table = table_index(N::TABLES, masking) as u8;
        let tables = &TABLES[usize::from(table)];
        let Alpha { x, y } = ndf.alpha();
        let entry = |value: f32| T::of(f64::from(value));
        let (interpolation, start, root) = if x == y {
            let start = half(eta, ETAS);
            let eta = Cubic::cubic(eta_coordinate(eta), ETAS / 2);
            let stencil = Cubic::cubic(alpha_coordinate(x), ALPHAS);
            let averages = &tables.interface_average;
            let root = eta.sum(|e| stencil.sum(|i| entry(averages[start + e][i])));
            let alpha = x;
            (
                Interpolation::Isotropic {
                    alpha,
                    eta,
                    stencil,
                },
                start,
                root,
            )
        } else {
            let start = half(eta, ANISOTROPIC_ETAS);
            let eta = Quadratic::quadratic(eta_coordinate(eta), ANISOTROPIC_ETAS / 2);
            let alpha_values = AlphaPair::new(x, y);
            let (low, high) = alpha_values.ordered();
            let low = Quadratic::quadratic(alpha_coordinate(low), ANISOTROPIC_ALPHAS);
            let high = Quadratic::quadratic(alpha_coordinate(high), ANISOTROPIC_ALPHAS);
            let averages = &tables.anisotropic_interface_average;
            let root =
                eta.sum(|e| low.sum(|i| high.sum(|j| entry(averages[start + e][pair(i, j).0]))));
            let interpolation = Interpolation::Anisotropic {
                alpha_values,
                eta,
                low,
                high,
            };
            (interpolation, start, root)
        };
        let scaled = root * average_scale(x, y);
        #[allow(clippy::cast_possible_truncation, reason = "some dozen indices")]
        let start = start as u8;
        Self {
            table,
            start,
            edge: edge(eta.within(T::of(1.0 / 3.0), T::of(3.0))),
            interpolation,
            average: (scaled * scaled).within(T::of(1e-18), T::ONE),
        }
    }

    /// `1 - E(wo)` of `wo` or its mirror image above the horizon.
    ///
    /// * `wo`: unit, local frame.
    #[inline]
    pub fn directional(&self, wo: Vec3<T>) -> T {
        let cosine = wo.z.abs().at_most(T::ONE);
        let tables = &TABLES[usize::from(self.table)];
        let start = usize::from(self.start);
        let root = match &self.interpolation {
            Interpolation::Isotropic {
                alpha,
                eta,
                stencil,
            } => {
                let m = interface_cosine_coordinate(cosine, *alpha, self.edge);
                isotropic(tables.interface, start, [eta, stencil], m)
            }
            Interpolation::Anisotropic {
                alpha_values,
                eta,
                low,
                high,
            } => {
                let azimuth = alpha_values.azimuth(wo.x, wo.y);
                let m = interface_cosine_coordinate(cosine, azimuth.alpha, self.edge);
                let v = azimuth.interface(self.edge);
                anisotropic(
                    tables.anisotropic_interface,
                    start,
                    [eta, low, high],
                    [v, m],
                )
            }
        };
        (root * root).at_most(T::ONE)
    }

    /// `1 - E_avg`, in `(0, 1]`.
    #[inline(always)]
    pub fn average(&self) -> T {
        self.average
    }
}

/// First row of an index's half of `count` rows.
#[inline(always)]
pub fn half<T: Real>(eta: T, count: usize) -> usize {
    if eta < T::ONE { 0 } else { count / 2 }
}

/// The coordinate of an index in its half of the tables.
#[inline(always)]
pub fn eta_coordinate<T: Real>(eta: T) -> T {
    let root = ((eta - T::ONE) / (eta + T::ONE)).abs().sqrt();
    (root - T::of(ROOT_START)) * T::of(1.0 / (ROOT_END - ROOT_START))
}

/// The index above 1 of a coordinate.
pub fn eta_at(x: f64) -> f64 {
    let root = ROOT_START + x * (ROOT_END - ROOT_START);
    (1.0 + root * root) / (1.0 - root * root)
}

/// `sqrt(0.02)`: an index of 1.0408.
const ROOT_START: f64 = 0.141_421_356_237_309_5;
/// `sqrt(0.5)`: an index of 3.
const ROOT_END: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// `sqrt(1 - E)` of an isotropic table at the coordinate of a cosine, from the first row of the half
/// on.
#[inline(always)]
pub fn isotropic<T: Real>(
    table: Rows<COSINES>,
    start: usize,
    [eta, alpha]: [&Cubic<T>; 2],
    m: T,
) -> T {
    let cosine = Cubic::cubic(m, COSINES);
    Rows::<COSINES>::coefficient(
        eta.sum(|e| alpha.sum(|i| table.sum((start + e) * ALPHAS + i, &cosine))),
    )
}

/// `sqrt(1 - E)` of an anisotropic table at the coordinates of an azimuth and a cosine, from the
/// first row of the half on.
#[inline(always)]
pub fn anisotropic<T: Real>(
    table: Rows<ANISOTROPIC_COSINES>,
    start: usize,
    [eta, low, high]: [&Quadratic<T>; 3],
    [v, m]: [T; 2],
) -> T {
    const EACH: usize = ANISOTROPIC_PAIRS * ANISOTROPIC_AZIMUTHS;
    let azimuth = Quadratic::quadratic(v, ANISOTROPIC_AZIMUTHS);
    let cosine = Quadratic::quadratic(m, ANISOTROPIC_COSINES);
    Rows::<ANISOTROPIC_COSINES>::coefficient(eta.sum(|e| {
        low.sum(|i| {
            high.sum(|j| {
                azimuth.sum(|v| {
                    let row = row(i, j, v, ANISOTROPIC_AZIMUTHS);
                    table.sum((start + e) * EACH + row, &cosine)
                })
            })
        })
    }))
}
