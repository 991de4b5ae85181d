//! Scenes written as pbrt-v4 files.
//!
//! One text file, and a folder beside it with meshes (binary PLY) and pictures (EXR). What pbrt-v4
//! cannot express is written as the nearest that it can, and listed in the notes that are returned.

mod asset;
mod camera;
mod light;
mod material;
mod medium;
mod motion;
mod name;
mod product;
mod projected;
mod shape;
mod texture;

use std::collections::HashMap;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};

use glam::DMat4;
use specula_bsdf::Rgb;

use crate::scene::{Channel, Film, Filter, ImageId, Projection, Scene, TextureId};

use name::Names;

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {source}", path = path.display())]
#[non_exhaustive]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the system says.
    pub source: io::Error,
}

/// pbrt's two types of textures: of numbers and of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum TextureType {
    Float,
    Spectrum,
}

/// The state of the writer.
struct Writer<'a> {
    scene: &'a Scene,
    /// The file itself.
    path: &'a Path,
    /// Folder of meshes and pictures, made when the first is written.
    folder: PathBuf,
    /// Whether these are written at all.
    keeps: bool,
    text: String,
    /// Times of all that moves, in exposures.
    times: [f64; 2],
    /// Notes on what pbrt-v4 cannot express, each once.
    notes: Vec<String>,
    /// Names of written textures by type, and the bits of the colour that they are multiplied by.
    textures: HashMap<(TextureId, TextureType, [u32; 3]), String>,
    /// Whether a texture has no colours, by its number.
    greys: Vec<bool>,
    /// Products of textures and themselves.
    squared: HashMap<TextureId, String>,
    images: HashMap<(ImageId, Channel), String>,
    /// What every material is called in the file.
    names: Names,
}

/// Writes a scene to a pbrt-v4 file, with its meshes and pictures in the folder `NAME-files` beside
/// it, and returns notes on what pbrt-v4 cannot express.
///
/// Every file is replaced whole or not at all; the scene file comes last.
///
/// # Errors
///
/// What the system says about the file that could not be written.
pub fn write_pbrt(scene: &Scene, path: &Path) -> Result<Vec<String>, WriteError> {
    let (text, notes) = write(scene, path, true)?;
    asset::replace(path, text.as_bytes())?;
    Ok(notes)
}

/// The scene file that [`write_pbrt`] writes, and its notes; no file is written, also none of those beside it. Meshes
/// of up to 20,000 triangles and vertices are within the text; a note says that other files are named only.
///
/// * `path`: of the scene file, by which those beside it are named.
///
/// # Errors
///
/// As [`write_pbrt`]; where nothing is written, none are known.
pub fn pbrt_text(scene: &Scene, path: &Path) -> Result<(String, Vec<String>), WriteError> {
    write(scene, path, false)
}

/// * `keeps`: whether files beside the scene file are written.
fn write(scene: &Scene, path: &Path, keeps: bool) -> Result<(String, Vec<String>), WriteError> {
    let mut writer = Writer {
        keeps,
        scene,
        path,
        folder: assets_folder(path),
        text: String::new(),
        times: motion::times(scene),
        notes: Vec::new(),
        textures: HashMap::new(),
        greys: product::greys(scene),
        squared: HashMap::new(),
        images: HashMap::new(),
        names: Names::new(&scene.materials),
    };
    writer.view()?;
    writer.line("\nWorldBegin");
    for (i, light) in scene.lights.iter().enumerate() {
        writer.light(i, light)?;
    }
    writer.materials()?;
    writer.media();
    writer.shapes()?;
    Ok((writer.text, writer.notes))
}

/// The folder that [`write_pbrt`] writes meshes and pictures to: `NAME-files` beside the scene file.
#[must_use]
pub fn assets_folder(path: &Path) -> PathBuf {
    let mut folder = path.file_stem().unwrap_or(path.as_os_str()).to_owned();
    folder.push("-files");
    path.with_file_name(folder)
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Notes what pbrt-v4 cannot express.
    fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Everything before the world.
    fn view(&mut self) -> Result<(), WriteError> {
        let (camera, film) = (&self.scene.camera, &self.scene.film);
        let settings = &self.scene.settings;
        if settings.hide_emitters {
            self.note("lights that are hidden from the camera are seen");
        }
        if film.balance != Film::NO_BALANCE {
            self.note("white balance is left out");
        }
        let [start, end] = self.times;
        if self.times != motion::SHUTTER {
            self.line(&format!("TransformTimes {start} {end}"));
        }
        let place = self.camera_place(&camera.to_world, camera.motion.as_ref());
        let camera_text = self.camera_text(camera)?;
        let diagonal = match &camera.projection {
            Projection::Lenses(lenses) => {
                format!(" \"float diagonal\" [ {} ]", lenses.film_diagonal * 1e3)
            }
            _ => String::new(),
        };
        let text = format!(
            "{place}\n{camera_text}\n{}{diagonal}\n{}\nSampler \"zsobol\" \"integer pixelsamples\" [ {} ]\n\
             Integrator \"volpath\" \"integer maxdepth\" [ {} ]\n",
            film_text(film, self.path),
            filter_text(&film.filter),
            settings.samples_per_pixel,
            settings.max_depth,
        );
        self.text.push_str(&text);
        Ok(())
    }
}

fn film_text(film: &Film, path: &Path) -> String {
    let [width, height] = film.resolution;
    let name = film.file_name.clone().unwrap_or_else(|| {
        let stem = path.file_stem().unwrap_or(path.as_os_str());
        format!("{}.exr", stem.to_string_lossy())
    });
    let bound = film.max_component.map_or_else(String::new, |most| {
        format!(" \"float maxcomponentvalue\" [ {most} ]")
    });
    format!(
        "Film \"rgb\" \"integer xresolution\" [ {width} ] \"integer yresolution\" [ {height} ] \
         \"integer pixelbounds\" [ {} ] \"float iso\" [ {} ]{bound} \"string filename\" [ {} ]",
        list(&film.crop),
        f64::from(film.exposure) * 100.0,
        quoted(&name),
    )
}

fn filter_text(filter: &Filter) -> String {
    let (name, radius, more) = match *filter {
        Filter::Box { radius } => ("box", radius, String::new()),
        Filter::Triangle { radius } => ("triangle", radius, String::new()),
        Filter::Gaussian { radius, sigma } => {
            ("gaussian", radius, format!("\"float sigma\" [ {sigma} ]"))
        }
        Filter::Mitchell { radius, b, c } => {
            let more = format!("\"float B\" [ {b} ] \"float C\" [ {c} ]");
            ("mitchell", radius, more)
        }
        Filter::LanczosSinc { radius, tau } => ("sinc", radius, format!("\"float tau\" [ {tau} ]")),
    };
    let [x, y] = radius;
    format!("PixelFilter \"{name}\" \"float xradius\" [ {x} ] \"float yradius\" [ {y} ] {more}")
}

/// The directive that sets the current transform: columns one after the other.
fn transform(m: &DMat4) -> String {
    format!("Transform [ {} ]", list(&m.to_cols_array()))
}

fn list<T: std::fmt::Display>(values: &[T]) -> String {
    let mut text = String::new();
    for (i, value) in values.iter().enumerate() {
        let space = if i == 0 { "" } else { " " };
        let _ = write!(text, "{space}{value}");
    }
    text
}

fn rgb_list(c: Rgb<f32>) -> String {
    list(&c.to_array())
}

/// A string as pbrt reads it.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            // Names cannot contain line ends.
            c if c.is_control() => out.push('_'),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests;
