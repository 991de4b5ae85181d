//! References: the mean of two renders of different seeds, stored and reused.

use std::fs;
use std::path::{Path, PathBuf};

use specula_bsdf::Rgb;
use specula_render::picture::read_exr;

use super::renderers::Engine;
use super::statistics::Errors;
use crate::Result;

/// Seed of the first half, one below that of the second; the rounds have 1, 2, 3 and so on.
const SEED: u32 = 1000;

/// The mean of two renders of different seeds.
pub(crate) struct Reference {
    pub(crate) width: usize,
    pub(crate) picture: Vec<Rgb<f32>>,
    /// Samples of both halves.
    pub(crate) spp: u32,
    /// Its own.
    errors: Errors,
}

impl Reference {
    /// Reads the stored one of at least `half` samples in each half, or renders it.
    ///
    /// * `start`: begin of its files' names, which tells renderer, scene and sampler.
    pub(crate) fn of(
        engine: &mut dyn Engine,
        sampler: &str,
        half: u32,
        folder: &Path,
        start: &str,
    ) -> Result<Self> {
        if let Some(spp) = stored(folder, start, half)? {
            return Self::read(&half_files(folder, start, spp), 2 * spp);
        }
        let unfinished = folder.join("reference.exr");
        let mut taken = 0;
        for (i, seed) in [SEED, SEED + 1].into_iter().enumerate() {
            taken = engine.render(sampler, half, seed, &unfinished)?.spp;
            fs::rename(&unfinished, &half_files(folder, start, taken)[i])?;
        }
        Self::read(&half_files(folder, start, taken), 2 * taken)
    }

    fn read(halves: &[PathBuf; 2], spp: u32) -> Result<Self> {
        let (width, a) = colours(&halves[0])?;
        let (_, b) = colours(&halves[1])?;
        let picture: Vec<_> = a.iter().zip(&b).map(|(&a, &b)| (a + b) * 0.5).collect();
        let errors =
            Errors::of_mean(&picture, [&a, &b], width).ok_or("halves of different sizes")?;
        Ok(Self {
            width,
            picture,
            spp,
            errors,
        })
    }

    /// The errors of a picture, less those of the reference.
    pub(crate) fn errors(&self, picture: &[Rgb<f32>]) -> Result<Errors> {
        let measured = Errors::of(&self.picture, picture, self.width);
        let measured = measured.ok_or("pictures of different sizes")?;
        Ok(measured.less(self.errors))
    }

    /// The errors of a picture, as the difference to one of another seed tells them.
    pub(crate) fn errors_of_pair(&self, pair: [&[Rgb<f32>]; 2]) -> Result<Errors> {
        let errors = Errors::of_pair(&self.picture, pair, self.width);
        errors.ok_or_else(|| "pictures of different sizes".into())
    }

    /// Its own root mean squared error.
    pub(crate) fn rmse(&self) -> f64 {
        self.errors.mse.sqrt()
    }
}

/// Width and colours of a picture.
pub(crate) fn colours(path: &Path) -> Result<(usize, Vec<Rgb<f32>>)> {
    let picture = read_exr(path)?;
    Ok((picture.width as usize, picture.colour))
}

/// Where the halves of a reference lie.
fn half_files(folder: &Path, start: &str, spp: u32) -> [PathBuf; 2] {
    [1, 2].map(|i| folder.join(format!("{start}{spp}-{i}.exr")))
}

/// Samples of each half of the stored reference that has most, at least `wanted`.
fn stored(folder: &Path, start: &str, wanted: u32) -> Result<Option<u32>> {
    let mut best = None;
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let file = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
        let samples = file
            .strip_prefix(start)
            .and_then(|rest| rest.strip_suffix("-2.exr")?.parse().ok());
        if let Some(samples) = samples.filter(|&s: &u32| s >= wanted) {
            best = best.max(Some(samples));
        }
    }
    Ok(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_of_another_scene_or_too_few_samples_are_not_taken() {
        let folder = std::env::temp_dir().join(format!("versus-references-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        for (key, spp) in [(1, 64), (1, 512), (1, 128), (2, 4096)] {
            for file in half_files(&folder, &format!("a-{key}-"), spp) {
                fs::write(file, "").unwrap();
            }
        }
        let found = |key, wanted| stored(&folder, &format!("a-{key}-"), wanted).unwrap();
        assert_eq!(found(1, 100), Some(512));
        assert_eq!(found(1, 1000), None);
        assert_eq!(found(3, 1), None);
        fs::remove_dir_all(folder).unwrap();
    }
}
