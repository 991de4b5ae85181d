//! Transparent media: index of refraction over wavelength from published formulas.

use super::Spectrum;

/// Wavelength of the helium d line in nm, at which a glass's one index is read.
pub const D_LINE_NM: f64 = 587.561_8;

/// Index of a glass by pbrt's name for it, without `glass-`.
///
/// ```text
/// n^2 = 1 + sum B_i um^2 / (um^2 - C_i)
/// ```
///
/// * Returns: index every 5 nm from 360 to 830 nm. The catalogue gives N-LASF9 from 365 nm, SF10
///   from 380 nm and SF11 from 390 nm on; below, the formula is continued.
///
/// Source: Schott optical glass catalogue of 2017-01-20 (refractiveindex.info, CC0, pages
/// `glass/schott/...`). pbrt's F5, F10 and F11 are the flints SF5, SF10 and SF11; BK7, BAF10 and
/// LASF9 are given by their present, lead-free successors, whose d indices agree to 3e-5.
pub(super) fn glass(name: &str) -> Option<Spectrum> {
    let terms = match name {
        // N-BK7
        "BK7" => [
            (1.039_612_12, 0.006_000_698_67),
            (0.231_792_344, 0.020_017_914_4),
            (1.010_469_45, 103.560_653),
        ],
        // N-BAF10
        "BAF10" => [
            (1.585_149_5, 0.009_266_812_82),
            (0.143_559_385, 0.042_448_980_5),
            (1.085_212_69, 105.613_573),
        ],
        // N-FK51A
        "FK51A" => [
            (0.971_247_817, 0.004_723_019_95),
            (0.216_901_417, 0.015_357_561_2),
            (0.904_651_666, 168.681_33),
        ],
        // N-LASF9
        "LASF9" => [
            (2.000_295_47, 0.012_142_601_7),
            (0.298_926_886, 0.053_873_623_6),
            (1.806_918_43, 156.530_829),
        ],
        "F5" | "SF5" => [
            (1.461_418_85, 0.011_182_612_6),
            (0.247_713_019, 0.050_859_466_9),
            (0.949_995_832, 112.041_888),
        ],
        "F10" | "SF10" => [
            (1.616_259_77, 0.012_753_455_9),
            (0.259_229_334, 0.058_198_395_4),
            (1.077_623_17, 116.607_68),
        ],
        "F11" | "SF11" => [
            (1.738_484_03, 0.013_606_860_4),
            (0.311_168_974, 0.061_596_046_3),
            (1.174_908_71, 121.922_711),
        ],
        _ => return None,
    };
    Some(visible(|um2| {
        1.0 + terms.iter().map(|(b, c)| b * um2 / (um2 - c)).sum::<f64>()
    }))
}

/// Index of magnesium oxide, which pbrt counts among its metals (k = 0 in the visible).
///
/// Source: Stephens and Malitson 1952, J. Res. Natl. Bur. Stand. 49, 249 (refractiveindex.info,
/// CC0, page `main/MgO/nk/Stephens`).
pub(super) fn magnesium_oxide() -> Spectrum {
    visible(|um2| {
        2.956_362 + 0.021_957_70 / (um2 - 0.014_283_22)
            - 0.010_623_87 * um2
            - 0.000_020_496_8 * um2 * um2
    })
}

/// Index of rutile, extraordinary ray: pbrt counts it among its metals and has that ray's
/// index. Its k is 0 from 430 nm on.
///
/// Source: Devore 1951, J. Opt. Soc. Am. 41, 416 (refractiveindex.info, CC0, page
/// `main/TiO2/nk/Devore-e`). Departure: continued below its first wavelength, 430 nm; the
/// handbooks' values at 400 and 388 nm are 0.004 lower.
pub(super) fn rutile() -> Spectrum {
    visible(|um2| 7.197 + 0.3322 / (um2 - 0.0843))
}

/// The square root of `n_squared(um^2)` every 5 nm from 360 to 830 nm.
fn visible(n_squared: impl Fn(f64) -> f64) -> Spectrum {
    Spectrum::sampled(360.0, 830.0, 5.0, |nm| n_squared(nm * nm * 1e-6).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The catalogue's own n_d beside each formula.
    #[test]
    fn d_indices_are_those_of_the_catalogue() {
        for (name, nd) in [
            ("BK7", 1.5168),
            ("BAF10", 1.67003),
            ("FK51A", 1.48656),
            ("LASF9", 1.85025),
            ("F5", 1.6727),
            ("F10", 1.72825),
            ("F11", 1.78472),
        ] {
            let n = glass(name).unwrap().value(D_LINE_NM);
            // Linear between samples 5 nm apart: at most 1e-5 of curvature at this wavelength.
            assert!((n - nd).abs() < 2e-5, "{name}: {n}");
        }
        assert_eq!(glass("SF5"), glass("F5"));
        assert_eq!(glass("BK8"), None);
    }

    #[test]
    fn oxides_have_their_published_indices() {
        // Stephens and Malitson 1952, table 2; Devore 1951, table 1.
        assert!((magnesium_oxide().value(589.3) - 1.7375).abs() < 2e-4);
        assert!((rutile().value(589.3) - 2.909).abs() < 2e-3);
    }
}
