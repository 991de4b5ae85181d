//! FLIP of pictures as rendered, and after the same denoiser for everybody.

use std::path::{Path, PathBuf};
use std::process::Command;

use specula_bsdf::Rgb;
use specula_render::picture::{Metadata, Picture, flip_map, write_exr};

use super::outcome::Outcome;
use super::reference::colours;
use crate::Result;

/// Exit code of a Specula that was built without the filter.
const NOT_BUILT_IN: i32 = 2;

/// Mean LDR-FLIP against the reference, both clamped to what a screen shows: 0 equal, 1 black and white.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Flip {
    pub(crate) rendered: f64,
    /// Of the denoised picture, against the reference as it is.
    pub(crate) denoised: Option<f64>,
}

/// Open Image Denoise, in a Specula that was built with it.
pub(crate) struct Denoiser {
    program: PathBuf,
}

impl Denoiser {
    /// `None` where `program` was built without the filter.
    pub(crate) fn of(program: &Path, folder: &Path) -> Result<Option<Self>> {
        let denoiser = Self {
            program: program.to_owned(),
        };
        let black = vec![Rgb::splat(0.0); 16 * 16];
        let found = denoiser.run(&black, 16, folder)?;
        Ok(found.map(|_| denoiser))
    }

    /// Replaces a picture by what the filter makes of its colours alone: other renderers give no more.
    fn denoise(&self, picture: &[Rgb<f32>], width: usize, folder: &Path) -> Result<Vec<Rgb<f32>>> {
        let denoised = self.run(picture, width, folder)?;
        denoised.ok_or_else(|| "the denoiser is no longer there".into())
    }

    fn run(
        &self,
        picture: &[Rgb<f32>],
        width: usize,
        folder: &Path,
    ) -> Result<Option<Vec<Rgb<f32>>>> {
        let [noisy, smooth] = ["noisy.exr", "denoised.exr"].map(|name| folder.join(name));
        let [columns, rows] = [width, picture.len() / width].map(u32::try_from);
        let colours_alone = Picture::from_colour(columns?, rows?, picture.to_vec());
        write_exr(&noisy, &colours_alone, &Metadata::default())?;
        let output = Command::new(&self.program)
            .arg("denoise")
            .arg(&noisy)
            .arg("--output")
            .arg(&smooth)
            .arg("--quiet")
            .output()?;
        match output.status.code() {
            Some(0) => Ok(Some(colours(&smooth)?.1)),
            Some(NOT_BUILT_IN) => Ok(None),
            _ => {
                let said = String::from_utf8_lossy(&output.stderr);
                Err(format!("denoising failed:\n{said}").into())
            }
        }
    }
}

/// Fills in the FLIP of every row's first picture.
pub(crate) fn measure(
    outcome: &mut Outcome,
    denoiser: Option<&Denoiser>,
    folder: &Path,
) -> Result<()> {
    let pictures = outcome.references.iter().zip(&outcome.first);
    for (row, (reference, picture)) in outcome.rows.iter_mut().zip(pictures) {
        let mean = |picture: &[Rgb<f32>]| mean_flip(&reference.picture, picture, reference.width);
        let denoised = match denoiser {
            Some(denoiser) => Some(denoiser.denoise(picture, reference.width, folder)?),
            None => None,
        };
        row.flip = Some(Flip {
            rendered: mean(picture)?,
            denoised: denoised.map(|picture| mean(&picture)).transpose()?,
        });
    }
    Ok(())
}

fn mean_flip(reference: &[Rgb<f32>], picture: &[Rgb<f32>], width: usize) -> Result<f64> {
    if reference.len() != picture.len() {
        return Err("pictures of different sizes".into());
    }
    let map = flip_map(reference, picture, u32::try_from(width)?);
    let sum: f64 = map.iter().copied().map(f64::from).sum();
    Ok(sum / map.len() as f64)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn equal_pictures_have_no_flip_and_white_on_black_nearly_all() {
        let [black, white, bright] = [0.0, 1.0, 50.0].map(|v| vec![Rgb::splat(v); 32 * 32]);
        let flip = |a: &[Rgb<f32>], b: &[Rgb<f32>]| mean_flip(a, b, 32).unwrap();
        assert_eq!(flip(&white, &white), 0.0);
        assert_eq!(flip(&white, &bright), 0.0);
        let most = flip(&black, &white);
        assert!(most > 0.9 && most <= 1.0, "{most}");
        assert!(mean_flip(&black, &white[1..], 32).is_err());
    }

    /// A program of one line; a child writes it, so that no other test's child has it open for writing.
    fn program(folder: &Path, line: &str) -> PathBuf {
        let path = folder.join("program");
        let script = r#"printf '#!/bin/sh\n%s\n' "$1" > "$2" && chmod +x "$2""#;
        let status = Command::new("sh")
            .args(["-c", script, "sh", line])
            .arg(&path)
            .status();
        assert!(status.unwrap().success());
        path
    }

    #[test]
    fn a_denoiser_is_used_where_there_is_one() {
        let folder = std::env::temp_dir().join(format!("versus-denoiser-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let grey = vec![Rgb::splat(0.25); 20 * 10];
        let copies = program(&folder, r#"test "$1" = denoise && cp "$2" "$4""#);
        let denoiser = Denoiser::of(&copies, &folder).unwrap().unwrap();
        assert_eq!(denoiser.denoise(&grey, 20, &folder).unwrap(), grey);
        let without = program(&folder, "exit 2");
        assert!(Denoiser::of(&without, &folder).unwrap().is_none());
        assert!(denoiser.denoise(&grey, 20, &folder).is_err());
        let broken = program(&folder, "echo no library >&2; exit 127");
        let error = Denoiser::of(&broken, &folder).err().unwrap().to_string();
        assert!(error.contains("no library"), "{error}");
        fs::remove_dir_all(folder).unwrap();
    }
}
