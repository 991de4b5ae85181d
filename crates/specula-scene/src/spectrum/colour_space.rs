//! Other RGB spaces than sRGB, and white balance.

use glam::{DMat3, DVec2, DVec3};
use specula_bsdf::Rgb;

use super::blackbody::xyz_of_blackbody;
use super::colour::{rgb_from_xyz, to_f32, xyz_from_rgb};

/// An RGB space, as scene files name them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum ColourSpace {
    /// IEC 61966-2-1.
    #[default]
    Srgb,
    /// Another space.
    Other(Primaries),
}

/// Chromaticities of the primaries and the white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Primaries {
    pub(crate) red: [f64; 2],
    pub(crate) green: [f64; 2],
    pub(crate) blue: [f64; 2],
    pub(crate) white: [f64; 2],
}

/// The D65 of the standards.
const D65: [f64; 2] = [0.3127, 0.3290];

/// SMPTE EG 432-1, with the white of displays.
const DISPLAY_P3: Primaries = Primaries {
    red: [0.680, 0.320],
    green: [0.265, 0.690],
    blue: [0.150, 0.060],
    white: D65,
};

/// Rec. ITU-R BT.2020.
const REC_2020: Primaries = Primaries {
    red: [0.708, 0.292],
    green: [0.170, 0.797],
    blue: [0.131, 0.046],
    white: D65,
};

/// SMPTE ST 2065-1 (ACES).
const ACES_2065_1: Primaries = Primaries {
    red: [0.7347, 0.2653],
    green: [0.0, 1.0],
    blue: [0.0001, -0.0770],
    white: [0.32168, 0.33767],
};

/// IEC 61966-2-1 and Rec. ITU-R BT.709.
const REC_709: Primaries = Primaries {
    red: [0.64, 0.33],
    green: [0.30, 0.60],
    blue: [0.15, 0.06],
    white: D65,
};

/// Names that [`ColourSpace::named`] knows, as pbrt-v4 spells them.
pub(crate) const COLOUR_SPACES: [&str; 4] = ["srgb", "dci-p3", "rec2020", "aces2065-1"];

impl ColourSpace {
    /// One of [`COLOUR_SPACES`], in letters of any case.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name.to_ascii_lowercase().as_str() {
            "srgb" => Self::Srgb,
            "dci-p3" => Self::Other(DISPLAY_P3),
            "rec2020" => Self::Other(REC_2020),
            "aces2065-1" => Self::Other(ACES_2065_1),
            _ => return None,
        })
    }

    /// The space of these primaries; `None` where they span none.
    pub(crate) fn of(primaries: Primaries) -> Option<Self> {
        let near = |a: [f64; 2], b: [f64; 2]| DVec2::from(a).distance(b.into()) < 1e-3;
        let srgb = near(primaries.red, REC_709.red)
            && near(primaries.green, REC_709.green)
            && near(primaries.blue, REC_709.blue)
            && near(primaries.white, REC_709.white);
        if srgb {
            return Some(Self::Srgb);
        }
        let sound = primaries.white[1] > 0.0
            && primaries.chromaticities().determinant().abs() > 1e-6
            && primaries.xyz_from_rgb().is_finite();
        sound.then_some(Self::Other(primaries))
    }

    /// Linear sRGB of light: white stays the space's white.
    pub(crate) fn light(&self, c: Rgb<f32>) -> Rgb<f32> {
        match self {
            Self::Srgb => c,
            Self::Other(p) => apply(rgb_from_xyz() * p.xyz_from_rgb(), c),
        }
    }

    /// Linear sRGB of a reflectance: white stays white, by Bradford's adaptation.
    pub(crate) fn surface(&self, c: Rgb<f32>) -> Rgb<f32> {
        match self {
            Self::Srgb => c,
            Self::Other(p) => {
                let white = xyz_of_chromaticity(p.white);
                let adapted = adaptation(white, xyz_from_rgb() * DVec3::ONE);
                apply(rgb_from_xyz() * adapted * p.xyz_from_rgb(), c)
            }
        }
    }
}

impl Primaries {
    /// Columns: the primaries as (x, y, 1 - x - y).
    fn chromaticities(&self) -> DMat3 {
        let column = |[x, y]: [f64; 2]| DVec3::new(x, y, 1.0 - x - y);
        DMat3::from_cols(column(self.red), column(self.green), column(self.blue))
    }

    fn xyz_from_rgb(&self) -> DMat3 {
        let primaries = self.chromaticities();
        let scale = primaries.inverse() * xyz_of_chromaticity(self.white);
        primaries * DMat3::from_diagonal(scale)
    }
}

fn apply(m: DMat3, c: Rgb<f32>) -> Rgb<f32> {
    let v = m * DVec3::from(c.to_array().map(f64::from));
    to_f32(v.to_array())
}

fn xyz_of_chromaticity([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

/// Bradford's adaptation from one white to another (Lam 1985; ICC.1:2022, annex E).
fn adaptation(from: DVec3, to: DVec3) -> DMat3 {
    let lms = DMat3::from_cols(
        DVec3::new(0.8951, -0.7502, 0.0389),
        DVec3::new(0.2664, 1.7135, -0.0685),
        DVec3::new(-0.1614, 0.0367, 1.0296),
    );
    lms.inverse() * DMat3::from_diagonal((lms * to) / (lms * from)) * lms
}

/// The matrix that changes nothing.
const IDENTITY: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// White balance: the light of a colour temperature becomes white.
///
/// * `kelvin`: above 0. Daylight from 4000 K up, a black body below (pbrt-v4's rule); 6500 is D65.
/// * Returns: rows of a matrix on linear sRGB.
///
/// Source: CIE 015:2018, equations 4.6 and 4.7 (daylight). Departure: none.
pub(crate) fn white_balance(kelvin: f64) -> [[f32; 3]; 3] {
    if kelvin == 6500.0 {
        return IDENTITY;
    }
    // c2 was revised after the daylight series was named.
    let t = kelvin * 1.4388 / 1.4380;
    let source = if t < 4000.0 {
        let xyz = DVec3::from(xyz_of_blackbody(t));
        xyz / xyz.y
    } else {
        let x = if t <= 7000.0 {
            -4.6070e9 / t.powi(3) + 2.9678e6 / t.powi(2) + 99.11 / t + 0.244_063
        } else {
            -2.0064e9 / t.powi(3) + 1.9018e6 / t.powi(2) + 247.48 / t + 0.237_040
        };
        xyz_of_chromaticity([x, -3.0 * x * x + 2.870 * x - 0.275])
    };
    let m = rgb_from_xyz() * adaptation(source, xyz_from_rgb() * DVec3::ONE) * xyz_from_rgb();
    let rows = m.transpose();
    [rows.x_axis, rows.y_axis, rows.z_axis].map(|r| to_f32(r.to_array()).to_array())
}

#[cfg(test)]
mod tests {
    use super::super::blackbody_to_rgb;
    use super::*;

    fn near(found: Rgb<f32>, expected: [f32; 3]) {
        for (f, e) in found.to_array().into_iter().zip(expected) {
            assert!((f - e).abs() < 2e-3, "{found:?} != {expected:?}");
        }
    }

    #[test]
    fn white_and_primaries_are_the_published_ones() {
        for name in COLOUR_SPACES {
            let space = ColourSpace::named(name).unwrap();
            near(space.surface(Rgb::WHITE), [1.0; 3]);
        }
        // Rec. ITU-R BT.2087-0, annex 1: BT.2020 to BT.709.
        let green = Rgb {
            r: 0.0,
            g: 1.0,
            b: 0.0,
        };
        let rec2020 = ColourSpace::named("Rec2020").unwrap();
        near(rec2020.light(green), [-0.5876, 1.1329, -0.1006]);
        near(rec2020.light(Rgb::WHITE), [1.0; 3]);
        // The white of ACES is warmer than D65.
        let aces = ColourSpace::named("aces2065-1").unwrap().light(Rgb::WHITE);
        assert!(aces.r > aces.g && aces.g > aces.b, "{aces:?}");
    }

    #[test]
    fn unknown_and_degenerate_spaces_are_none() {
        assert_eq!(ColourSpace::named("adobe"), None);
        let flat = Primaries {
            green: REC_709.red,
            ..REC_709
        };
        assert_eq!(ColourSpace::of(flat), None);
        assert_eq!(ColourSpace::of(REC_709), Some(ColourSpace::Srgb));
    }

    #[test]
    fn balanced_light_is_white() {
        for kelvin in [2000.0, 3200.0] {
            let lamp = blackbody_to_rgb(kelvin);
            let m = white_balance(f64::from(kelvin) * 1.4380 / 1.4388);
            let row = |r: [f32; 3]| r[0] * lamp.r + r[1] * lamp.g + r[2] * lamp.b;
            near(
                Rgb {
                    r: row(m[0]),
                    g: row(m[1]),
                    b: row(m[2]),
                },
                [1.0; 3],
            );
        }
        let m = white_balance(6500.0 + 1e-7);
        for (i, row) in m.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                let unit = if i == j { 1.0 } else { 0.0 };
                assert!((x - unit).abs() < 2e-3, "{m:?}");
            }
        }
        // Daylight of 5000 K is warm: balancing takes red and adds blue.
        let d50 = white_balance(5000.0);
        assert!(d50[0][0] < 1.0 && d50[2][2] > 1.0, "{d50:?}");
    }
}
