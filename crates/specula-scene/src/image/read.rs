//! Reading of a picture file into linear RGB.

use std::io::{BufRead, Seek};
use std::path::Path;

use image::ImageFormat;

use specula_bsdf::Rgb;

use super::format::EXPECTED;
use super::{Format, Image, Pixels, exr_file, integers, pfm};
use crate::Limits;
use crate::num::f32_of;
use crate::read_file::Files;
use crate::spectrum::ColourSpace;

/// How stored integers become linear values; formats that store floats are linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Encoding {
    Srgb,
    Linear,
    Gamma(f32),
}

impl Encoding {
    /// That of colours, or of alpha, which has none.
    pub(super) fn unless(self, is_alpha: bool) -> Self {
        if is_alpha { Self::Linear } else { self }
    }

    pub(crate) fn decode(self, x: f64) -> f32 {
        f32_of(match self {
            Self::Linear => x,
            Self::Gamma(gamma) => x.powf(f64::from(gamma)),
            // IEC 61966-2-1.
            Self::Srgb if x <= 0.04045 => x / 12.92,
            Self::Srgb => ((x + 0.055) / 1.055).powf(2.4),
        })
    }
}

/// Which data of a picture are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Content {
    /// Its colours, as reflectances: the white of its colour space is white.
    Colour,
    /// Its colours, as light: white is that of its colour space.
    Light,
    /// A number, as pbrt-v4 takes it: the alpha channel where the picture has one that is not 1
    /// everywhere, else the mean of the colours. It stands in all three channels.
    Number,
    /// Its alpha channel, or 1 where it has none. It stands in all three channels.
    Alpha,
}

/// The decoded channels of a picture.
pub(super) struct Decoded {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Pixels,
    /// The colour space of its colours.
    pub(super) space: ColourSpace,
}

/// Checks a header's size against the limits, before anything is allocated for it.
pub(super) fn check_size(width: u64, height: u64, limits: &Limits) -> Result<(), String> {
    if width.saturating_mul(height) <= limits.max_pixels {
        return Ok(());
    }
    let most = limits.max_pixels;
    Err(format!(
        "it has too many pixels: {width} x {height}; at most {most} are read (`max_pixels`)"
    ))
}

/// Reads a picture.
///
/// # Errors
///
/// A message that begins with the file's name.
pub(crate) fn read(
    path: &Path,
    encoding: Encoding,
    content: Content,
    files: &Files,
) -> Result<Image, String> {
    let name = path.display().to_string();
    let wrong = |message: String| format!("picture {name}: {message}");
    let mut source = files.open(path).map_err(wrong)?;
    let head = source.fill_buf();
    let head = head.map_err(|e| wrong(format!("cannot be read: {e}")))?;
    let format = Format::of(head, path)
        .ok_or_else(|| wrong(format!("unknown format; expected {EXPECTED}")))?;
    decode(source, format, &name, encoding, content, files.limits())
}

/// Decodes a picture from its first byte on; `name` is for messages.
///
/// # Errors
///
/// A message that begins with `picture` and the name.
pub(crate) fn decode(
    source: impl BufRead + Seek,
    format: Format,
    name: &str,
    encoding: Encoding,
    content: Content,
    limits: &Limits,
) -> Result<Image, String> {
    let wrong = |message: String| format!("picture {name}: {message}");
    let of_crate = match format {
        Format::Exr | Format::Pfm => None,
        Format::Hdr => Some(ImageFormat::Hdr),
        Format::Png => Some(ImageFormat::Png),
        Format::Tga => Some(ImageFormat::Tga),
        Format::Jpeg => Some(ImageFormat::Jpeg),
        Format::Tiff => Some(ImageFormat::Tiff),
        Format::Bmp => Some(ImageFormat::Bmp),
        Format::WebP => Some(ImageFormat::WebP),
    };
    let decoded = match of_crate {
        Some(format) => integers::decode(source, format, encoding, content, limits),
        None if format == Format::Exr => exr_file::decode(source, content, limits),
        None => pfm::decode(source, content, limits),
    };
    let Decoded {
        width,
        height,
        mut pixels,
        space,
    } = decoded.map_err(wrong)?;
    if u64::from(width) * u64::from(height) != pixels.len() as u64 || pixels.is_empty() {
        return Err(wrong(
            "it has no pixels, or fewer than it promises".to_owned(),
        ));
    }
    if space != ColourSpace::Srgb {
        match content {
            Content::Colour => pixels = to_srgb(&pixels, |c| space.surface(c)),
            Content::Light => pixels = to_srgb(&pixels, |c| space.light(c)),
            Content::Number | Content::Alpha => {}
        }
    }
    if let Some(i) = pixels.position(|v| !v.is_finite()) {
        let (x, y) = (i as u64 % u64::from(width), i as u64 / u64::from(width));
        return Err(wrong(format!("pixel ({x}, {y}) is not finite")));
    }
    // Filters with negative lobes leave such values in float pictures.
    if pixels.position(|v| v < 0.0).is_some() {
        pixels = pixels.each(|v| v.max(0.0));
    }
    Ok(Image {
        name: name.to_owned(),
        width,
        height,
        pixels: pixels.compacted(),
    })
}

fn to_srgb(pixels: &Pixels, convert: impl Fn(Rgb<f32>) -> Rgb<f32>) -> Pixels {
    let convert = |p| convert(Rgb::from(p)).to_array();
    pixels.iter().map(convert).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 8 and 16 bits from one of 32.
    fn low(v: u32) -> u8 {
        v.to_le_bytes()[0]
    }

    fn low_word(v: u32) -> u16 {
        u16::from_le_bytes([low(v), low(v >> 8)])
    }

    fn written(name: &str, picture: &::image::DynamicImage) -> std::path::PathBuf {
        let path = std::env::temp_dir().join(format!("specula-{}-{name}", std::process::id()));
        picture.save(&path).unwrap();
        path
    }

    #[test]
    fn eight_bits_are_srgb_or_linear_as_asked() {
        let picture = ::image::RgbImage::from_pixel(2, 1, ::image::Rgb([255, 128, 0]));
        let path = written("rgb.png", &picture.into());
        let srgb = read(&path, Encoding::Srgb, Content::Colour, &Files::default()).unwrap();
        let linear = read(&path, Encoding::Linear, Content::Colour, &Files::default()).unwrap();
        let number = read(&path, Encoding::Linear, Content::Number, &Files::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!((srgb.width, srgb.height), (2, 1));
        assert!((srgb.pixels.rgb(0)[1] - 0.215_860_5).abs() < 1e-6);
        assert_eq!(linear.pixels.rgb(1), [1.0, 128.0 / 255.0, 0.0]);
        assert!((number.pixels.rgb(0)[0] - 383.0 / 765.0).abs() < 1e-6);
    }

    #[test]
    fn a_number_is_the_alpha_where_there_is_one() {
        let picture = ::image::RgbaImage::from_pixel(1, 1, ::image::Rgba([255, 255, 255, 51]));
        let path = written("rgba.png", &picture.into());
        let number = read(&path, Encoding::Srgb, Content::Number, &Files::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(number.pixels.rgb(0), [0.2; 3]);
    }

    #[test]
    fn exr_is_read_from_the_top() {
        let path = std::env::temp_dir().join(format!("specula-{}-top.exr", std::process::id()));
        let value = |x: usize, y: usize| (x as f32, y as f32, 0.5f32);
        exr::prelude::write_rgb_file(&path, 3, 2, value).unwrap();
        let image = read(&path, Encoding::Linear, Content::Colour, &Files::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!((image.width, image.height), (3, 2));
        assert_eq!(image.pixels.rgb(3 + 2), [2.0, 1.0, 0.5]);
    }

    /// The same picture in every format without loss, under names that say otherwise.
    #[test]
    fn formats_are_told_by_content() {
        let picture =
            ::image::RgbImage::from_fn(5, 3, |x, y| ::image::Rgb([low(x * 50), low(y * 100), 77]));
        let folder = tempfile::tempdir().unwrap();
        let load = |path: &Path| {
            let files = Files::default();
            read(path, Encoding::Srgb, Content::Colour, &files).unwrap()
        };
        let reference = folder.path().join("a.png");
        picture.save(&reference).unwrap();
        let reference = load(&reference);
        for (format, name) in [
            (ImageFormat::Bmp, "b.png"),
            (ImageFormat::Tiff, "c.exr"),
            (ImageFormat::WebP, "d.jpg"),
            (ImageFormat::Png, "e"),
            // Its content does not tell.
            (ImageFormat::Tga, "f.tga"),
        ] {
            let path = folder.path().join(name);
            picture.save_with_format(&path, format).unwrap();
            assert_eq!(load(&path).pixels, reference.pixels, "{format:?}");
        }
    }

    /// Each is stored in as many bytes a pixel as in its file.
    #[test]
    fn pixels_keep_their_depth() {
        let folder = tempfile::tempdir().unwrap();
        let size = |picture: ::image::DynamicImage, name: &str, content| {
            let path = folder.path().join(name);
            picture.save(&path).unwrap();
            let image = read(&path, Encoding::Linear, content, &Files::default()).unwrap();
            image.pixels.size() / 10_000
        };
        let bytes =
            |n: u32| move |x: u32, y: u32| [0, 1, 2, 3].map(|c| low((x * (c + n)) ^ (y * 3)));
        let rgba = |n| {
            let pixel = move |x, y| ::image::Rgba(bytes(n)(x, y));
            ::image::RgbaImage::from_fn(100, 100, pixel)
        };
        let grey = ::image::GrayImage::from_fn(100, 100, |x, y| ::image::Luma([low(x * y)]));
        let words = ::image::ImageBuffer::from_fn(100, 100, |x, y| {
            ::image::Rgb([low_word(x * y * 7), low_word(x * 501), low_word(y * 601)])
        });
        assert_eq!(size(grey.clone().into(), "a.png", Content::Number), 1);
        assert_eq!(size(rgba(1).into(), "b.png", Content::Colour), 3);
        assert_eq!(size(rgba(2).into(), "c.png", Content::Alpha), 1);
        // Beside the table of 256 KiB.
        assert_eq!(size(words.into(), "d.png", Content::Colour), 6 + 26);
        let grey_rgb = ::image::DynamicImage::from(grey).into_rgb8();
        assert_eq!(size(grey_rgb.into(), "e.png", Content::Colour), 1);
    }

    #[test]
    fn garbage_is_an_error_with_the_name() {
        for extension in [
            "png", "exr", "hdr", "tga", "jpg", "pfm", "tiff", "bmp", "webp", "x",
        ] {
            let file = format!("specula-{}-garbage.{extension}", std::process::id());
            let path = std::env::temp_dir().join(&file);
            std::fs::write(&path, [0x93u8; 64]).unwrap();
            let error =
                read(&path, Encoding::Srgb, Content::Colour, &Files::default()).unwrap_err();
            std::fs::remove_file(&path).unwrap();
            assert!(error.contains(&file), "{error}");
        }
    }
}
