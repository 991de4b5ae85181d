//! Lists the files of `wgsl/` for `src/modules.rs`: a module is there as soon as its file is.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Folders by what they need of each other; others follow by name.
const FOLDERS: [&str; 9] = [
    "",
    "math",
    "ndf",
    "vndf",
    "fresnel",
    "energy",
    "bsdf",
    "multibounce",
    "measured",
];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    // A folder, with all files in it.
    println!("cargo::rerun-if-changed=wgsl");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let mut paths = Vec::new();
    list(&root.join("wgsl"), "", &mut paths)?;
    paths.sort_by_key(|path| {
        let folder = path.split_once('/').map_or("", |(folder, _)| folder);
        let rank = FOLDERS.iter().position(|known| *known == folder);
        (rank.unwrap_or(FOLDERS.len()), path.clone())
    });
    let rows = paths.iter().map(|path| {
        format!(
            "    Module {{ path: {path:?}, text: include_str!(concat!(env!(\"CARGO_MANIFEST_DIR\"), \
             \"/wgsl/{path}.wgsl\")) }},\n"
        )
    });
    let text = format!("&[\n{}]\n", rows.collect::<String>());
    fs::write(PathBuf::from(env::var("OUT_DIR")?).join("modules.rs"), text)?;
    Ok(())
}

/// Paths of the modules in a folder and below it, without their extension: `vndf/bounded`.
fn list(folder: &Path, prefix: &str, paths: &mut Vec<String>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        let stem = stem.ok_or_else(|| format!("{}: no name in UTF-8", path.display()))?;
        if path.is_dir() {
            list(&path, &format!("{prefix}{stem}/"), paths)?;
        } else if path
            .extension()
            .is_some_and(|extension| extension == "wgsl")
        {
            paths.push(format!("{prefix}{stem}"));
        }
    }
    Ok(())
}
