//! Directional albedo of single scattering off a rough surface whose facets reflect everything.
//!
//! ```text
//! E(wo) = int f(wo, wi) cos theta_i dwi,   F = 1        directional albedo
//! E_avg = 1/pi int E(wo) cos theta_o dwo                its cosine average
//! ```
//!
//! What is missing to 1 is light that meets another facet. Tables hold `sqrt(1 - E)`, which is
//! smooth where `1 - E` vanishes (narrow lobes, the horizon), and cannot turn negative:
//!
//! * isotropic: 64 widths x 48 cosines, bicubic;
//! * anisotropic: 24 x 25 / 2 pairs of widths x 8 azimuths x 18 cosines, cubic in all four.
//!
//! Coordinates, all in `[0, 1]`, with square roots only:
//!
//! ```text
//! widths    t(alpha) = (alpha^(1/4) - 0.1) / (10^(1/4) - 0.1)
//! azimuth   v = (sqrt(a) - sqrt(ax)) / (sqrt(ay) - sqrt(ax)),  a^2 = (ax^2 x^2 + ay^2 y^2) / (x^2 + y^2)
//! cosine    m = 1 - sqrt(1 - sqrt(mu (1 + a) / (mu + a)))
//! ```
//!
//! `a` is the width along the view: for narrow lobes everything happens at `mu ~ a`, for which `m`
//! has room at every width. Exchanging the axes (`ax <-> ay`, `x <-> y`, `v -> 1 - v`) changes
//! nothing, so that half the pairs of widths are stored.
//!
//! Made by `cargo xtask tables`; its tests compare with quadrature at random points:
//!
//! | largest (rms) error of E | GGX | Beckmann |
//! |---|---|---|
//! | isotropic, alpha in [1e-4, 2] | 3e-4 (7e-6) | 6e-5 (9e-6) |
//! | isotropic, alpha in [1e-4, 10] | 1.3e-3 (4e-5) | 1e-4 (7e-6) |
//! | anisotropic, alphas in [0.05, 1.5] | 4e-3 (1.9e-4) | 4e-3 (5.2e-4) |
//! | anisotropic, alphas in [1e-4, 10] | 5e-2 (1.5e-3) | 5e-2 (1.5e-3) |
//!
//! The large errors belong to ratios of the widths above 10 within 5 degrees of the narrow axis.
//! The isotropic table at `sqrt(ax ay)`, which others use, is wrong by 0.53 (rms 0.14) for GGX and
//! 0.50 (rms 0.11) for Beckmann over the same widths in [0.05, 1.5], drawn independently: the table
//! by azimuth is 700 and 200 times closer.

use super::albedo_tables::TABLES;
use super::stencil::Stencil;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::{Beckmann, Ggx, Masking, Ndf};

/// Widths of the isotropic tables.
pub const ISOTROPIC_ALPHAS: usize = 64;
/// Cosines of the isotropic tables.
pub const ISOTROPIC_COSINES: usize = 48;
/// Widths of the anisotropic tables.
pub const ANISOTROPIC_ALPHAS: usize = 24;
/// Azimuths of the anisotropic tables.
pub const ANISOTROPIC_AZIMUTHS: usize = 8;
/// Cosines of the anisotropic tables.
pub const ANISOTROPIC_COSINES: usize = 18;
/// Largest entry of the anisotropic tables: two digits to the base 94.
pub const ANISOTROPIC_SCALE: f32 = 8835.0;

/// A distribution that has tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// See [`Ggx`].
    Ggx,
    /// See [`Beckmann`].
    Beckmann,
}

/// A distribution of normals whose lost energy is tabulated.
pub trait Tabulated<T: Real>: Ndf<T> {
    /// Which tables are this distribution's.
    const DISTRIBUTION: Distribution;
}

impl<T: Real> Tabulated<T> for Ggx<T> {
    const DISTRIBUTION: Distribution = Distribution::Ggx;
}

impl<T: Real> Tabulated<T> for Beckmann<T> {
    const DISTRIBUTION: Distribution = Distribution::Beckmann;
}

/// Index of a distribution and masking among the tables.
#[inline(always)]
pub(super) fn table_index(distribution: Distribution, masking: Masking) -> usize {
    match (distribution, masking) {
        (Distribution::Ggx, Masking::HeightCorrelated) => 0,
        (Distribution::Ggx, Masking::Separable) => 1,
        (Distribution::Beckmann, Masking::HeightCorrelated) => 2,
        (Distribution::Beckmann, Masking::Separable) => 3,
    }
}

/// The energy that single scattering off one surface loses: the tables at its widths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss<T> {
    /// Widths in ascending order.
    low: T,
    high: T,
    /// Whether x is the wider axis.
    swapped: bool,
    table: u8,
    low_stencil: Stencil<T>,
    high_stencil: Stencil<T>,
    average: T,
}

impl<T: Real> Loss<T> {
    /// The loss of a distribution of normals.
    #[inline]
    pub fn new<N: Tabulated<T>>(ndf: N, masking: Masking) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "an index below 4")]
        let table = table_index(N::DISTRIBUTION, masking) as u8;
        let Alpha { x, y } = ndf.alpha();
        let (low, high) = (Real::min(x, y), Real::max(x, y));
        let count = if low == high {
            ISOTROPIC_ALPHAS
        } else {
            ANISOTROPIC_ALPHAS
        };
        let mut loss = Self {
            low,
            high,
            swapped: x > y,
            table,
            low_stencil: Stencil::new(alpha_coordinate(low), count),
            high_stencil: Stencil::new(alpha_coordinate(high), count),
            average: T::ZERO,
        };
        loss.average = loss.interpolated_average();
        loss
    }

    /// `1 - E(wo)`, in `[0, 1]`, of `wo` or its mirror image above the horizon.
    ///
    /// * `wo`: unit, local frame.
    #[inline]
    pub fn directional(&self, wo: Vec3<T>) -> T {
        let cosine = Real::min(wo.z.abs(), T::ONE);
        let root = if self.low == self.high {
            let table = &TABLES[usize::from(self.table)].isotropic;
            let at = Stencil::new(cosine_coordinate(cosine, self.low), ISOTROPIC_COSINES);
            isotropic(table, &self.low_stencil, &at)
        } else {
            let (along_low, along_high) = if self.swapped {
                (wo.y, wo.x)
            } else {
                (wo.x, wo.y)
            };
            let (width, v) = azimuth_coordinate(self.low, self.high, along_low, along_high);
            let m = cosine_coordinate(cosine, width);
            let table = &TABLES[usize::from(self.table)].anisotropic;
            anisotropic(
                table,
                [&self.low_stencil, &self.high_stencil],
                &Stencil::new(v, ANISOTROPIC_AZIMUTHS),
                &Stencil::new(m, ANISOTROPIC_COSINES),
            )
        };
        Real::min(root * root, T::ONE)
    }

    /// `1 - E_avg`, in `(0, 1]`.
    #[inline(always)]
    pub fn average(&self) -> T {
        self.average
    }

    fn interpolated_average(&self) -> T {
        let root = if self.low == self.high {
            let table = &TABLES[usize::from(self.table)].isotropic_average;
            self.low_stencil.sum(|i| T::of(f64::from(table[i])))
        } else {
            let table = &TABLES[usize::from(self.table)].anisotropic_average;
            self.low_stencil.sum(|i| {
                self.high_stencil
                    .sum(|j| T::of(f64::from(table[pair(i, j).0])))
            })
        };
        let scaled = root * average_scale(self.low, self.high);
        Real::clamp(scaled * scaled, T::of(1e-18), T::ONE)
    }
}

/// The coordinate of a width.
#[inline(always)]
pub fn alpha_coordinate<T: Real>(alpha: T) -> T {
    (alpha.sqrt().sqrt() - T::of(ALPHA_START)) * T::of(1.0 / (ALPHA_END - ALPHA_START))
}

/// The width of a coordinate.
pub fn alpha_at<T: Real>(t: T) -> T {
    (T::of(ALPHA_START) + t * T::of(ALPHA_END - ALPHA_START))
        .squared()
        .squared()
}

const ALPHA_START: f64 = 0.1;
/// `10^(1/4)`.
const ALPHA_END: f64 = 1.778_279_410_038_922_8;

/// The coordinate of a cosine at a width along the view.
#[inline(always)]
pub fn cosine_coordinate<T: Real>(cosine: T, width: T) -> T {
    let share = cosine * (T::ONE + width) / (cosine + width);
    T::ONE - (T::ONE - share.sqrt()).safe_sqrt()
}

/// The cosine of a coordinate at a width along the view.
pub fn cosine_at<T: Real>(m: T, width: T) -> T {
    let root = T::ONE - (T::ONE - m).squared();
    let share = root * root;
    Real::min(share * width / (T::ONE + width - share), T::ONE)
}

/// `(a, v)`: the width along the view and the coordinate of the azimuth.
#[inline(always)]
pub fn azimuth_coordinate<T: Real>(low: T, high: T, along_low: T, along_high: T) -> (T, T) {
    let (x2, y2) = (along_low * along_low, along_high * along_high);
    let length2 = x2 + y2;
    // Straight from above, every azimuth has the same value.
    let share = T::select(length2 > T::TINY, y2 / length2, T::HALF);
    let width = (low * low + (high * high - low * low) * share).sqrt();
    // (sqrt(a) - sqrt(l)) / (sqrt(h) - sqrt(l)), expanded so that equal widths are no 0/0.
    let (l, h, a) = (low.sqrt(), high.sqrt(), width.sqrt());
    let v = share * (high + low) * (h + l) / ((width + low) * (a + l));
    (width, v)
}

/// The share `y^2 / (x^2 + y^2)` and the width along the view of a coordinate of the azimuth.
pub fn azimuth_at(low: f64, high: f64, v: f64) -> (f64, f64) {
    let root = low.sqrt() + v * (high.sqrt() - low.sqrt());
    let width = root * root;
    if low == high {
        return (v, width);
    }
    let share = (width - low) * (width + low) / ((high - low) * (high + low));
    (share.clamp(0.0, 1.0), width)
}

/// What the tables of averages are scaled with: smooth, and the quotient varies slowly.
#[inline(always)]
pub fn average_scale<T: Real>(alpha_x: T, alpha_y: T) -> T {
    let width = ((alpha_x * alpha_x + alpha_y * alpha_y) * T::HALF).sqrt();
    width / (T::ONE + width)
}

/// Largest quotient of `sqrt(1 - E_avg)` and [`average_scale`] that the tables hold.
pub const AVERAGE_RANGE: f32 = 8.0;

/// Row of a pair of widths, the lower first; and whether the pair was exchanged.
#[inline(always)]
pub fn pair(i: usize, j: usize) -> (usize, bool) {
    if i <= j {
        (j * (j + 1) / 2 + i, false)
    } else {
        (i * (i + 1) / 2 + j, true)
    }
}

/// `sqrt(1 - E)` of an isotropic table.
#[inline(always)]
pub fn isotropic<T: Real>(
    table: &[[f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS],
    alpha: &Stencil<T>,
    cosine: &Stencil<T>,
) -> T {
    alpha.sum(|i| cosine.sum(|k| T::of(f64::from(table[i][k]))))
}

/// One distribution's anisotropic table, by pair of widths, azimuth and cosine.
pub type AnisotropicTable = [[[u16; ANISOTROPIC_COSINES]; ANISOTROPIC_AZIMUTHS]; ANISOTROPIC_PAIRS];

/// Pairs of widths of the anisotropic tables.
pub const ANISOTROPIC_PAIRS: usize = ANISOTROPIC_ALPHAS * (ANISOTROPIC_ALPHAS + 1) / 2;

/// `sqrt(1 - E)` of an anisotropic table.
#[inline(always)]
pub fn anisotropic<T: Real>(
    table: &AnisotropicTable,
    alphas: [&Stencil<T>; 2],
    azimuth: &Stencil<T>,
    cosine: &Stencil<T>,
) -> T {
    let sum = alphas[0].sum(|i| {
        alphas[1].sum(|j| {
            let (row, exchanged) = pair(i, j);
            let rows = &table[row];
            azimuth.sum(|v| {
                let v = if exchanged {
                    ANISOTROPIC_AZIMUTHS - 1 - v
                } else {
                    v
                };
                cosine.sum(|k| T::of(f64::from(rows[v][k])))
            })
        })
    });
    sum * T::of(f64::from(1.0 / ANISOTROPIC_SCALE))
}
