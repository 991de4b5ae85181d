//! Files as data URIs.

use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;

use crate::plot::WrittenPlot;
use crate::{LabError, Result};

/// An SVG with more bytes (a map with a rectangle per cell) is shown by its pixels.
const LARGEST_SVG: u64 = 400 << 10;
/// A table's file with more bytes is not embedded in the page.
const LARGEST_CSV: u64 = 1 << 20;

fn length(path: &Path) -> Result<u64> {
    let file = fs::metadata(path).map_err(LabError::io(path))?;
    Ok(file.len())
}

/// * `kind`: of media, such as `image/png`.
fn uri(path: &Path, kind: &str) -> Result<String> {
    let bytes = fs::read(path).map_err(LabError::io(path))?;
    Ok(format!("data:{kind};base64,{}", STANDARD.encode(bytes)))
}

/// A picture.
pub(super) fn png(path: &Path) -> Result<String> {
    uri(path, "image/png")
}

/// A plot: as vectors unless that takes too much room.
pub(super) fn plot(folder: &Path, plot: &WrittenPlot) -> Result<String> {
    let svg = folder.join(&plot.svg);
    if length(&svg)? > LARGEST_SVG {
        png(&folder.join(&plot.png))
    } else {
        uri(&svg, "image/svg+xml")
    }
}

/// A table's file; `None` where it takes too much room.
pub(super) fn csv(path: &Path) -> Result<Option<String>> {
    if length(path)? > LARGEST_CSV {
        return Ok(None);
    }
    uri(path, "text/csv;charset=utf-8").map(Some)
}
