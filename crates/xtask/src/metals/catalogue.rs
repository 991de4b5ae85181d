//! Which metals there are, and which measurement of each; the reasons are in
//! `data/metals/README.md`.

/// A metal and its measurement.
pub(crate) struct Entry {
    /// Symbol, and name of the file in `data/metals`.
    pub(crate) symbol: &'static str,
    /// English name.
    pub(crate) name: &'static str,
    /// Page of refractiveindex.info, without `.yml`.
    pub(crate) page: &'static str,
    /// Authors, year, journal.
    pub(crate) source: &'static str,
    /// Whether pbrt-v4 has named spectra of it.
    pub(crate) in_pbrt: bool,
}

const NOBLE: &str = "Johnson and Christy 1972, Phys. Rev. B 6, 4370";
const TRANSITION: &str = "Johnson and Christy 1974, Phys. Rev. B 9, 5056";
const RAKIC_1998: &str = "Rakic et al. 1998, Appl. Opt. 37, 5271 (Brendel-Bormann model)";

/// The metals, sorted by symbol.
pub(crate) const CATALOGUE: &[Entry] = &[
    Entry {
        symbol: "Ag",
        name: "silver",
        page: "main/Ag/nk/Johnson",
        source: NOBLE,
        in_pbrt: true,
    },
    Entry {
        symbol: "Al",
        name: "aluminium",
        page: "main/Al/nk/Rakic",
        source: "Rakic 1995, Appl. Opt. 34, 4755",
        in_pbrt: true,
    },
    Entry {
        symbol: "Au",
        name: "gold",
        page: "main/Au/nk/Johnson",
        source: NOBLE,
        in_pbrt: true,
    },
    Entry {
        symbol: "Be",
        name: "beryllium",
        page: "main/Be/nk/Rakic-BB",
        source: RAKIC_1998,
        in_pbrt: false,
    },
    Entry {
        symbol: "Co",
        name: "cobalt",
        page: "main/Co/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "Cr",
        name: "chromium",
        page: "main/Cr/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "Cu",
        name: "copper",
        page: "main/Cu/nk/Johnson",
        source: NOBLE,
        in_pbrt: true,
    },
    Entry {
        symbol: "CuZn",
        name: "brass (70 % copper, 30 % zinc)",
        page: "other/alloys/Cu-Zn/nk/Querry-Cu70Zn30",
        source: "Querry 1985, Contractor Report CRDC-CR-85034",
        in_pbrt: true,
    },
    Entry {
        symbol: "Fe",
        name: "iron",
        page: "main/Fe/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "Hg",
        name: "mercury (liquid)",
        page: "main/Hg/nk/Inagaki",
        source: "Inagaki et al. 1981, Phys. Rev. B 23, 5246",
        in_pbrt: false,
    },
    Entry {
        symbol: "Ir",
        name: "iridium",
        page: "main/Ir/nk/Schmitt-MS",
        source: "Schmitt et al. 2022, Opt. Mater. Express 12, 545",
        in_pbrt: false,
    },
    Entry {
        symbol: "Mg",
        name: "magnesium",
        page: "main/Mg/nk/Palm",
        source: "Palm et al. 2018, ACS Photonics 5, 4677",
        in_pbrt: false,
    },
    Entry {
        symbol: "Mo",
        name: "molybdenum",
        page: "main/Mo/nk/Kirillova",
        source: "Kirillova et al. 1971, Sov. Phys. JETP 33, 1210",
        in_pbrt: false,
    },
    Entry {
        symbol: "Nb",
        name: "niobium",
        page: "main/Nb/nk/Weaver",
        source: "Weaver et al. 1973, Phys. Rev. B 7, 4311",
        in_pbrt: false,
    },
    Entry {
        symbol: "Ni",
        name: "nickel",
        page: "main/Ni/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "Pd",
        name: "palladium",
        page: "main/Pd/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "Pt",
        name: "platinum",
        page: "main/Pt/nk/Rakic-BB",
        source: RAKIC_1998,
        in_pbrt: false,
    },
    Entry {
        symbol: "Rh",
        name: "rhodium",
        page: "main/Rh/nk/Weaver",
        source: "Weaver et al. 1977, Phys. Rev. B 15, 4115",
        in_pbrt: false,
    },
    Entry {
        symbol: "Ti",
        name: "titanium",
        page: "main/Ti/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "V",
        name: "vanadium",
        page: "main/V/nk/Johnson",
        source: TRANSITION,
        in_pbrt: false,
    },
    Entry {
        symbol: "W",
        name: "tungsten",
        page: "main/W/nk/Weaver",
        source: "Weaver et al. 1975, Phys. Rev. B 12, 1293",
        in_pbrt: false,
    },
    Entry {
        symbol: "Zn",
        name: "zinc",
        page: "main/Zn/nk/Werner",
        source: "Werner et al. 2009, J. Phys. Chem. Ref. Data 38, 1013",
        in_pbrt: false,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn catalogue_is_sorted_by_symbol() {
        assert!(CATALOGUE.is_sorted_by(|a, b| a.symbol < b.symbol));
    }
}
