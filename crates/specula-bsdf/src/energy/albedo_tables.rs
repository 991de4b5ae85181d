//! The tables of lost energy, decoded from text when the crate is compiled.
//!
//! `tables/*.txt` are made by `cargo xtask tables`: numbers in base 94, most significant digit
//! first, digits the characters from `!` to `~`; line ends mean nothing. In order: isotropic roots
//! (3 digits each, as shares of 94^3 - 1), their averages (4), anisotropic roots (2), their
//! averages (4), dielectric roots (2), their averages (4). Averages are shares of `AVERAGE_RANGE`.

use super::albedo::{
    ANISOTROPIC_AZIMUTHS, ANISOTROPIC_COSINES, ANISOTROPIC_PAIRS, AVERAGE_RANGE, AnisotropicTable,
    ISOTROPIC_ALPHAS, ISOTROPIC_COSINES,
};
use super::dielectric_albedo::{ALPHAS, COSINES, DielectricTable, ETAS};

/// Everything about one distribution and masking.
pub(super) struct Tables {
    /// `sqrt(1 - E)` by width and cosine.
    pub(super) isotropic: [[f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS],
    /// `sqrt(1 - E_avg)` over its scale, by width.
    pub(super) isotropic_average: [f32; ISOTROPIC_ALPHAS],
    /// `sqrt(1 - E)` by pair of widths, azimuth and cosine.
    pub(super) anisotropic: AnisotropicTable,
    /// `sqrt(1 - E_avg)` over its scale, by pair of widths.
    pub(super) anisotropic_average: [f32; ANISOTROPIC_PAIRS],
    /// `sqrt(1 - E)` of dielectrics by index, width and cosine.
    pub(super) dielectric: DielectricTable,
    /// `sqrt(1 - E_avg)` of dielectrics over its scale, by index and width.
    pub(super) dielectric_average: [[f32; ALPHAS]; ETAS],
}

/// By distribution and masking.
#[allow(long_running_const_eval, reason = "a quarter of a million digits")]
pub(super) static TABLES: [Tables; 4] = [
    decode(include_str!("tables/ggx_correlated.txt").as_bytes()),
    decode(include_str!("tables/ggx_separable.txt").as_bytes()),
    decode(include_str!("tables/beckmann_correlated.txt").as_bytes()),
    decode(include_str!("tables/beckmann_separable.txt").as_bytes()),
];

/// Largest number of `digits` digits.
const fn largest(digits: u32) -> f32 {
    #[allow(clippy::cast_precision_loss, reason = "below 2^24 up to three digits")]
    let value = (94_u32.pow(digits) - 1) as f32;
    value
}

/// The number of `digits` digits at `at`, and where the next one begins.
const fn number(text: &[u8], mut at: usize, digits: u32) -> (u32, usize) {
    let mut value = 0;
    let mut read = 0;
    while read < digits {
        let byte = text[at];
        at += 1;
        if byte > b' ' {
            value = value * 94 + (byte - b'!') as u32;
            read += 1;
        }
    }
    (value, at)
}

/// A row of fractions of `digits` digits, scaled.
const fn row<const N: usize>(
    text: &[u8],
    mut at: usize,
    digits: u32,
    scale: f32,
) -> ([f32; N], usize) {
    let mut values = [0.0; N];
    let mut i = 0;
    while i < N {
        let (value, next) = number(text, at, digits);
        #[allow(clippy::cast_precision_loss, reason = "rounding is meant")]
        let share = value as f32 / largest(digits);
        values[i] = share * scale;
        at = next;
        i += 1;
    }
    (values, at)
}

/// A row of numbers of two digits.
const fn short_row<const N: usize>(text: &[u8], mut at: usize) -> ([u16; N], usize) {
    let mut values = [0; N];
    let mut i = 0;
    while i < N {
        let (value, next) = number(text, at, 2);
        #[allow(clippy::cast_possible_truncation, reason = "below 94^2")]
        let value = value as u16;
        values[i] = value;
        at = next;
        i += 1;
    }
    (values, at)
}

const fn decode(text: &[u8]) -> Tables {
    let mut at = 0;
    let mut isotropic = [[0.0; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS];
    let mut i = 0;
    while i < ISOTROPIC_ALPHAS {
        (isotropic[i], at) = row(text, at, 3, 1.0);
        i += 1;
    }
    let (isotropic_average, next) = row(text, at, 4, AVERAGE_RANGE);
    at = next;
    let mut anisotropic = [[[0; ANISOTROPIC_COSINES]; ANISOTROPIC_AZIMUTHS]; ANISOTROPIC_PAIRS];
    i = 0;
    while i < ANISOTROPIC_PAIRS {
        let mut v = 0;
        while v < ANISOTROPIC_AZIMUTHS {
            (anisotropic[i][v], at) = short_row(text, at);
            v += 1;
        }
        i += 1;
    }
    let (anisotropic_average, next) = row(text, at, 4, AVERAGE_RANGE);
    at = next;
    let mut dielectric = [[[0; COSINES]; ALPHAS]; ETAS];
    i = 0;
    while i < ETAS {
        let mut j = 0;
        while j < ALPHAS {
            (dielectric[i][j], at) = short_row(text, at);
            j += 1;
        }
        i += 1;
    }
    let mut dielectric_average = [[0.0; ALPHAS]; ETAS];
    i = 0;
    while i < ETAS {
        (dielectric_average[i], at) = row(text, at, 4, AVERAGE_RANGE);
        i += 1;
    }
    Tables {
        isotropic,
        isotropic_average,
        anisotropic,
        anisotropic_average,
        dielectric,
        dielectric_average,
    }
}
