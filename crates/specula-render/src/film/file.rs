//! Films as files (`.film`): what a render is resumed from, and what parts of a picture are merged
//! from.
//!
//! Little endian:
//!
//! | | |
//! |---|---|
//! | 8 bytes | `SPECFILM` |
//! | `u32` | version of the format |
//! | label | program's version, scene's name, settings (texts: `u32` length, UTF-8), scene's fingerprint (`u64`), seconds (`f64`) |
//! | film | resolution, crop, first sample (`u32` each), number of parts and parts (`u32`), work that adaptive sampling has allotted (`f64`, 0 in other films), number of tiles (`u32`) |
//! | per tile | samples that were not finite (`u64`), rays (`u64`), samples that adaptive sampling has allotted (`u32`), length (`u32`), words of its pixels, one column for each word, deflated |
//! | `u64` | XXH3 of all before |

mod read;

use std::hash::Hasher;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use rayon::prelude::*;
use specula_scene::{Scene, atomic};
use thiserror::Error;
use twox_hash::XxHash3_64;

use super::buffer::{FilmBuffer, PixelSums};
use super::tile::Tile;
use crate::options::{BIASED, RenderOptions};

const MAGIC: &[u8; 8] = b"SPECFILM";
/// Version of the format. Films of another version are not read: their fingerprints and settings are encoded
/// otherwise.
const FORMAT: u32 = 4;
/// Longest text of a label.
const LONGEST_TEXT: usize = 1 << 16;
/// What the missing files of the scene stand behind, in the settings.
const MISSING: &str = ", missing: ";
/// Most missing files that are listed.
const MOST_MISSING: usize = 50;
/// Tiles that are deflated at once.
const GROUP: usize = 256;

/// What a film belongs to. Films merge, and renders resume, only where all but the seconds agree.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Label {
    /// Version of the program: another's samples may differ.
    pub version: String,
    /// The scene's name, for messages.
    pub scene: String,
    /// [`Scene::fingerprint`](specula_scene::Scene::fingerprint).
    pub fingerprint: u64,
    /// Options that change samples, as text.
    pub settings: String,
    /// Time spent so far.
    pub seconds: f64,
}

impl Label {
    /// That of a render of a scene, before its first second.
    ///
    /// * `name`: the scene's, for messages.
    #[must_use]
    pub fn of(name: &str, scene: &Scene, options: &RenderOptions) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene: name.to_owned(),
            fingerprint: scene.fingerprint(),
            settings: options.settings(),
            seconds: 0.0,
        }
    }

    /// What biases the picture, in words; `None`: nothing does.
    #[must_use]
    pub fn bias(&self) -> Option<&str> {
        let settings = self.settings.split(MISSING).next()?;
        settings.split_once(BIASED).map(|(_, bias)| bias)
    }

    /// Adds the files of the scene that did not exist, where stand-ins are rendered for them.
    #[must_use]
    pub fn with_missing(mut self, files: &[PathBuf]) -> Self {
        if files.is_empty() {
            return self;
        }
        let list: Vec<String> = (files.iter().take(MOST_MISSING))
            .map(|f| {
                f.display()
                    .to_string()
                    .replace(|c: char| c.is_control(), "?")
            })
            .collect();
        self.settings += MISSING;
        self.settings += &list.join(", ");
        if let Some(more) = files.len().checked_sub(MOST_MISSING).filter(|n| *n > 0) {
            self.settings += &format!(" and {more} more");
        }
        let most = LONGEST_TEXT / 2;
        let end = self
            .settings
            .floor_char_boundary(most.min(self.settings.len()));
        self.settings.truncate(end);
        self
    }

    /// Files of the scene that did not exist, in words; `None`: there were all.
    #[must_use]
    pub fn missing(&self) -> Option<&str> {
        self.settings.split_once(MISSING).map(|(_, files)| files)
    }

    /// Why films of this label and of `other` are not of the same render; `None` where they are.
    #[must_use]
    pub fn difference(&self, other: &Self) -> Option<String> {
        let differ = |what: &str, a: &str, b: &str| Some(format!("{what}: {a} and {b}"));
        if self.version != other.version {
            return differ("made by different versions", &self.version, &other.version);
        }
        if self.fingerprint != other.fingerprint {
            return differ("different scenes", &self.scene, &other.scene);
        }
        if self.settings != other.settings {
            return differ("different settings", &self.settings, &other.settings);
        }
        None
    }
}

/// A film and what it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmFile {
    /// What it belongs to.
    pub label: Label,
    /// The sums.
    pub film: FilmBuffer,
}

/// What a film's file says before its sums: enough to order films, and to know which belong together. It is not held
/// against the checksum.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmHead {
    /// What it belongs to.
    pub label: Label,
    /// Index of each pixel's first sample.
    pub first_sample: u32,
}

/// Why a film cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FilmFileError {
    /// The system's error.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It is something else.
    #[error("no film of Specula's")]
    NotAFilm,
    /// It is of another version of the format.
    #[error(
        "a film in version {0} of the format; this program reads version {FORMAT}: render it again, or use the \
         program that wrote it"
    )]
    Format(u32),
    /// Its checksum is wrong, or it is cut off.
    #[error("damaged or cut off: its checksum does not agree")]
    Damaged,
}

impl FilmFile {
    /// Writes the film in place of `path`, whole or not at all.
    ///
    /// # Errors
    /// The system's.
    pub fn write(path: &Path, label: &Label, film: &FilmBuffer) -> io::Result<()> {
        atomic::replace(path, |file| {
            let mut out = Hashing {
                inner: file,
                hash: XxHash3_64::new(),
            };
            out.write_all(MAGIC)?;
            out.write_all(&FORMAT.to_le_bytes())?;
            write_label(&mut out, label)?;
            write_head(&mut out, film)?;
            for tiles in film.tiles.chunks(GROUP) {
                let packed: Vec<_> = tiles.par_iter().map(pack).collect();
                for (tile, packed) in tiles.iter().zip(packed) {
                    let packed = packed?;
                    out.write_all(&tile.invalid.to_le_bytes())?;
                    out.write_all(&tile.rays.to_le_bytes())?;
                    out.write_all(&tile.target.to_le_bytes())?;
                    out.write_all(&length(packed.len())?.to_le_bytes())?;
                    out.write_all(&packed)?;
                }
            }
            let sum = out.hash.finish();
            out.inner.write_all(&sum.to_le_bytes())
        })
    }
}

fn write_label(out: &mut impl Write, label: &Label) -> io::Result<()> {
    for text in [&label.version, &label.scene, &label.settings] {
        let text = &text.as_bytes()[..text.floor_char_boundary(LONGEST_TEXT)];
        out.write_all(&length(text.len())?.to_le_bytes())?;
        out.write_all(text)?;
    }
    out.write_all(&label.fingerprint.to_le_bytes())?;
    out.write_all(&label.seconds.to_le_bytes())
}

fn write_head(out: &mut impl Write, film: &FilmBuffer) -> io::Result<()> {
    let parts = if film.is_open() {
        Vec::new()
    } else {
        film.samples()
    };
    let size = film.full_resolution().into_iter().chain(film.crop());
    let head = size
        .chain([film.first_sample(), length(parts.len())?])
        .chain(parts.into_iter().flatten());
    for number in head {
        out.write_all(&number.to_le_bytes())?;
    }
    out.write_all(&film.work.to_le_bytes())?;
    out.write_all(&length(film.tiles.len())?.to_le_bytes())
}

/// A count as the file holds it.
fn length(n: usize) -> io::Result<u32> {
    u32::try_from(n).map_err(|_| io::Error::other("too large for a film's file"))
}

/// A tile's words, column by column, deflated: most low halves of sums are 0.
fn pack(tile: &Tile) -> io::Result<Vec<u8>> {
    let pixels: Vec<_> = tile.pixels.iter().map(PixelSums::words).collect();
    let columns =
        (0..PixelSums::WORDS).flat_map(|c| pixels.iter().flat_map(move |w| w[c].to_le_bytes()));
    let bytes: Vec<u8> = columns.collect();
    // At once: each write clears the encoder's buffer.
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(&bytes)?;
    encoder.finish()
}

/// Hashes what is written.
struct Hashing<W> {
    inner: W,
    hash: XxHash3_64,
}

impl<W: Write> Write for Hashing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = self.inner.write(bytes)?;
        Hasher::write(&mut self.hash, &bytes[..n]);
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use specula_bsdf::{Rgb, Vec3};

    use super::super::buffer::PixelSample;
    use super::*;

    fn label() -> Label {
        Label {
            version: "1.2.3".to_owned(),
            scene: "röst.pbrt".to_owned(),
            fingerprint: 0x1234_5678_9abc_def0,
            settings: "seed 7".to_owned(),
            seconds: 12.5,
        }
    }

    /// 20 x 18 pixels, cropped, of three samples each.
    fn film(first: u32) -> FilmBuffer {
        let mut film = FilmBuffer::new([20, 18], [1, 19, 0, 18], first);
        for (i, tile) in film.tiles.iter_mut().enumerate() {
            for (j, p) in tile.pixels.iter_mut().enumerate() {
                for k in 0..3 {
                    let v = (i * 1000 + j * 3 + k) as f32 * 0.1;
                    let sample = PixelSample {
                        colour: Rgb::splat(v),
                        albedo: Rgb::WHITE,
                        normal: Vec3::Z,
                        depth: (j % 2 == 0).then_some(v),
                    };
                    p.add(&sample, 1.1);
                }
            }
            tile.invalid = i as u64;
        }
        film
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.film");
        let mut gaps = film(0);
        gaps.merge(&film(9)).unwrap();
        let mut adaptive = film(0);
        adaptive.work = 3.5;
        for (tile, target) in adaptive.tiles.iter_mut().zip(3..) {
            (tile.rays, tile.target) = (1 << 40, target);
        }
        let empty = FilmBuffer::new([3, 2], [0, 3, 0, 2], 0);
        for film in [film(5), gaps, adaptive, empty] {
            FilmFile::write(&path, &label(), &film).unwrap();
            let read = FilmFile::read(&path).unwrap();
            let head = FilmFile::read_head(&path).unwrap();
            let first = film.first_sample();
            assert_eq!((head.label, head.first_sample), (label(), first));
            assert_eq!((read.label, read.film), (label(), film));
        }
    }

    #[test]
    fn damage_is_found_and_never_panics() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.film");
        FilmFile::write(&path, &label(), &film(5)).unwrap();
        let whole = std::fs::read(&path).unwrap();
        let kind = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            let _ = FilmFile::read_head(&path);
            FilmFile::read(&path).map(|_| ()).unwrap_err()
        };
        for cut in (8..whole.len()).step_by(37) {
            assert!(
                matches!(kind(&whole[..cut]), FilmFileError::Damaged),
                "{cut}"
            );
        }
        for at in (12..whole.len()).step_by(41) {
            let mut bytes = whole.clone();
            bytes[at] ^= 4;
            assert!(matches!(kind(&bytes), FilmFileError::Damaged), "{at}");
        }
        // With a checksum that agrees, too.
        for at in 12..whole.len() - 8 {
            for value in [0, 255] {
                let mut bytes = whole[..whole.len() - 8].to_vec();
                bytes[at] = value;
                let sum = XxHash3_64::oneshot(&bytes);
                bytes.extend(sum.to_le_bytes());
                std::fs::write(&path, bytes).unwrap();
                let _ = (FilmFile::read_head(&path), FilmFile::read(&path));
            }
            if at > 200 {
                break;
            }
        }
        assert!(matches!(kind(b"P6 1 1"), FilmFileError::NotAFilm));
        assert!(matches!(
            kind(b"SPECFILM\x01\0\0\0"),
            FilmFileError::Format(1)
        ));
        let missing = FilmFile::read(&folder.path().join("none.film"));
        assert!(matches!(missing, Err(FilmFileError::Io(_))));
    }

    #[test]
    fn a_label_names_missing_files_beside_what_biases() {
        let label = Label {
            settings: format!("depth 5, {BIASED}regularized"),
            ..label()
        };
        assert_eq!(label.clone().with_missing(&[]), label);
        assert_eq!(label.missing(), None);
        let files: Vec<PathBuf> = (0..60).map(|i| format!("{i}.png").into()).collect();
        let named = label.clone().with_missing(&files);
        assert_eq!(named.bias(), Some("regularized"));
        let missing = named.missing().unwrap();
        assert!(
            missing.starts_with("0.png, 1.png, ") && missing.ends_with("49.png and 10 more"),
            "{missing}"
        );
        assert!(label.difference(&named).is_some());
        let long = label.with_missing(&["x".repeat(1 << 20).into()]);
        assert!(long.settings.len() < LONGEST_TEXT);
    }

    #[test]
    fn labels_say_where_they_differ() {
        let other = Label {
            fingerprint: 1,
            scene: "b.pbrt".to_owned(),
            ..label()
        };
        let text = label().difference(&other).unwrap();
        assert!(text.contains("röst.pbrt and b.pbrt"), "{text}");
        let longer = Label {
            seconds: 99.0,
            ..label()
        };
        assert_eq!(label().difference(&longer), None);
    }
}
