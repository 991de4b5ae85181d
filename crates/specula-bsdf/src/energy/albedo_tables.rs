//! The tables of lost energy.
//!
//! `tables/*.txt` are made by `cargo xtask tables`: values in base 94, most significant digit
//! first, digits the characters from `!` to `~`. An integer says how far a spline's coefficient
//! (`spline`) lies between two limits.
//!
//! Large tables have two digits and are read as text (`rows`). Small ones are decoded when the crate
//! is compiled; line ends mean nothing there. In order: isotropic roots (3 digits each), their
//! averages, those of the anisotropic table, of the interface and of the anisotropic interface (4).

use super::albedo::{
    ANISOTROPIC_COSINES, ANISOTROPIC_PAIRS, ANISOTROPIC_ROWS, ISOTROPIC_ALPHAS, ISOTROPIC_COSINES,
};
use super::dielectric_albedo as interface;
use super::rows::{AVERAGE_HIGH, AVERAGE_LOW, HIGH, LOW, Rows};

/// Everything about one distribution and masking.
pub(super) struct Tables {
    /// `sqrt(1 - E)` by alpha and cosine.
    pub(super) isotropic: [[f32; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS],
    /// `sqrt(1 - E_avg)` over its scale, by alpha.
    pub(super) isotropic_average: [f32; ISOTROPIC_ALPHAS],
    /// `sqrt(1 - E)` by pair of alphas, azimuth and cosine.
    pub(super) anisotropic: Rows<'static, ANISOTROPIC_COSINES>,
    /// `sqrt(1 - E_avg)` over its scale, by pair of alphas.
    pub(super) anisotropic_average: [f32; ANISOTROPIC_PAIRS],
    /// `sqrt(1 - E)` of interfaces by index, alpha and cosine.
    pub(super) interface: Rows<'static, { interface::COSINES }>,
    /// `sqrt(1 - E_avg)` of interfaces over its scale, by index and alpha.
    pub(super) interface_average: [[f32; interface::ALPHAS]; interface::ETAS],
    /// `sqrt(1 - E)` of anisotropic interfaces by index, pair of alphas, azimuth and cosine.
    pub(super) anisotropic_interface: Rows<'static, { interface::ANISOTROPIC_COSINES }>,
    /// `sqrt(1 - E_avg)` of anisotropic interfaces over its scale, by index and pair of alphas.
    pub(super) anisotropic_interface_average:
        [[f32; interface::ANISOTROPIC_PAIRS]; interface::ANISOTROPIC_ETAS],
}

/// By distribution and masking.
#[allow(long_running_const_eval, reason = "some ten thousand digits")]
pub(super) static TABLES: [Tables; 4] = [
    decode(
        include_bytes!("tables/ggx_correlated.txt"),
        include_bytes!("tables/ggx_correlated_anisotropic.txt"),
        include_bytes!("tables/ggx_correlated_interface.txt"),
        include_bytes!("tables/ggx_correlated_interface_anisotropic.txt"),
    ),
    decode(
        include_bytes!("tables/ggx_separable.txt"),
        include_bytes!("tables/ggx_separable_anisotropic.txt"),
        include_bytes!("tables/ggx_separable_interface.txt"),
        include_bytes!("tables/ggx_separable_interface_anisotropic.txt"),
    ),
    decode(
        include_bytes!("tables/beckmann_correlated.txt"),
        include_bytes!("tables/beckmann_correlated_anisotropic.txt"),
        include_bytes!("tables/beckmann_correlated_interface.txt"),
        include_bytes!("tables/beckmann_correlated_interface_anisotropic.txt"),
    ),
    decode(
        include_bytes!("tables/beckmann_separable.txt"),
        include_bytes!("tables/beckmann_separable_anisotropic.txt"),
        include_bytes!("tables/beckmann_separable_interface.txt"),
        include_bytes!("tables/beckmann_separable_interface_anisotropic.txt"),
    ),
];

const fn decode(
    small: &'static [u8],
    anisotropic: &'static [u8],
    isotropic_interface: &'static [u8],
    anisotropic_interface: &'static [u8],
) -> Tables {
    let mut digits = Digits { text: small, at: 0 };
    let mut isotropic = [[0.0; ISOTROPIC_COSINES]; ISOTROPIC_ALPHAS];
    let mut i = 0;
    while i < ISOTROPIC_ALPHAS {
        isotropic[i] = digits.row(3, LOW, HIGH);
        i += 1;
    }
    let isotropic_average = digits.row(4, AVERAGE_LOW, AVERAGE_HIGH);
    let anisotropic_average = digits.row(4, AVERAGE_LOW, AVERAGE_HIGH);
    let mut interface_average = [[0.0; interface::ALPHAS]; interface::ETAS];
    i = 0;
    while i < interface::ETAS {
        interface_average[i] = digits.row(4, AVERAGE_LOW, AVERAGE_HIGH);
        i += 1;
    }
    let mut anisotropic_interface_average =
        [[0.0; interface::ANISOTROPIC_PAIRS]; interface::ANISOTROPIC_ETAS];
    i = 0;
    while i < interface::ANISOTROPIC_ETAS {
        anisotropic_interface_average[i] = digits.row(4, AVERAGE_LOW, AVERAGE_HIGH);
        i += 1;
    }
    Tables {
        isotropic,
        isotropic_average,
        anisotropic: Rows::new(anisotropic, ANISOTROPIC_ROWS),
        anisotropic_average,
        interface: Rows::new(isotropic_interface, interface::ETAS * interface::ALPHAS),
        interface_average,
        anisotropic_interface: Rows::new(anisotropic_interface, interface::ANISOTROPIC_ROWS),
        anisotropic_interface_average,
    }
}

/// A text of digits, and how much of it has been read.
struct Digits {
    text: &'static [u8],
    at: usize,
}

impl Digits {
    /// The next integer of so many digits.
    const fn integer(&mut self, digits: u32) -> u32 {
        let mut value = 0;
        let mut read = 0;
        while read < digits {
            let byte = self.text[self.at];
            self.at += 1;
            if byte > b' ' {
                value = value * 94 + (byte - b'!') as u32;
                read += 1;
            }
        }
        value
    }

    /// The next coefficients between two limits.
    const fn row<const N: usize>(&mut self, digits: u32, low: f64, high: f64) -> [f32; N] {
        let step = (high - low) / (94_u32.pow(digits) - 1) as f64;
        let mut values = [0.0; N];
        let mut i = 0;
        while i < N {
            let value = low + step * self.integer(digits) as f64;
            #[allow(clippy::cast_possible_truncation, reason = "rounding is meant")]
            let value = value as f32;
            values[i] = value;
            i += 1;
        }
        values
    }
}
