//! `cargo xtask tables`: every generator, in one list.

use std::path::Path;

use crate::generated::{self, Generated};
use crate::{Result, albedo, interface, metals};

/// What makes generated files from the workspace's own data.
type Generator = fn(&Path) -> Result<Vec<Generated>>;

/// The generators by name. A new one is a module of its own beside this file and a line here.
const GENERATORS: &[(&str, Generator)] = &[
    ("metals", metals::generate),
    ("interface", interface::generate),
    ("albedo", albedo::generate),
];

/// Writes every generated file, or with `check` fails where a committed one differs.
pub(crate) fn run(root: &Path, check: bool) -> Result<()> {
    let mut failures = String::new();
    for (name, generate) in GENERATORS {
        println!("{name}:");
        if let Err(e) = generated::apply(root, &generate(root)?, check) {
            failures += &e.to_string();
        }
    }
    match failures.is_empty() {
        true => Ok(()),
        false => Err(failures.into()),
    }
}
