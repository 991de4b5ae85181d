//! `cargo xtask tables`: every generator, in one list.

use std::path::Path;

use crate::generated::{self, Generated};
use crate::{
    Result, albedo, energy_fit, exact, features, gltf, interface, interface_single, metals, plastic,
};

/// What makes generated files from the workspace's own data.
type Generator = fn(&Path) -> Result<Vec<Generated>>;

/// What finds a committed file wrong in less time than making it anew takes.
type Check = fn(&Path) -> Result<()>;

/// The generators by name, and quick checks. A new one is a module of its own beside this file and a
/// line here.
const GENERATORS: &[(&str, Generator, Option<Check>)] = &[
    ("metals", metals::generate, None),
    ("interface", interface::generate, None),
    ("interface, single", interface_single::generate, None),
    ("plastic", plastic::generate, None),
    ("gltf", gltf::generate, None),
    ("albedo", albedo::generate, Some(albedo::check)),
    ("energy, fit", energy_fit::generate, None),
    ("exact", exact::generate, None),
    ("features", features::generate, None),
];

/// Writes every generated file, or with `check` fails where a committed one differs.
pub(crate) fn run(root: &Path, check: bool) -> Result<()> {
    let mut failures = String::new();
    for (name, generate, quick) in GENERATORS {
        println!("{name}:");
        let outcome = match quick {
            Some(quick) if check => quick(root),
            _ => generated::apply(root, &generate(root)?, check),
        };
        if let Err(e) = outcome {
            failures += &e.to_string();
        }
    }
    match failures.is_empty() {
        true => Ok(()),
        false => Err(failures.into()),
    }
}
