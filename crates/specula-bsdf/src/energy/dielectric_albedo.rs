//! Directional albedo of single scattering at a rough dielectric interface, both branches.
//!
//! ```text
//! E(wo) = int f(wo, wi) |cos theta_i| dwi           reflection and refraction, importance
//! ```
//!
//! As in `albedo`, tables hold `sqrt(1 - E)`: 2 x 12 indices x 24 widths x 18 cosines, tricubic,
//! with the coordinate `sqrt(|eta - 1| / (eta + 1))` of indices in `[1.041, 3]` and of their
//! inverses; beyond, the nearest is taken. The losses are those of `bsdf::RoughDielectric`, whose refraction has the
//! masking of reflection.
//!
//! Anisotropic widths are taken as the width along the view,
//!
//! ```text
//! a^2 = (ax^2 x^2 + ay^2 y^2) / (x^2 + y^2)
//! ```
//!
//! a table by azimuth would have five dimensions. It is the width that decides how much refracted
//! light is masked, and half as wrong as `sqrt(ax ay)`. The average is taken over azimuths, so that
//! the second lobe of `bsdf::CompensatedDielectric` adds what `L` says.
//!
//! Errors of E, against quadrature at random points, alphas in [0.02, 1.5], indices in [1.05, 2.45]
//! and their inverses (tests of the generator):
//!
//! | largest (rms) | GGX | Beckmann |
//! |---|---|---|
//! | isotropic | 1.2e-2 (1.0e-3) | 1.5e-2 (1.5e-3) |
//! | anisotropic, widths drawn independently | 0.6 (0.075) | |

use super::albedo::{Tabulated, alpha_coordinate, average_scale, cosine_coordinate, table_index};
use super::albedo_tables::TABLES;
use super::stencil::Stencil;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::Masking;

/// Indices of the tables.
pub const ETAS: usize = 24;
/// Widths of the tables.
pub const ALPHAS: usize = 24;
/// Cosines of the tables.
pub const COSINES: usize = 18;
/// One distribution's table, by index, width and cosine.
pub type DielectricTable = [[[u16; COSINES]; ALPHAS]; ETAS];

/// The energy that single scattering loses on one side of an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DielectricLoss<T> {
    table: u8,
    alpha: Alpha<T>,
    eta: EtaKnots<T>,
    average: T,
}

impl<T: Real> DielectricLoss<T> {
    /// The loss seen from the side where the index is 1, with `eta` beyond.
    #[inline]
    pub fn new<N: Tabulated<T>>(ndf: N, masking: Masking, eta: T) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "an index below 4")]
        let table = table_index(N::DISTRIBUTION, masking) as u8;
        let alpha = ndf.alpha();
        let loss = Self {
            table,
            alpha,
            eta: EtaKnots::new(eta),
            average: T::ZERO,
        };
        let average = if alpha.x == alpha.y {
            loss.isotropic_average(alpha.x)
        } else {
            AZIMUTHS.iter().fold(T::ZERO, |sum, &[share, weight]| {
                let width = loss.width(T::of(1.0 - share), T::of(share));
                sum + T::of(weight) * loss.isotropic_average(width)
            })
        };
        Self { average, ..loss }
    }

    /// `1 - E(wo)` of `wo` or its mirror image above the horizon.
    ///
    /// * `wo`: unit, local frame.
    #[inline]
    pub fn directional(&self, wo: Vec3<T>) -> T {
        let (x2, y2) = (wo.x * wo.x, wo.y * wo.y);
        let length2 = x2 + y2;
        let share = T::select(length2 > T::TINY, y2 / length2, T::HALF);
        let width = self.width(T::ONE - share, share);
        let cosine = Real::min(wo.z.abs(), T::ONE);
        let at = Stencil::new(cosine_coordinate(cosine, width), COSINES);
        let alpha = Stencil::new(alpha_coordinate(width), ALPHAS);
        let table = &TABLES[usize::from(self.table)].dielectric;
        let root = interpolate(table, &self.eta, &alpha, &at);
        Real::min(root * root, T::ONE)
    }

    /// `1 - E_avg`, in `(0, 1]`.
    #[inline(always)]
    pub fn average(&self) -> T {
        self.average
    }

    /// The width along directions with these shares of their squared sine.
    #[inline(always)]
    fn width(&self, share_x: T, share_y: T) -> T {
        let Alpha { x, y } = self.alpha;
        (x * x * share_x + y * y * share_y).sqrt()
    }

    #[inline]
    fn isotropic_average(&self, width: T) -> T {
        let averages = &TABLES[usize::from(self.table)].dielectric_average;
        let alpha = Stencil::new(alpha_coordinate(width), ALPHAS);
        let root = self
            .eta
            .sum(|i| alpha.sum(|j| T::of(f64::from(averages[i][j]))));
        let scaled = root * average_scale(width, width);
        Real::clamp(scaled * scaled, T::of(1e-18), T::ONE)
    }
}

/// `sin^2 phi` and weights of a mean over the azimuth: Gauss and Legendre's rule in `w`, with
/// `phi = pi/4 (1 - cos(pi w))`: closer together along both axes.
const AZIMUTHS: [[f64; 2]; 12] = [
    [0.000_000_108_523_166, 0.001_073_025_434_802],
    [0.000_079_051_007_411, 0.012_602_145_332_097],
    [0.002_572_803_967_016, 0.044_458_683_765_501],
    [0.025_168_688_244_109, 0.096_344_183_713_627],
    [0.121_756_113_139_335, 0.153_616_268_169_167],
    [0.348_894_153_098_073, 0.191_905_693_584_806],
    [0.651_105_846_901_927, 0.191_905_693_584_806],
    [0.878_243_886_860_665, 0.153_616_268_169_167],
    [0.974_831_311_755_891, 0.096_344_183_713_627],
    [0.997_427_196_032_984, 0.044_458_683_765_501],
    [0.999_920_948_992_589, 0.012_602_145_332_097],
    [0.999_999_891_476_834, 0.001_073_025_434_802],
];

/// Where an index lies in its half of the tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EtaKnots<T> {
    /// First index of the half: losses differ too much across 1 to be interpolated there.
    start: u8,
    stencil: Stencil<T>,
}

impl<T: Real> EtaKnots<T> {
    /// The knots about `eta`, the nearest where outside of the tables.
    #[inline(always)]
    pub fn new(eta: T) -> Self {
        let s = (eta - T::ONE) / (eta + T::ONE);
        let root = s.abs().sqrt();
        let x = (root - T::of(ROOT_START)) * T::of(1.0 / (ROOT_END - ROOT_START));
        Self {
            start: if s < T::ZERO { 0 } else { HALF_ETAS_U8 },
            stencil: Stencil::new(x, HALF_ETAS),
        }
    }

    #[inline(always)]
    fn sum(&self, value: impl Fn(usize) -> T) -> T {
        let start = usize::from(self.start);
        self.stencil.sum(|i| value(start + i))
    }
}

const HALF_ETAS: usize = ETAS / 2;
const HALF_ETAS_U8: u8 = 12;
/// `sqrt(0.02)`: an index of 1.0408.
const ROOT_START: f64 = 0.141_421_356_237_309_5;
/// `sqrt(0.5)`: an index of 3.
const ROOT_END: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// The relative index of a row of the tables.
pub fn eta_at(row: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "two dozen rows")]
    let share = (row % HALF_ETAS) as f64 / (HALF_ETAS - 1) as f64;
    let root = ROOT_START + share * (ROOT_END - ROOT_START);
    let s = root * root;
    let eta = (1.0 + s) / (1.0 - s);
    if row < HALF_ETAS { 1.0 / eta } else { eta }
}

/// `sqrt(1 - E)` of a table.
#[inline(always)]
pub fn interpolate<T: Real>(
    table: &DielectricTable,
    eta: &EtaKnots<T>,
    alpha: &Stencil<T>,
    cosine: &Stencil<T>,
) -> T {
    let sum = eta.sum(|i| alpha.sum(|j| cosine.sum(|k| T::of(f64::from(table[i][j][k])))));
    sum * T::of(f64::from(1.0 / super::albedo::ANISOTROPIC_SCALE))
}
