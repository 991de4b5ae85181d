//! Pictures of one scene beside each other and beside their reference.

use std::path::Path;

use serde::{Deserialize, Serialize};
use specula_render::picture::{
    Display, Metadata, Picture, ToneMap, difference_rgb8, write_exr, write_rgb8,
};

use super::insets::{self, Inset, Sheet};
use crate::{Errors, Result, errors};

/// The display of linear values: clamped at white.
const PLAIN: Display = Display {
    tone_map: ToneMap::Clamp,
    exposure_stops: 0.0,
};

/// Pictures of the same size.
pub struct PictureComparison<'a> {
    /// Name of the files, without their ends.
    pub name: &'a str,
    /// What it shows.
    pub caption: &'a str,
    /// From left to right.
    pub shots: Vec<Shot<'a>>,
    /// The picture that they converge to, where it is known.
    pub reference: Option<&'a Picture>,
    /// Parts to be enlarged.
    pub insets: Vec<Inset>,
    /// Exposure of what screens show, in stops.
    pub exposure_stops: f32,
}

/// One of the pictures.
pub struct Shot<'a> {
    /// What made it, such as `bounded`.
    pub label: &'a str,
    /// The picture.
    pub picture: &'a Picture,
    /// A note, such as `16 spp, 2.1 s`.
    pub note: String,
}

/// The files of a [`PictureComparison`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WrittenComparison {
    /// Name of the files, without their ends.
    pub name: String,
    /// What it shows.
    pub caption: String,
    /// All pictures with their insets, from left to right in the order of `shots`, the reference last.
    pub sheet: String,
    /// Columns and rows of each picture.
    pub size: [u32; 2],
    /// One by one.
    pub shots: Vec<WrittenShot>,
}

/// The files of a [`Shot`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WrittenShot {
    /// What made it.
    pub label: String,
    /// A note.
    pub note: String,
    /// The file as a screen shows it.
    pub png: String,
    /// The file with linear values.
    pub exr: String,
    /// The file with its HDR-FLIP error, where there is a reference.
    pub error_png: Option<String>,
    /// How far it is from the reference.
    pub errors: Option<Errors>,
}

impl PictureComparison<'_> {
    /// Writes a PNG and an EXR of each picture, the map of its error, and all of them on one sheet.
    ///
    /// # Errors
    ///
    /// Where a file cannot be written, or a picture has another size than the reference.
    pub fn write(&self, folder: &Path) -> Result<WrittenComparison> {
        let display = Display {
            exposure_stops: self.exposure_stops,
            ..PLAIN
        };
        let mut sheets = Vec::new();
        let mut shots = Vec::new();
        let reference = self.reference.map(|picture| Shot {
            label: "reference",
            picture,
            note: String::new(),
        });
        for shot in self.shots.iter().chain(&reference) {
            let stem = format!("{}-{}", self.name, file_name(shot.label));
            let sheet = Sheet::of(shot.picture, display);
            let png = format!("{stem}.png");
            write_sheet(&folder.join(&png), &sheet)?;
            let exr = format!("{stem}.exr");
            write_exr(&folder.join(&exr), &colours(shot.picture), &software())?;
            let is_reference = self
                .reference
                .is_some_and(|r| std::ptr::eq(r, shot.picture));
            let judged = self.reference.filter(|_| !is_reference);
            let (error_png, errors) = match judged {
                None => (None, None),
                Some(reference) => {
                    let errors = errors(reference, shot.picture)?;
                    let name = format!("{stem}-error.png");
                    let [w, h] = [shot.picture.width, shot.picture.height];
                    write_rgb8(&folder.join(&name), w, h, &difference_rgb8(&errors.map))?;
                    (Some(name), Some(errors))
                }
            };
            sheets.push(insets::with_insets(&sheet, &self.insets));
            shots.push(WrittenShot {
                label: shot.label.to_owned(),
                note: shot.note.clone(),
                png,
                exr,
                error_png,
                errors,
            });
        }
        // Wide pictures stand under each other.
        let is_wide = sheets.first().is_some_and(|s| s.width > 2 * s.height);
        let sheet = if is_wide {
            insets::column(&sheets)
        } else {
            insets::row(&sheets)
        };
        let name = format!("{}.png", self.name);
        write_sheet(&folder.join(&name), &sheet)?;
        let size = self
            .shots
            .first()
            .map_or([0, 0], |s| [s.picture.width, s.picture.height]);
        Ok(WrittenComparison {
            name: self.name.to_owned(),
            caption: self.caption.to_owned(),
            sheet: name,
            size,
            shots,
        })
    }
}

/// The picture without the layers that only denoisers need.
fn colours(picture: &Picture) -> Picture {
    Picture::from_colour(picture.width, picture.height, picture.colour.clone())
}

fn software() -> Metadata {
    Metadata {
        software: Some(format!("specula {}", env!("CARGO_PKG_VERSION"))),
        ..Metadata::default()
    }
}

/// Writes a sheet as PNG.
///
/// # Errors
///
/// Where the file cannot be written.
#[expect(
    clippy::cast_possible_truncation,
    reason = "sheets are a few thousand pixels wide"
)]
pub fn write_sheet(path: &Path, sheet: &Sheet) -> Result<()> {
    write_rgb8(
        path,
        sheet.width as u32,
        sheet.height as u32,
        &sheet.bytes(),
    )?;
    Ok(())
}

/// `label` as part of a file's name.
#[must_use]
pub fn file_name(label: &str) -> String {
    let mut name = String::new();
    for c in label.chars() {
        if c.is_ascii_alphanumeric() || c == '.' {
            name.push(c.to_ascii_lowercase());
        } else if !name.ends_with('-') {
            name.push('-');
        }
    }
    name.trim_matches('-').to_owned()
}
