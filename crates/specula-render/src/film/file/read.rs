//! Reading films.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;
use rayon::prelude::*;
use twox_hash::XxHash3_64;

use super::super::buffer::{FilmBuffer, PixelSums};
use super::super::tile::{Tile, area, bounds_of, empty_tiles};
use super::{FORMAT, FilmFile, FilmFileError, FilmHead, LONGEST_TEXT, Label, MAGIC};

/// Most pixels of a film that is read: those of a picture.
const MOST_PIXELS: u64 = 1 << 30;
/// Bytes that hold a label, its texts at their longest, and the numbers behind it.
const LONGEST_HEAD: u64 = 4 * LONGEST_TEXT as u64;

impl FilmFile {
    /// Reads a film.
    ///
    /// # Errors
    /// Where the file cannot be read, is no film, is of another format or damaged.
    pub fn read(path: &Path) -> Result<Self, FilmFileError> {
        let bytes = std::fs::read(path)?;
        let input = begin(&bytes)?;
        let content = bytes.len().checked_sub(8).ok_or(FilmFileError::Damaged)?;
        let (content, sum) = bytes.split_at(content);
        if XxHash3_64::oneshot(content).to_le_bytes() != sum {
            return Err(FilmFileError::Damaged);
        }
        parse(input).ok_or(FilmFileError::Damaged)
    }

    /// Reads what a film's file says before its sums.
    ///
    /// # Errors
    /// As of [`read`](Self::read), but that damage behind the head is not seen.
    pub fn read_head(path: &Path) -> Result<FilmHead, FilmFileError> {
        let mut bytes = Vec::new();
        File::open(path)?
            .take(LONGEST_HEAD)
            .read_to_end(&mut bytes)?;
        let mut input = begin(&bytes)?;
        let (label, size) = start(&mut input).ok_or(FilmFileError::Damaged)?;
        Ok(FilmHead {
            label,
            first_sample: size.first_sample,
        })
    }
}

/// What follows the format's version.
fn begin(bytes: &[u8]) -> Result<Input<'_>, FilmFileError> {
    let rest = bytes.strip_prefix(MAGIC).ok_or(FilmFileError::NotAFilm)?;
    let mut input = Input(rest);
    match input.u32().ok_or(FilmFileError::Damaged)? {
        FORMAT => Ok(input),
        other => Err(FilmFileError::Format(other)),
    }
}

/// Bytes of a pixel, unpacked.
const BYTES_PER_PIXEL: usize = PixelSums::WORDS * 8;
/// Bytes that a packed one makes at most: no method deflates more.
const MOST_RATIO: usize = 1032;

/// The size of a film, and where its samples begin.
struct Size {
    resolution: [u32; 2],
    crop: [u32; 4],
    first_sample: u32,
}

/// The label, and the size that follows it; `None` where something does not fit.
fn start(input: &mut Input<'_>) -> Option<(Label, Size)> {
    let [version, scene, settings] = [input.text()?, input.text()?, input.text()?];
    let label = Label {
        version,
        scene,
        settings,
        fingerprint: u64::from_le_bytes(input.array()?),
        seconds: input.f64()?,
    };
    let mut number = || input.u32();
    let [width, height] = [number()?, number()?];
    let [x0, x1, y0, y1] = [number()?, number()?, number()?, number()?];
    let fits = x0 < x1 && x1 <= width && y0 < y1 && y1 <= height;
    if !fits || u64::from(width) * u64::from(height) > MOST_PIXELS {
        return None;
    }
    let size = Size {
        resolution: [width, height],
        crop: [x0, x1, y0, y1],
        first_sample: number()?,
    };
    Some((label, size))
}

/// All after the format's version; `None` where something does not fit.
fn parse(mut input: Input<'_>) -> Option<FilmFile> {
    let (label, size) = start(&mut input)?;
    let part_count = input.u32()?;
    let parts = (0..part_count)
        .map(|_| Some([input.u32()?, input.u32()?]))
        .collect::<Option<Vec<_>>>()?;
    let work = input.f64()?;
    let tile_count = input.u32()? as usize;
    if bounds_of(size.crop).count() != tile_count || !(0.0..=f64::MAX).contains(&work) {
        return None;
    }
    let packed = bounds_of(size.crop)
        .map(|bounds| {
            let [invalid, rays] = [input.array()?, input.array()?].map(u64::from_le_bytes);
            let target = input.u32()?;
            let length = input.u32()? as usize;
            let packed = input.take(length)?;
            // Before memory is taken for what cannot be there.
            let enough = area(bounds) * BYTES_PER_PIXEL <= length * MOST_RATIO;
            enough.then_some((invalid, rays, target, packed))
        })
        .collect::<Option<Vec<_>>>()?;
    let mut tiles = empty_tiles(size.crop);
    tiles
        .par_iter_mut()
        .zip(packed)
        .try_for_each(|(tile, (invalid, rays, target, packed))| {
            (tile.invalid, tile.rays, tile.target) = (invalid, rays, target);
            unpack(packed, tile)
        })?;
    let Size {
        resolution,
        crop,
        first_sample,
    } = size;
    let film = FilmBuffer::restore(resolution, crop, first_sample, parts, work, tiles)?;
    Some(FilmFile { label, film })
}

/// Sets the pixels of a tile; `None` where there are not exactly as many.
fn unpack(packed: &[u8], tile: &mut Tile) -> Option<()> {
    let count = tile.pixels.len();
    let mut bytes = vec![0; count * BYTES_PER_PIXEL];
    let mut decoder = ZlibDecoder::new(packed);
    decoder.read_exact(&mut bytes).ok()?;
    if decoder.read(&mut [0]).ok()? != 0 {
        return None;
    }
    let (words, _) = bytes.as_chunks::<8>();
    for (i, pixel) in tile.pixels.iter_mut().enumerate() {
        let word = |column: usize| u64::from_le_bytes(words[column * count + i]);
        *pixel = PixelSums::from_words(&core::array::from_fn(word));
    }
    Some(())
}

/// Bytes yet to be read.
struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    fn take(&mut self, n: usize) -> Option<&'a [u8]> {
        let (head, rest) = self.0.split_at_checked(n)?;
        self.0 = rest;
        Some(head)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    fn f64(&mut self) -> Option<f64> {
        self.array().map(f64::from_le_bytes)
    }

    fn text(&mut self) -> Option<String> {
        let length = self.u32()? as usize;
        let bytes = self.take(length)?;
        (length <= LONGEST_TEXT).then(|| String::from_utf8_lossy(bytes).into_owned())
    }
}
