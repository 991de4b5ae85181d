//! `specula info`.

use crate::cli::ExitCode;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use crate::render::{FilmFile, MemoryEstimate, RenderOptions};
use crate::scene::scene::{Camera, Projection};
use crate::scene::{Scene, Summary};

use super::arguments::InfoArguments;
use super::load::{self, Named};
use super::{Failure, machine, memory, print};

/// Prints what is in a scene and what of it is rendered otherwise than its file says.
pub(crate) fn run(arguments: &InfoArguments) -> Result<ExitCode, Failure> {
    if let Some(path) = &arguments.film {
        print(&film(path)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let options = arguments.loading.options(&arguments.parameters);
    let named = load::scene(arguments.scene.as_deref(), &options)?;
    let text = match arguments.files {
        true => files(&named),
        false => describe(&named),
    };
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// The files that were read, a line for each.
fn files(named: &Named) -> String {
    let lines = named.files.iter().map(|p| format!("{}\n", p.display()));
    lines.collect()
}

/// What a film holds, as a line of JSON.
fn film(path: &Path) -> Result<String, Failure> {
    let FilmFile { label, film } = FilmFile::read(path)
        .map_err(|e| Failure::bad_input(format_args!("cannot read '{}': {e}", path.display())))?;
    let (most, mean) = film.most_and_mean_samples();
    let noise = film.noise();
    let line = serde_json::json!({
        "scene": label.scene,
        "samples": film.samples(),
        "least": film.complete_samples(),
        "most": most,
        "mean": mean,
        // No number where it is not known.
        "noise": noise.is_finite().then_some(noise),
        "adaptive": film.is_adaptive(),
        "seconds": label.seconds,
    });
    Ok(format!("{line}\n"))
}

fn describe(named: &Named) -> String {
    let s = Summary::of(&named.scene);
    let mut lines: Vec<(&str, String)> = Vec::new();
    let [width, height] = s.film.resolution;
    let [x0, x1, y0, y1] = s.film.crop;
    let mut film = format!("{width}x{height}, {}", debug_name(&s.film.filter));
    if s.film.crop != [0, width, 0, height] {
        let _ = write!(film, " filter, crop {x0},{x1},{y0},{y1}");
    } else {
        film.push_str(" filter");
    }
    lines.push(("film", film));
    lines.push((
        "settings",
        format!(
            "{} samples per pixel, paths of at most {} scattering events",
            s.settings.samples_per_pixel, s.settings.max_depth
        ),
    ));
    lines.push(("camera", camera(&s.camera)));
    lines.push(("shapes", counts(&s.shapes)));
    lines.push((
        "triangles",
        format!(
            "{} in {} meshes, {} in view of {} instances of {} objects",
            s.triangles, s.meshes, s.triangles_shown, s.instances, s.objects
        ),
    ));
    lines.extend(motion(&named.scene).map(|motion| ("motion", motion)));
    lines.push(("materials", counts(&s.materials)));
    lines.push(("textures", counts(&s.textures)));
    lines.push(("lights", counts(&s.lights)));
    let (low, high) = (s.bounds.min.to_array(), s.bounds.max.to_array());
    lines.push((
        "bounds",
        format!(
            "({}) to ({})",
            low.map(number).join(", "),
            high.map(number).join(", ")
        ),
    ));
    let mut text = format!("{}\n", named.name);
    for (label, value) in lines {
        let _ = writeln!(text, "  {label:10}{value}");
    }
    let _ = writeln!(text, "  {:10}{}", "memory", memory_line(&named.scene));
    for image in &s.images {
        let _ = writeln!(
            text,
            "  {:10}{} ({}x{})",
            "picture", image.name, image.width, image.height
        );
    }
    let warnings = load::warning_lines(&named.warnings);
    if warnings.is_empty() {
        text.push_str("  everything in it is supported\n");
    } else {
        text.push_str("rendered otherwise than the file says:\n");
        for line in warnings {
            let _ = writeln!(text, "  {line}");
        }
    }
    text
}

/// What moves while the shutter is open; `None`: nothing.
fn motion(scene: &Scene) -> Option<String> {
    let in_objects = scene.objects.iter().flat_map(|object| &object.shapes);
    let shapes = scene.shapes.iter().chain(in_objects);
    let instances = scene.instances.iter();
    let counted = |count: usize, one: &str| match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {one}s")),
    };
    let parts = [
        counted(shapes.filter(|s| s.motion.is_some()).count(), "shape"),
        counted(instances.filter(|i| i.motion.is_some()).count(), "instance"),
        scene.camera.motion.map(|_| "the camera".to_owned()),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// What a render with the scene's own settings would take.
fn memory_line(scene: &Scene) -> String {
    let options = RenderOptions::from_scene(scene);
    memory::line(&MemoryEstimate::of_process(
        scene,
        &options,
        machine::count(None),
    ))
}

/// Projection and lens.
fn camera(camera: &Camera) -> String {
    let lens = if camera.lens_radius > 0.0 {
        format!(
            "lens of radius {}, in focus at {}",
            number(camera.lens_radius),
            number(camera.focal_distance)
        )
    } else {
        "pinhole".to_owned()
    };
    match &camera.projection {
        Projection::Perspective { fov_deg } => {
            format!("perspective, {} degrees, {lens}", number(*fov_deg))
        }
        Projection::Orthographic => format!("orthographic, {lens}"),
        Projection::Spherical(mapping) => format!("spherical, {}", debug_name(mapping)),
        Projection::Lenses(lenses) => format!(
            "{} interfaces of lenses, in focus at {}",
            lenses.interfaces.len(),
            number(camera.focal_distance)
        ),
    }
}

/// The name of an enum's variant: what stands before its fields.
fn debug_name(value: &impl std::fmt::Debug) -> String {
    let text = format!("{value:?}");
    let end = text
        .find(|c: char| !c.is_alphanumeric())
        .unwrap_or(text.len());
    text[..end].to_lowercase()
}

fn counts(map: &BTreeMap<&'static str, usize>) -> String {
    if map.is_empty() {
        return "none".to_owned();
    }
    let parts: Vec<String> = map.iter().map(|(name, n)| format!("{n} {name}")).collect();
    parts.join(", ")
}

/// Four digits at most after the point, none that say nothing.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_plain() {
        assert_eq!(number(1.5), "1.5");
        assert_eq!(number(-0.000_01), "0");
        assert_eq!(number(100.0), "100");
    }
}
