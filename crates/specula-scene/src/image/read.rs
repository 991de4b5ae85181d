//! Reading of a picture file into linear RGB.

use std::io::Cursor;
use std::path::Path;

use specula_bsdf::Rgb;

use super::{Image, exr_file, pfm};
use crate::Limits;
use crate::num::f32_of;
use crate::read_file::plain_bytes;
use crate::spectrum::ColourSpace;

/// A picture format, told by the file's extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Exr,
    Pfm,
    Hdr,
    Png,
    Tga,
    Jpeg,
}

impl Format {
    pub(crate) fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "exr" => Some(Self::Exr),
            "pfm" => Some(Self::Pfm),
            "hdr" => Some(Self::Hdr),
            "png" => Some(Self::Png),
            "tga" => Some(Self::Tga),
            "jpg" | "jpeg" => Some(Self::Jpeg),
            _ => None,
        }
    }
}

/// How stored integers become linear values; formats that store floats are linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Encoding {
    Srgb,
    Linear,
    Gamma(f32),
}

impl Encoding {
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

/// What is wanted of a picture.
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

/// A decoded picture with its alpha channel.
pub(super) struct Decoded {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<[f32; 3]>,
    pub(super) alpha: Option<Vec<f32>>,
    /// What its colours are meant in.
    pub(super) space: ColourSpace,
}

/// Holds a header's size against the limits, before anything is allocated for it.
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
    limits: &Limits,
) -> Result<Image, String> {
    let name = path.display().to_string();
    let wrong = |message: String| format!("picture {name}: {message}");
    let format = Format::of(path).ok_or_else(|| {
        wrong("unknown format; expected .exr, .pfm, .hdr, .png, .tga, .jpg or .jpeg".to_owned())
    })?;
    let bytes = plain_bytes(path, limits).map_err(wrong)?;
    decode(&bytes, format, &name, encoding, content, limits)
}

/// Decodes a picture that is already in memory; `name` is for messages.
///
/// # Errors
///
/// A message that begins with `picture` and the name.
pub(crate) fn decode(
    bytes: &[u8],
    format: Format,
    name: &str,
    encoding: Encoding,
    content: Content,
    limits: &Limits,
) -> Result<Image, String> {
    let wrong = |message: String| format!("picture {name}: {message}");
    let integers = |format| integers_or_hdr(bytes, format, encoding, limits);
    let decoded = match format {
        Format::Exr => exr_file::decode(bytes, limits),
        Format::Pfm => pfm::decode(bytes, limits),
        Format::Hdr => integers(::image::ImageFormat::Hdr),
        Format::Png => integers(::image::ImageFormat::Png),
        Format::Tga => integers(::image::ImageFormat::Tga),
        Format::Jpeg => integers(::image::ImageFormat::Jpeg),
    };
    let Decoded {
        width,
        height,
        mut pixels,
        alpha,
        space,
    } = decoded.map_err(wrong)?;
    if u64::from(width) * u64::from(height) != pixels.len() as u64 || pixels.is_empty() {
        return Err(wrong(
            "it has no pixels, or fewer than it promises".to_owned(),
        ));
    }
    let alpha = alpha.filter(|a| a.len() == pixels.len() && a.iter().any(|&a| a != 1.0));
    match (content, alpha) {
        (Content::Colour, _) => to_srgb(&mut pixels, &space, ColourSpace::surface),
        (Content::Light, _) => to_srgb(&mut pixels, &space, ColourSpace::light),
        (Content::Number | Content::Alpha, Some(alpha)) => {
            pixels.iter_mut().zip(alpha).for_each(|(p, a)| *p = [a; 3]);
        }
        (Content::Number, None) => pixels
            .iter_mut()
            .for_each(|p| *p = [(p[0] + p[1] + p[2]) / 3.0; 3]),
        (Content::Alpha, None) => pixels.fill([1.0; 3]),
    }
    if let Some(i) = pixels.iter().position(|p| p.iter().any(|v| !v.is_finite())) {
        let (x, y) = (i as u64 % u64::from(width), i as u64 / u64::from(width));
        return Err(wrong(format!("pixel ({x}, {y}) is not finite")));
    }
    // Filters with negative lobes leave such values in float pictures.
    pixels.iter_mut().for_each(|p| *p = p.map(|v| v.max(0.0)));
    Ok(Image {
        name: name.to_owned(),
        width,
        height,
        pixels,
    })
}

fn to_srgb(
    pixels: &mut [[f32; 3]],
    space: &ColourSpace,
    convert: impl Fn(&ColourSpace, Rgb<f32>) -> Rgb<f32>,
) {
    if *space != ColourSpace::Srgb {
        for pixel in pixels {
            let [r, g, b] = *pixel;
            *pixel = convert(space, Rgb { r, g, b }).to_array();
        }
    }
}

fn integers_or_hdr(
    bytes: &[u8],
    format: ::image::ImageFormat,
    encoding: Encoding,
    limits: &Limits,
) -> Result<Decoded, String> {
    use ::image::DynamicImage as Dynamic;
    let mut reader = ::image::ImageReader::with_format(Cursor::new(bytes), format);
    let mut memory = ::image::Limits::no_limits();
    // 4 channels of 4 bytes, and as much again for the decoder.
    memory.max_alloc = Some(limits.max_pixels.saturating_mul(32));
    reader.limits(memory);
    let decoder = reader.into_decoder().map_err(|e| e.to_string())?;
    let (width, height) = ::image::ImageDecoder::dimensions(&decoder);
    check_size(u64::from(width), u64::from(height), limits)?;
    let picture = Dynamic::from_decoder(decoder).map_err(|e| e.to_string())?;
    let table = |last: u16| -> Vec<f32> {
        (0..=last)
            .map(|i| encoding.decode(f64::from(i) / f64::from(last)))
            .collect()
    };
    let eight = |v: u8| f32::from(v) / 255.0;
    let sixteen = |v: u16| f32::from(v) / 65535.0;
    let (pixels, alpha) = match picture {
        Dynamic::ImageRgb32F(buffer) => (buffer.pixels().map(|p| p.0).collect(), None),
        Dynamic::ImageRgba32F(_) => {
            let buffer = picture.into_rgb32f();
            (buffer.pixels().map(|p| p.0).collect(), None)
        }
        Dynamic::ImageLuma8(buffer) => {
            let table = table(255);
            let grey = |p: &u8| [table[usize::from(*p)]; 3];
            (buffer.as_raw().iter().map(grey).collect(), None)
        }
        Dynamic::ImageRgb8(buffer) => {
            let table = table(255);
            let colour = |p: &[u8; 3]| p.map(|v| table[usize::from(v)]);
            (
                buffer.as_raw().as_chunks().0.iter().map(colour).collect(),
                None,
            )
        }
        Dynamic::ImageLumaA8(_) | Dynamic::ImageRgba8(_) => {
            let table = table(255);
            let buffer = picture.into_rgba8();
            let colour = |p: &[u8; 4]| [p[0], p[1], p[2]].map(|v| table[usize::from(v)]);
            let pixels = buffer.pixels().map(|p| colour(&p.0)).collect();
            (
                pixels,
                Some(buffer.pixels().map(|p| eight(p.0[3])).collect()),
            )
        }
        _ => {
            let table = table(65535);
            let has_alpha = picture.has_alpha();
            let buffer = picture.into_rgba16();
            let colour = |p: &[u16; 4]| [p[0], p[1], p[2]].map(|v| table[usize::from(v)]);
            let pixels = buffer.pixels().map(|p| colour(&p.0)).collect();
            let alpha = || buffer.pixels().map(|p| sixteen(p.0[3])).collect();
            (pixels, has_alpha.then(alpha))
        }
    };
    Ok(Decoded {
        width,
        height,
        pixels,
        alpha,
        space: ColourSpace::Srgb,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(name: &str, picture: &::image::DynamicImage) -> std::path::PathBuf {
        let path = std::env::temp_dir().join(format!("specula-{}-{name}", std::process::id()));
        picture.save(&path).unwrap();
        path
    }

    #[test]
    fn eight_bits_are_srgb_or_linear_as_asked() {
        let picture = ::image::RgbImage::from_pixel(2, 1, ::image::Rgb([255, 128, 0]));
        let path = written("rgb.png", &picture.into());
        let srgb = read(&path, Encoding::Srgb, Content::Colour, &Limits::default()).unwrap();
        let linear = read(&path, Encoding::Linear, Content::Colour, &Limits::default()).unwrap();
        let number = read(&path, Encoding::Linear, Content::Number, &Limits::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!((srgb.width, srgb.height), (2, 1));
        assert!((srgb.pixels[0][1] - 0.215_860_5).abs() < 1e-6);
        assert_eq!(linear.pixels[1], [1.0, 128.0 / 255.0, 0.0]);
        assert!((number.pixels[0][0] - 383.0 / 765.0).abs() < 1e-6);
    }

    #[test]
    fn a_number_is_the_alpha_where_there_is_one() {
        let picture = ::image::RgbaImage::from_pixel(1, 1, ::image::Rgba([255, 255, 255, 51]));
        let path = written("rgba.png", &picture.into());
        let number = read(&path, Encoding::Srgb, Content::Number, &Limits::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(number.pixels[0], [0.2; 3]);
    }

    #[test]
    fn exr_is_read_from_the_top() {
        let path = std::env::temp_dir().join(format!("specula-{}-top.exr", std::process::id()));
        let value = |x: usize, y: usize| (x as f32, y as f32, 0.5f32);
        exr::prelude::write_rgb_file(&path, 3, 2, value).unwrap();
        let image = read(&path, Encoding::Linear, Content::Colour, &Limits::default()).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!((image.width, image.height), (3, 2));
        assert_eq!(image.pixels[3 + 2], [2.0, 1.0, 0.5]);
    }

    #[test]
    fn garbage_is_an_error_with_the_name() {
        for extension in ["png", "exr", "hdr", "tga", "jpg", "pfm", "tiff"] {
            let file = format!("specula-{}-garbage.{extension}", std::process::id());
            let path = std::env::temp_dir().join(&file);
            std::fs::write(&path, [0x93u8; 64]).unwrap();
            let error =
                read(&path, Encoding::Srgb, Content::Colour, &Limits::default()).unwrap_err();
            std::fs::remove_file(&path).unwrap();
            assert!(error.contains(&file), "{error}");
        }
    }
}
