//! Scenes by name, and the warnings that go with them.

use std::collections::HashMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::scene::scene::Light;
use crate::scene::{Format, LoadOptions, Scene, Warning, builtin, load_bytes, load_with};

use super::Failure;
use super::console::say;

/// What messages call a scene from standard input.
const STDIN: &str = "<stdin>";
/// Most warnings that are printed by a render; `specula check` prints all.
const MOST_WARNINGS: usize = 12;

/// A scene with its name and warnings.
pub(crate) struct Named {
    /// The file's name without its extensions.
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) warnings: Vec<Warning>,
    /// All files that were read.
    pub(crate) files: Vec<PathBuf>,
    /// Files that do not exist and that something stands in for.
    pub(crate) missing: Vec<PathBuf>,
    /// When its reading began.
    pub(crate) since: Instant,
    /// Whether its lights are in lux and candela.
    pub(crate) is_photometric: bool,
}

/// The scene of a file, or the built-in one.
pub(crate) fn scene(path: Option<&Path>, options: &LoadOptions) -> Result<Named, Failure> {
    let since = Instant::now();
    let Some(path) = path else {
        return Ok(Named {
            name: "orbs".to_owned(),
            scene: builtin::orbs(),
            warnings: Vec::new(),
            files: Vec::new(),
            missing: Vec::new(),
            since,
            is_photometric: false,
        });
    };
    let loaded = match path.as_os_str() == "-" {
        true => load_bytes(STDIN.as_ref(), stdin(options)?, options),
        false => load_with(path, options),
    }
    .map_err(Failure::input)?;
    if loaded.format != Format::Mitsuba && !options.parameters.is_empty() {
        return Err(Failure::bad_input(format_args!(
            "-D is for Mitsuba scenes; {} is none",
            path.display()
        )));
    }
    // A pipe has no name of its own.
    let is_named = path.is_file();
    let lights = &loaded.scene.lights;
    Ok(Named {
        is_photometric: loaded.format == Format::Gltf
            && (lights.iter()).any(|light| !matches!(light, Light::Infinite { .. })),
        name: if is_named {
            stem(path)
        } else {
            "scene".to_owned()
        },
        scene: loaded.scene,
        warnings: loaded.warnings,
        files: loaded.files,
        missing: loaded.missing,
        since,
    })
}

/// All of standard input.
fn stdin(options: &LoadOptions) -> Result<Vec<u8>, Failure> {
    let most = options.limits.max_bytes;
    let mut bytes = Vec::new();
    let read = std::io::stdin()
        .lock()
        .take(most.saturating_add(1))
        .read_to_end(&mut bytes);
    read.map_err(|e| Failure::bad_input(format_args!("cannot read standard input: {e}")))?;
    if bytes.len() as u64 > most {
        return Err(Failure::bad_input(format_args!(
            "standard input has more than {most} bytes (--limit-bytes)"
        )));
    }
    Ok(bytes)
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
        say!("warning: {line}");
    }
    if let Some(rest) = lines.len().checked_sub(MOST_WARNINGS).filter(|n| *n > 0) {
        say!("warning: {rest} more; `specula check` lists all");
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
