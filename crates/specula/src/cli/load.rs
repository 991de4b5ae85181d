//! Scenes by name, and the warnings that go with them.

use std::collections::HashMap;
use std::path::Path;

use specula::scene::{LoadOptions, Scene, Warning, builtin, load_with_options};

use super::Failure;

/// Most warnings that are printed by a render; `specula check` prints all.
const MOST_WARNINGS: usize = 12;

/// A scene with its name and warnings.
pub(crate) struct Named {
    /// The file's name without its extensions.
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) warnings: Vec<Warning>,
}

/// The scene of a file, or the built-in one.
pub(crate) fn scene(path: Option<&Path>, options: &LoadOptions) -> Result<Named, Failure> {
    let Some(path) = path else {
        return Ok(Named {
            name: "orbs".to_owned(),
            scene: builtin::orbs(),
            warnings: Vec::new(),
        });
    };
    let is_mitsuba = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("xml"));
    if !is_mitsuba && !options.parameters.is_empty() {
        return Err(Failure::bad_input(format_args!(
            "-D is for Mitsuba scenes (.xml); {} is none",
            path.display()
        )));
    }
    let loaded = load_with_options(path, options).map_err(Failure::input)?;
    Ok(Named {
        name: stem(path),
        scene: loaded.scene,
        warnings: loaded.warnings,
    })
}

/// `a/scene.pbrt.gz` is called `scene`.
fn stem(path: &Path) -> String {
    let name = path
        .file_name()
        .map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    let name = [".pbrt", ".xml", ".gltf", ".glb", ".obj", ".ply"]
        .iter()
        .find_map(|end| name.strip_suffix(end))
        .unwrap_or(name);
    if name.is_empty() {
        "picture".to_owned()
    } else {
        name.to_owned()
    }
}

/// Warnings as lines of `file:line:column: message`; equal messages are one line with their count.
pub(crate) fn warning_lines(warnings: &[Warning]) -> Vec<String> {
    let mut index: HashMap<&str, usize> = HashMap::new();
    let mut grouped: Vec<(&Warning, usize)> = Vec::new();
    for warning in warnings {
        let next = grouped.len();
        let at = *index.entry(warning.message()).or_insert(next);
        if at == next {
            grouped.push((warning, 1));
        } else {
            grouped[at].1 += 1;
        }
    }
    grouped
        .iter()
        .map(|(w, count)| {
            let more = match count {
                1 => String::new(),
                n => format!(" (and {} more like it)", n - 1),
            };
            format!("{}: {}{more}", w.place(), w.message())
        })
        .collect()
}

/// Prints the warnings of a scene that is about to be rendered.
pub(crate) fn print_warnings(warnings: &[Warning]) {
    let lines = warning_lines(warnings);
    for line in lines.iter().take(MOST_WARNINGS) {
        eprintln!("warning: {line}");
    }
    if let Some(rest) = lines.len().checked_sub(MOST_WARNINGS).filter(|n| *n > 0) {
        eprintln!("warning: {rest} more; `specula check` lists all");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stems() {
        assert_eq!(stem(Path::new("a/b.pbrt")), "b");
        assert_eq!(stem(Path::new("b.pbrt.gz")), "b");
        assert_eq!(stem(Path::new("b.glb")), "b");
        assert_eq!(stem(Path::new("scene-v4.pbrt")), "scene-v4");
        assert_eq!(stem(Path::new("..")), "picture");
    }
}
