//! `specula denoise`, and `render --denoise`: Open Image Denoise, in programs built with it.
//!
//! The filter takes albedo and normals as guides, where the picture has them. It guesses: what it
//! leaves is smooth, not right, and its variance is unknown.

use crate::cli::ExitCode;

use crate::render::picture::{Metadata, Picture, read_exr};

use super::Failure;
use super::arguments::DenoiseArguments;
use super::console::say;
use super::file_id::Inputs;
use super::outputs::Outputs;

/// Denoises an EXR; code 2 where the program was built without the filter.
pub(crate) fn run(arguments: &DenoiseArguments) -> Result<ExitCode, Failure> {
    ensure_available()?;
    let outputs = Outputs::new(
        arguments.output.clone(),
        arguments.display.choice(false),
        &Inputs::new([&arguments.picture]),
    )?;
    let mut picture = read_exr(&arguments.picture)
        .map_err(|e| Failure::bad_input(format_args!("cannot read the picture: {e}")))?;
    denoise(&mut picture)?;
    let metadata = Metadata {
        software: Some(format!("specula {}", env!("CARGO_PKG_VERSION"))),
        ..Metadata::default()
    };
    outputs.write(&picture, &metadata)?;
    if !arguments.quiet {
        say!("wrote {}", outputs.names());
    }
    Ok(ExitCode::SUCCESS)
}

/// Fails where the program was built without the filter: now, not after an hour.
pub(crate) fn ensure_available() -> Result<(), Failure> {
    if cfg!(feature = "oidn") {
        return Ok(());
    }
    Err(Failure::bad_input(
        "this program was built without Open Image Denoise.\n\
         `cargo build --release -p specula --features oidn` builds it in, where the library is \
         installed (docs/guide/denoising.md says how)",
    ))
}

/// Replaces the colours by denoised ones, and drops their variance.
#[cfg(feature = "oidn")]
pub(crate) fn denoise(picture: &mut Picture) -> Result<(), Failure> {
    use crate::bsdf::math::rgb;

    let failed = |e: oidn::Error| Failure::other(format_args!("Open Image Denoise failed: {e}"));
    let flat = |layer: &[crate::bsdf::Rgb<f32>]| -> Vec<f32> {
        layer.iter().flat_map(|c| c.to_array()).collect()
    };
    let device = oidn::Device::cpu().map_err(failed)?;
    let mut filter = oidn::RayTracing::try_new(&device).map_err(failed)?;
    filter
        .hdr(true)
        .image_dimensions(picture.width as usize, picture.height as usize);
    if !picture.albedo.is_empty() {
        // The filter's range; glossy colours may lie a little beyond.
        let albedo: Vec<f32> = flat(&picture.albedo)
            .into_iter()
            .map(|a| a.clamp(0.0, 1.0))
            .collect();
        if picture.normal.is_empty() {
            filter.albedo(&albedo);
        } else {
            let normals = picture.normal.iter().flat_map(|n| [n.x, n.y, n.z]);
            filter.albedo_normal(&albedo, &normals.collect::<Vec<f32>>());
        }
    }
    let mut colours = flat(&picture.colour);
    filter.filter_in_place(&mut colours).map_err(failed)?;
    let (colours, _) = colours.as_chunks::<3>();
    picture.colour = colours.iter().map(|[r, g, b]| rgb(*r, *g, *b)).collect();
    picture.variance.clear();
    Ok(())
}

#[cfg(not(feature = "oidn"))]
pub(crate) fn denoise(_: &mut Picture) -> Result<(), Failure> {
    ensure_available()
}
