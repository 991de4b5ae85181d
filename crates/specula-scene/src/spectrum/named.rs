//! The spectra that pbrt-v4 knows by name.

use super::illuminants::{illuminant_a, illuminant_d50, illuminant_d60, illuminant_d65};
use super::measured::MEASURED;
use super::{Spectrum, dispersion, fluorescent::fluorescent};

/// Every name that [`named`] knows.
pub const NAMES: &[&str] = &[
    "glass-BAF10",
    "glass-BK7",
    "glass-F10",
    "glass-F11",
    "glass-F5",
    "glass-FK51A",
    "glass-LASF9",
    "glass-SF10",
    "glass-SF11",
    "glass-SF5",
    "illum-acesD60",
    "metal-Ag-eta",
    "metal-Ag-k",
    "metal-Al-eta",
    "metal-Al-k",
    "metal-Au-eta",
    "metal-Au-k",
    "metal-Cu-eta",
    "metal-Cu-k",
    "metal-CuZn-eta",
    "metal-CuZn-k",
    "metal-MgO-eta",
    "metal-MgO-k",
    "metal-TiO2-eta",
    "metal-TiO2-k",
    "stdillum-A",
    "stdillum-D50",
    "stdillum-D65",
    "stdillum-F1",
    "stdillum-F10",
    "stdillum-F11",
    "stdillum-F12",
    "stdillum-F2",
    "stdillum-F3",
    "stdillum-F4",
    "stdillum-F5",
    "stdillum-F6",
    "stdillum-F7",
    "stdillum-F8",
    "stdillum-F9",
];

/// The spectrum that pbrt-v4 calls `name`.
///
/// * `name`: one of [`NAMES`]: `metal-Au-eta`, `glass-BK7`, `stdillum-D65` and so on.
/// * Returns: `None` for anything else. The sensitivities of cameras that pbrt also names are
///   unknown here.
///
/// Departure: the data are public ones, not pbrt's own tables (Palik's handbook for most metals):
/// those that reflect most nearly the same, by [`crate::spectrum::conductor_index_to_rgb`]. They are
/// named in `data/metals/README.md` and `dispersion.rs`; the metals that a user asks for by symbol
/// (`specula_bsdf::metals`) are other measurements. Difference of the hemispherical reflectance from
/// that of pbrt's table under D65, relative, in red, green and blue:
///
/// | metal | difference | |
/// |---|---|---|
/// | Ag | -0.7 %, -0.8 %, 0.0 % | |
/// | Al | -0.7 %, -0.7 %, -0.3 % | |
/// | Au | -1.3 %, +0.3 %, -0.4 % | red beyond sRGB (1.013) is 1 |
/// | Cu | -0.3 %, +0.2 %, -0.3 % | |
/// | CuZn | none | the same measurement |
/// | MgO, TiO2 | less than 0.1 % | without absorption |
#[must_use]
pub fn named(name: &str) -> Option<Spectrum> {
    if let Some(glass) = name.strip_prefix("glass-") {
        return dispersion::glass(glass);
    }
    if let Some(metal) = name.strip_prefix("metal-") {
        let (symbol, part) = metal.rsplit_once('-')?;
        return match part {
            "eta" => metal_eta(symbol),
            "k" => metal_k(symbol),
            _ => None,
        };
    }
    match name {
        "stdillum-A" => Some(illuminant_a()),
        "stdillum-D50" => Some(illuminant_d50()),
        "stdillum-D65" => Some(illuminant_d65()),
        "illum-acesD60" => Some(illuminant_d60()),
        _ => (1..=12)
            .find(|n| name == format!("stdillum-F{n}"))
            .and_then(fluorescent),
    }
}

fn metal_eta(symbol: &str) -> Option<Spectrum> {
    match symbol {
        "MgO" => Some(dispersion::magnesium_oxide()),
        "TiO2" => Some(dispersion::rutile()),
        _ => measured(symbol, |[_, eta, _]| eta),
    }
}

fn metal_k(symbol: &str) -> Option<Spectrum> {
    match symbol {
        "MgO" | "TiO2" => Some(Spectrum::constant(0.0)),
        _ => measured(symbol, |[_, _, k]| k),
    }
}

fn measured(symbol: &str, part: impl Fn([f64; 3]) -> f64) -> Option<Spectrum> {
    let (_, rows) = MEASURED.iter().find(|(s, _)| *s == symbol)?;
    Some(Spectrum::from_ordered(
        rows.iter().map(|&row| (row[0], part(row))).collect(),
    ))
}

#[cfg(test)]
mod tests {
    use specula_bsdf::fresnel::Conductor;

    use super::super::conductor_index_to_rgb;
    use super::*;

    #[test]
    fn every_name_is_a_sound_spectrum_and_nothing_else_is() {
        assert!(NAMES.is_sorted());
        for name in NAMES {
            let s = named(name).unwrap_or_else(|| panic!("{name} is missing"));
            assert!(Spectrum::new(s.samples().to_vec()).is_ok(), "{name}");
            assert!(s.samples().iter().all(|&(_, v)| v >= 0.0), "{name}");
        }
        for name in [
            "",
            "metal-Au",
            "metal-Au-n",
            "metal-Xx-k",
            "glass-bk7",
            "stdillum-F0",
            "stdillum-F01",
            "stdillum-F13",
            "stdillum-D66",
        ] {
            assert_eq!(named(name), None, "{name}");
        }
    }

    #[test]
    fn metals_have_the_published_indices() {
        // McPeak et al. 2015.
        for (name, value) in [
            ("metal-Au-eta", 0.228_936_734),
            ("metal-Au-k", 2.999_518_633),
        ] {
            let found = named(name).unwrap().value(580.0);
            assert!((found - value).abs() < 1e-9, "{name}: {found}");
        }
    }

    /// Reflectance at normal incidence of pbrt-v4's own tables under D65; the test's numbers are
    /// sums over pbrt's observer and illuminant. Gold's red is cut from 1.022 to 1.
    #[test]
    fn metals_reflect_what_pbrt_shows() {
        for (metal, theirs) in [
            ("Ag", [0.9715, 0.9599, 0.9153]),
            ("Al", [0.9132, 0.9215, 0.9245]),
            ("Au", [1.0, 0.7825, 0.3434]),
            ("Cu", [0.9553, 0.6376, 0.5382]),
            ("CuZn", [0.9097, 0.7783, 0.4228]),
            ("MgO", [0.0720, 0.0731, 0.0749]),
            ("TiO2", [0.2322, 0.2446, 0.2727]),
        ] {
            let spectrum = |part: &str| named(&format!("metal-{metal}-{part}")).unwrap();
            let (eta, k) = conductor_index_to_rgb(&spectrum("eta"), &spectrum("k"));
            let specula = Conductor { eta, k }.eval(1.0).to_array();
            for (o, t) in specula.iter().zip(theirs) {
                assert!(
                    (o / t - 1.0).abs() < 0.01,
                    "{metal}: {specula:?}, pbrt {theirs:?}"
                );
            }
        }
    }
}
