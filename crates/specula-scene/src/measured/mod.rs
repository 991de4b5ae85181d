//! Measured materials: `.bsdf` files of the RGL database (Dupuy and Jakob 2018), as pbrt-v4's and Mitsuba's
//! `measured` read them, and `.binary` files of MERL's ([`Merl`]), which become tables of the same form.
//!
//! Files hold `rgb`, or `spectra` over `wavelengths`, which become RGB as reflectances do
//! ([`reflectance_to_rgb`](crate::spectrum::reflectance_to_rgb)). The pages of tables are those of
//! [`MeasuredTables`].

mod merl;
mod tensor;
mod write;

use core::hash::Hasher;
use std::path::Path;
use std::sync::Arc;

use specula_bsdf::measured::{Measured, MeasuredGrid, MeasuredTables};
use thiserror::Error;
use twox_hash::XxHash3_64;

use crate::read_file::Files;
use crate::spectrum::SpectraToRgb;
use tensor::{FLOAT32, TensorFile, UINT8};

pub use merl::Merl;
pub use write::to_bytes;

/// A measured material of a scene.
#[derive(Clone, Debug)]
pub struct MeasuredBrdf {
    /// Its file's name.
    pub name: String,
    lobe: Arc<Measured<f32>>,
    /// A hash of its file.
    pub(crate) content: u64,
}

/// Why bytes are no measured material.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct MeasuredFileError(String);

impl MeasuredBrdf {
    /// Reads the bytes of a file.
    ///
    /// * `name`: any name.
    ///
    /// # Errors
    ///
    /// What is wrong with them: "has no field ...", "\"vndf\" has the shape ...".
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, MeasuredFileError> {
        let tables = tables(bytes)?;
        let lobe = Measured::new(&tables).map_err(|e| MeasuredFileError(e.to_string()))?;
        let mut hash = XxHash3_64::new();
        hash.write(bytes);
        Ok(Self {
            name: name.to_owned(),
            lobe: Arc::new(lobe),
            content: hash.finish(),
        })
    }

    /// The lobe; clones share it.
    #[must_use]
    pub fn lobe(&self) -> &Arc<Measured<f32>> {
        &self.lobe
    }
}

/// Reads a file.
///
/// # Errors
///
/// A message with the file's name.
pub(crate) fn read(path: &Path, files: &Files) -> Result<MeasuredBrdf, String> {
    let wrong = |message: String| format!("measured material {}: {message}", path.display());
    let bytes = files.plain(path).map_err(wrong)?;
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
    MeasuredBrdf::from_bytes(&name.unwrap_or_default(), &bytes).map_err(|e| wrong(e.to_string()))
}

/// The tables of the file at a path, as [`tables`].
///
/// # Errors
///
/// Where it cannot be read, or is no measured material: a message without its name.
pub fn read_tables(path: &Path) -> Result<MeasuredTables, MeasuredFileError> {
    let bytes = Files::default().plain(path).map_err(MeasuredFileError)?;
    tables(&bytes)
}

/// The tables of a file of the RGL database or of MERL's.
///
/// # Errors
///
/// Where the bytes are no such file, a field is missing or has another type or shape. What values must be
/// is checked by [`Measured::new`].
pub fn tables(bytes: &[u8]) -> Result<MeasuredTables, MeasuredFileError> {
    if Merl::is_one(bytes) {
        let merl = Merl::from_bytes(bytes).map_err(MeasuredFileError)?;
        return Ok(merl.tables());
    }
    of_tensors(bytes).map_err(MeasuredFileError)
}

fn of_tensors(bytes: &[u8]) -> Result<MeasuredTables, String> {
    let file = TensorFile::parse(bytes)?;
    let floats = |name: &str, dimensions| file.get(name, FLOAT32, dimensions);
    let (theta_i, phi_i) = (floats("theta_i", 1)?, floats("phi_i", 1)?);
    let (ndf, sigma) = (floats("ndf", 2)?, floats("sigma", 2)?);
    let (vndf, luminance) = (floats("vndf", 4)?, floats("luminance", 4)?);
    let jacobian = file.get("jacobian", UINT8, 1)?;
    jacobian.expect(&[1])?;
    let views = [phi_i.shape[0], theta_i.shape[0]];
    let rows = |shape: &[usize]| [shape[shape.len() - 2], shape[shape.len() - 1]];
    for field in [vndf, luminance] {
        let [h, w] = rows(&field.shape);
        field.expect(&[views[0], views[1], h, w])?;
    }
    let nodes = rows(&luminance.shape);
    let of_views = |n: usize| [views[0], views[1], n, nodes[0], nodes[1]];
    let rgb = match (file.find("rgb"), file.find("spectra")) {
        (Some(_), _) => {
            let field = floats("rgb", 5)?;
            field.expect(&of_views(3))?;
            field.floats().collect()
        }
        (None, Some(_)) => {
            let wavelengths = floats("wavelengths", 1)?;
            let field = floats("spectra", 5)?;
            field.expect(&of_views(wavelengths.shape[0]))?;
            let wavelengths: Vec<f64> = wavelengths.floats().map(f64::from).collect();
            if field.floats().any(|v| !v.is_finite()) {
                return Err("\"spectra\" has values that are not finite".to_owned());
            }
            let values: Vec<f32> = field.floats().collect();
            colours(&values, &wavelengths, nodes[0] * nodes[1])?
        }
        (None, None) => return Err("has neither a field \"rgb\" nor \"spectra\"".to_owned()),
    };
    let grid = |field: &tensor::Field| {
        let [h, w] = rows(&field.shape);
        MeasuredGrid {
            size: [w, h],
            values: field.floats().collect(),
        }
    };
    Ok(MeasuredTables {
        theta_i: theta_i.floats().collect(),
        phi_i: phi_i.floats().collect(),
        ndf: grid(ndf),
        sigma: grid(sigma),
        vndf: grid(vndf),
        luminance: grid(luminance),
        rgb,
        jacobian: jacobian.bytes().first().is_some_and(|&b| b != 0),
    })
}

/// Slices of spectra as slices of red, green and blue.
///
/// * `values`: of each view all nodes of the first wavelength, then those of the next.
fn colours(values: &[f32], wavelengths: &[f64], nodes: usize) -> Result<Vec<f32>, String> {
    let to_rgb = SpectraToRgb::new(wavelengths).map_err(|e| format!("\"wavelengths\": {e}"))?;
    let mut rgb = Vec::with_capacity(3 * (values.len() / wavelengths.len()));
    let mut samples = vec![0.0; wavelengths.len()];
    let mut slice = Vec::with_capacity(nodes);
    for view in values.chunks_exact((wavelengths.len() * nodes).max(1)) {
        slice.clear();
        for node in 0..nodes {
            for (sample, plane) in samples.iter_mut().zip(view.chunks_exact(nodes)) {
                *sample = plane[node].into();
            }
            slice.push(to_rgb.colour(&samples).to_array());
        }
        for channel in 0..3 {
            rgb.extend(slice.iter().map(|c| c[channel]));
        }
    }
    Ok(rgb)
}
