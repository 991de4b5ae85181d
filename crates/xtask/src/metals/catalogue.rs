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
    /// What pbrt-v4's named spectra of it are.
    pub(crate) pbrt: InPbrt,
}

/// Which measurement stands for pbrt-v4's named spectra of a metal.
pub(crate) enum InPbrt {
    /// It names none.
    Unknown,
    /// The entry's own.
    Same,
    /// One that reflects more nearly what pbrt's table does.
    Nearer(Nearer),
}

/// A measurement that stands for pbrt-v4's.
pub(crate) struct Nearer {
    /// Name of the file in `data/metals`.
    pub(crate) file: &'static str,
    /// Page of refractiveindex.info, without `.yml`.
    pub(crate) page: &'static str,
    /// Authors, year, journal.
    pub(crate) source: &'static str,
}

/// A file of `data/metals` and where it is from.
pub(crate) struct DataFile {
    /// Its name, without `.csv`.
    pub(crate) file: &'static str,
    /// The metal's symbol and English name.
    pub(crate) metal: (&'static str, &'static str),
    /// Page of refractiveindex.info, without `.yml`.
    pub(crate) page: &'static str,
    /// Authors, year, journal.
    pub(crate) source: &'static str,
}

/// Every file of `data/metals`.
pub(crate) fn files() -> impl Iterator<Item = DataFile> {
    CATALOGUE.iter().flat_map(|entry| {
        let metal = (entry.symbol, entry.name);
        let own = DataFile {
            file: entry.symbol,
            metal,
            page: entry.page,
            source: entry.source,
        };
        let nearer = match &entry.pbrt {
            InPbrt::Unknown | InPbrt::Same => None,
            InPbrt::Nearer(Nearer { file, page, source }) => Some(DataFile {
                file,
                metal,
                page,
                source,
            }),
        };
        [Some(own), nearer].into_iter().flatten()
    })
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
        pbrt: InPbrt::Nearer(Nearer {
            file: "Ag-Rakic-LD",
            page: "main/Ag/nk/Rakic-LD",
            source: "Rakic et al. 1998, Appl. Opt. 37, 5271 (Lorentz-Drude model)",
        }),
    },
    Entry {
        symbol: "Al",
        name: "aluminium",
        page: "main/Al/nk/Rakic",
        source: "Rakic 1995, Appl. Opt. 34, 4755",
        pbrt: InPbrt::Same,
    },
    Entry {
        symbol: "Au",
        name: "gold",
        page: "main/Au/nk/Johnson",
        source: NOBLE,
        pbrt: InPbrt::Nearer(Nearer {
            file: "Au-McPeak",
            page: "main/Au/nk/McPeak",
            source: "McPeak et al. 2015, ACS Photonics 2, 326",
        }),
    },
    Entry {
        symbol: "Be",
        name: "beryllium",
        page: "main/Be/nk/Rakic-BB",
        source: RAKIC_1998,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Co",
        name: "cobalt",
        page: "main/Co/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Cr",
        name: "chromium",
        page: "main/Cr/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Cu",
        name: "copper",
        page: "main/Cu/nk/Johnson",
        source: NOBLE,
        pbrt: InPbrt::Nearer(Nearer {
            file: "Cu-Hagemann",
            page: "main/Cu/nk/Hagemann",
            source: "Hagemann et al. 1975, J. Opt. Soc. Am. 65, 742",
        }),
    },
    Entry {
        symbol: "CuZn",
        name: "brass (70 % copper, 30 % zinc)",
        page: "other/alloys/Cu-Zn/nk/Querry-Cu70Zn30",
        source: "Querry 1985, Contractor Report CRDC-CR-85034",
        pbrt: InPbrt::Same,
    },
    Entry {
        symbol: "Fe",
        name: "iron",
        page: "main/Fe/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Hg",
        name: "mercury (liquid)",
        page: "main/Hg/nk/Inagaki",
        source: "Inagaki et al. 1981, Phys. Rev. B 23, 5246",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Ir",
        name: "iridium",
        page: "main/Ir/nk/Schmitt-MS",
        source: "Schmitt et al. 2022, Opt. Mater. Express 12, 545",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Mg",
        name: "magnesium",
        page: "main/Mg/nk/Palm",
        source: "Palm et al. 2018, ACS Photonics 5, 4677",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Mo",
        name: "molybdenum",
        page: "main/Mo/nk/Kirillova",
        source: "Kirillova et al. 1971, Sov. Phys. JETP 33, 1210",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Nb",
        name: "niobium",
        page: "main/Nb/nk/Weaver",
        source: "Weaver et al. 1973, Phys. Rev. B 7, 4311",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Ni",
        name: "nickel",
        page: "main/Ni/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Pd",
        name: "palladium",
        page: "main/Pd/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Pt",
        name: "platinum",
        page: "main/Pt/nk/Rakic-BB",
        source: RAKIC_1998,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Rh",
        name: "rhodium",
        page: "main/Rh/nk/Weaver",
        source: "Weaver et al. 1977, Phys. Rev. B 15, 4115",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Ti",
        name: "titanium",
        page: "main/Ti/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "V",
        name: "vanadium",
        page: "main/V/nk/Johnson",
        source: TRANSITION,
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "W",
        name: "tungsten",
        page: "main/W/nk/Weaver",
        source: "Weaver et al. 1975, Phys. Rev. B 12, 1293",
        pbrt: InPbrt::Unknown,
    },
    Entry {
        symbol: "Zn",
        name: "zinc",
        page: "main/Zn/nk/Werner",
        source: "Werner et al. 2009, J. Phys. Chem. Ref. Data 38, 1013",
        pbrt: InPbrt::Unknown,
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_folder_has_one_origin() {
        let mut named: Vec<String> = files().map(|f| format!("{}.csv", f.file)).collect();
        let folder = crate::workspace::root().join("data/metals");
        let mut found: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".csv"))
            .collect();
        named.sort();
        found.sort();
        assert_eq!(named, found);
    }

    #[test]
    fn catalogue_is_sorted_by_symbol() {
        assert!(CATALOGUE.is_sorted_by(|a, b| a.symbol < b.symbol));
    }
}
