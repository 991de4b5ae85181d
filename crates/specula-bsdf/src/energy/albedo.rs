//! Directional albedo of single scattering off a rough surface whose facets reflect everything.
//!
//! ```text
//! E(wo) = int f(wo, wi) cos theta_i dwi,   F = 1        directional albedo
//! E_avg = 1/pi int E(wo) cos theta_o dwo                its cosine average
//! ```
//!
//! What is missing to 1 is light that meets another facet. Tables hold `sqrt(1 - E)`, which is
//! smooth where `1 - E` vanishes (narrow lobes, the horizon), and cannot turn negative, as
//! coefficients of cubic splines (`spline`) along the coordinates of `coordinates`:
//!
//! * isotropic: 48 alphas x 40 cosines;
//! * anisotropic: 24 x 25 / 2 pairs of alphas x 12 azimuths x 22 cosines.
//!
//! Made by `cargo xtask tables`; its tests compare with quadrature at random points, a third of them
//! with the alphas at both ends of the range and a third near the narrow axis:
//!
//! | largest (rms) error of E | GGX | Beckmann |
//! |---|---|---|
//! | isotropic, alpha in [1e-4, 2] | 9e-5 (3e-6) | 7e-6 (2e-6) |
//! | isotropic, alpha in [1e-4, 10] | 3e-4 (8e-6) | 6e-5 (3e-6) |
//! | anisotropic, alphas in [0.02, 2] | 4e-4 (6e-5) | 5e-4 (6e-5) |
//! | anisotropic, alphas in [1e-3, 2] | 7e-4 (6e-5) | 2e-3 (9e-5) |
//! | anisotropic, alphas in [1e-4, 10] | 1.2e-2 (3e-4) | 1.1e-2 (4e-4) |
//! | isotropic table at `sqrt(ax ay)`, alphas in [0.02, 2] | 0.68 (0.23) | 0.64 (0.19) |
//!
//! The last row is what others use: the table by azimuth is 4000 and 3000 times closer.

use super::albedo_tables::TABLES;
use super::coordinates::{AlphaPair, alpha_coordinate, average_scale, cosine_coordinate};
use super::pairs::{pair, row};
use super::rows::Rows;
use super::spline::Cubic;
use crate::alpha::Alpha;
use crate::math::{Real, Vec3};
use crate::ndf::{Beckmann, Ggx, Masking};
use crate::vndf::VisibleNormals;

/// Alphas of the isotropic tables.
pub const ISOTROPIC_ALPHAS: usize = 48;
/// Cosines of the isotropic tables.
pub const ISOTROPIC_COSINES: usize = 40;
/// Alphas of the anisotropic tables.
pub const ANISOTROPIC_ALPHAS: usize = 24;
/// Azimuths of the anisotropic tables.
pub const ANISOTROPIC_AZIMUTHS: usize = 12;
/// Cosines of the anisotropic tables.
pub const ANISOTROPIC_COSINES: usize = 22;
/// Pairs of alphas of the anisotropic tables.
pub const ANISOTROPIC_PAIRS: usize = ANISOTROPIC_ALPHAS * (ANISOTROPIC_ALPHAS + 1) / 2;
/// Lines of the anisotropic tables.
pub const ANISOTROPIC_ROWS: usize = ANISOTROPIC_PAIRS * ANISOTROPIC_AZIMUTHS;

/// Which tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TabulatedNdf {
    /// See [`Ggx`].
    Ggx,
    /// See [`Beckmann`].
    Beckmann,
}

mod sealed {
    pub trait Sealed {}
    impl<T> Sealed for crate::ndf::Ggx<T> {}
    impl<T> Sealed for crate::ndf::Beckmann<T> {}
}

/// A distribution of normals whose lost energy is tabulated: [`Ggx`] and [`Beckmann`]. Sealed: the
/// tables are of this crate.
pub trait Tabulated<T: Real>: VisibleNormals<T> + sealed::Sealed {
    /// Which tables are this distribution's.
    #[doc(hidden)]
    const TABLES: TabulatedNdf;
}

impl<T: Real> Tabulated<T> for Ggx<T> {
    const TABLES: TabulatedNdf = TabulatedNdf::Ggx;
}

impl<T: Real> Tabulated<T> for Beckmann<T> {
    const TABLES: TabulatedNdf = TabulatedNdf::Beckmann;
}

/// Index of a distribution and masking among the tables.
#[inline(always)]
pub(super) fn table_index(distribution: TabulatedNdf, masking: Masking) -> usize {
    match (distribution, masking) {
        (TabulatedNdf::Ggx, Masking::HeightCorrelated) => 0,
        (TabulatedNdf::Ggx, Masking::Separable) => 1,
        (TabulatedNdf::Beckmann, Masking::HeightCorrelated) => 2,
        (TabulatedNdf::Beckmann, Masking::Separable) => 3,
    }
}

/// The energy that single scattering off one surface loses: the tables at its alphas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss<T> {
    directional: DirectionalLoss<T>,
    average: T,
}

/// The same without its average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DirectionalLoss<T> {
    table: u8,
    interpolation: Interpolation<T>,
}

/// Splines at the alphas of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Interpolation<T> {
    Isotropic {
        alpha: T,
        stencil: Cubic<T>,
    },
    Anisotropic {
        alpha_values: AlphaPair<T>,
        low: Cubic<T>,
        high: Cubic<T>,
    },
}

impl<T: Real> Loss<T> {
    /// The loss of a distribution of normals.
    #[inline]
    pub fn new<N: Tabulated<T>>(ndf: N, masking: Masking) -> Self {
        let directional = DirectionalLoss::new(ndf, masking);
        let tables = &TABLES[usize::from(directional.table)];
        let root = match &directional.interpolation {
            Interpolation::Isotropic { stencil, .. } => {
                stencil.sum(|i| T::of(f64::from(tables.isotropic_average[i])))
            }
            Interpolation::Anisotropic { low, high, .. } => {
                let averages = &tables.anisotropic_average;
                low.sum(|i| high.sum(|j| T::of(f64::from(averages[pair(i, j).0]))))
            }
        };
        let Alpha { x, y } = ndf.alpha();
        let scaled = root * average_scale(x, y);
        Self {
            directional,
            average: (scaled * scaled).within(T::of(1e-18), T::ONE),
        }
    }

    /// `1 - E(wo)`, in `[0, 1]`, of `wo` or its mirror image above the horizon.
    ///
    /// * `wo`: unit, local frame.
    #[inline]
    pub fn directional(&self, wo: Vec3<T>) -> T {
        self.directional.at(wo)
    }

    /// `1 - E_avg`, in `(0, 1]`.
    #[inline(always)]
    pub fn average(&self) -> T {
        self.average
    }
}

impl<T: Real> DirectionalLoss<T> {
    /// That of a distribution of normals.
    #[inline]
    pub(crate) fn new<N: Tabulated<T>>(ndf: N, masking: Masking) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "an index below 4")]
        let table = table_index(N::TABLES, masking) as u8;
        let Alpha { x, y } = ndf.alpha();
        let stencil = |alpha, count| Cubic::cubic(alpha_coordinate(alpha), count);
        let interpolation = if x == y {
            let stencil = stencil(x, ISOTROPIC_ALPHAS);
            Interpolation::Isotropic { alpha: x, stencil }
        } else {
            let alpha_values = AlphaPair::new(x, y);
            let (low, high) = alpha_values.ordered();
            Interpolation::Anisotropic {
                alpha_values,
                low: stencil(low, ANISOTROPIC_ALPHAS),
                high: stencil(high, ANISOTROPIC_ALPHAS),
            }
        };
        Self {
            table,
            interpolation,
        }
    }

    /// Where a cosine lies in the table of an isotropic surface: what a batch computes in vectors.
    #[inline(always)]
    pub(crate) fn place(alpha: T, cosine: T) -> (T, [T; 4]) {
        Cubic::cubic_numbers(cosine_coordinate(cosine, alpha), ISOTROPIC_COSINES)
    }

    /// [`at`](Self::at), by the cosine's [`place`](Self::place); `None` for an anisotropic surface.
    #[inline(always)]
    pub(crate) fn at_place(&self, place: &Cubic<T>) -> Option<T> {
        let Interpolation::Isotropic { stencil, .. } = &self.interpolation else {
            return None;
        };
        let root = isotropic_at(&TABLES[usize::from(self.table)].isotropic, stencil, place);
        Some((root * root).at_most(T::ONE))
    }

    /// As [`Loss::directional`].
    #[inline]
    pub(crate) fn at(&self, wo: Vec3<T>) -> T {
        let cosine = wo.z.abs().at_most(T::ONE);
        let tables = &TABLES[usize::from(self.table)];
        let root = match &self.interpolation {
            Interpolation::Isotropic { alpha, stencil } => {
                let m = cosine_coordinate(cosine, *alpha);
                isotropic(&tables.isotropic, stencil, m)
            }
            Interpolation::Anisotropic {
                alpha_values,
                low,
                high,
            } => {
                let azimuth = alpha_values.azimuth(wo.x, wo.y);
                let m = cosine_coordinate(cosine, azimuth.alpha);
                anisotropic(tables.anisotropic, [low, high], azimuth.v, m)
            }
        };
        (root * root).at_most(T::ONE)
    }
}

/// `sqrt(1 - E)` of an isotropic table at the coordinate of a cosine.
#[inline(always)]
pub fn isotropic<T: Real>(
    table: &[[f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS],
    alpha: &Cubic<T>,
    m: T,
) -> T {
    isotropic_at(table, alpha, &Cubic::cubic(m, ISOTROPIC_COSINES))
}

#[inline(always)]
fn isotropic_at<T: Real>(
    table: &[[f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS],
    alpha: &Cubic<T>,
    cosine: &Cubic<T>,
) -> T {
    alpha.sum_of(table, |row| {
        cosine.sum_of(row, |&value| T::of(f64::from(value)))
    })
}

/// `sqrt(1 - E)` of an anisotropic table at the coordinates of an azimuth and a cosine.
#[inline(always)]
pub fn anisotropic<T: Real>(
    table: Rows<ANISOTROPIC_COSINES>,
    [low, high]: [&Cubic<T>; 2],
    v: T,
    m: T,
) -> T {
    let azimuth = Cubic::cubic(v, ANISOTROPIC_AZIMUTHS);
    let cosine = Cubic::cubic(m, ANISOTROPIC_COSINES);
    Rows::<ANISOTROPIC_COSINES>::coefficient(low.sum(|i| {
        high.sum(|j| azimuth.sum(|v| table.sum(row(i, j, v, ANISOTROPIC_AZIMUTHS), &cosine)))
    }))
}
