//! Programs of tests, and which of them is likely to see a fault of a file.

/// Where they are.
pub(super) const PACKAGES: [&str; 2] = ["specula-bsdf", "specula-stat"];

/// Stands for the unit tests of both.
pub(super) const UNIT_TESTS: &str = "unit tests";

/// All that are run, the quick ones first.
const ALL: [&str; 26] = [
    "known_values",
    "tints",
    "extremes",
    "values_of_mitsuba",
    "lobes",
    "visible_normals",
    "awkward_directions",
    "coats_of_pbrt",
    "no_panics",
    UNIT_TESTS,
    "batch",
    "batch_accuracy",
    "batch_multibounce",
    "gltf",
    "layered",
    "principled",
    "every_lobe",
    "energy",
    "multibounce",
    "colours",
    "diffuse_and_coats",
    "plastics",
    "conductors",
    "dielectrics",
    "multibounce_mis",
    "samplers",
];

/// Parts of files' paths, and the programs that are about them; the first part that is found counts.
const LIKELY: &[(&str, &[&str])] = &[
    ("/batch/", &["batch", "batch_accuracy", "batch_multibounce"]),
    ("/bsdf/compensated", &["energy", "colours"]),
    ("/bsdf/eon", &["diffuse_and_coats"]),
    ("/bsdf/gltf", &["gltf"]),
    ("/bsdf/layered", &["layered"]),
    ("/bsdf/multibounce", &["batch_multibounce", "multibounce"]),
    ("/bsdf/plastic", &["values_of_mitsuba", "plastics"]),
    ("/bsdf/principled", &["principled"]),
    ("/bsdf/coated", &["coats_of_pbrt", "diffuse_and_coats"]),
    ("/bsdf/dielectric", &["lobes", "every_lobe"]),
    ("/energy/", &["energy", UNIT_TESTS]),
    ("/multibounce/mis_pdf", &["multibounce_mis"]),
    ("/multibounce/normalised", &["multibounce_mis"]),
    ("/multibounce/", &["multibounce", UNIT_TESTS]),
    ("/vndf/", &["visible_normals", "known_values", UNIT_TESTS]),
    ("/math/", &[UNIT_TESTS]),
    ("/fresnel/", &["known_values", UNIT_TESTS]),
];

/// The programs for a fault of a file, in the order in which they are run.
pub(super) fn ordered(file: &str) -> Vec<&'static str> {
    let found = LIKELY.iter().find(|(part, _)| file.contains(part));
    let mut programs = found.map_or_else(Vec::new, |(_, programs)| programs.to_vec());
    let rest = ALL
        .into_iter()
        .filter(|program| !programs.contains(program));
    let rest: Vec<&str> = rest.collect();
    programs.extend(rest);
    programs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn all_programs_exist_and_run_for_every_file() {
        let root = workspace::root();
        let named = LIKELY.iter().flat_map(|(_, programs)| programs.iter());
        for program in ALL.iter().chain(named).filter(|p| **p != UNIT_TESTS) {
            let file = |package: &str| root.join(format!("crates/{package}/tests/{program}.rs"));
            assert!(PACKAGES.map(file).iter().any(|f| f.exists()), "{program}");
        }
        let programs = ordered("crates/specula-bsdf/src/vndf/cap.rs");
        assert_eq!(programs[0], "visible_normals");
        assert_eq!(programs.len(), ALL.len());
        assert_eq!(ordered("crates/specula-bsdf/src/alpha.rs"), ALL);
    }

    #[test]
    fn likely_files_exist() {
        let files = workspace::rust_files(&workspace::root()).unwrap();
        for (part, _) in LIKELY {
            let is_there = files.iter().any(|f| {
                let path = f.to_string_lossy();
                path.contains("specula-bsdf/src/") && path.contains(part)
            });
            assert!(is_there, "{part}");
        }
    }
}
