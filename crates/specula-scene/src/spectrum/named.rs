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
/// Departure: the data are the public ones named in `data/metals/README.md` and in the sources of
/// this module, not pbrt's own tables (Palik's handbook for most metals). `CuZn` is the same
/// measurement; `MgO` and `TiO2` have no absorption here.
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
        // Johnson and Christy 1972, table 1, at 2.13 eV (582.1 nm).
        for (name, value) in [
            ("metal-Au-eta", 0.29),
            ("metal-Au-k", 2.863),
            ("metal-Ag-eta", 0.05),
            ("metal-Cu-eta", 0.70),
        ] {
            let found = named(name).unwrap().value(582.1);
            assert!((found - value).abs() < 1e-9, "{name}: {found}");
        }
    }
}
