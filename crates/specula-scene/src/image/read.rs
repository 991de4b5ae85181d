//! Reading of a picture file into linear RGB.

use std::io::Cursor;
use std::path::Path;

use super::{Image, MAX_PIXELS, exr_file, pfm};
use crate::num::f32_of;

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
    fn decode(self, x: f64) -> f32 {
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// Its colours.
    Colour,
    /// A number, as pbrt-v4 takes it: the alpha channel where the picture has one that is not 1
    /// everywhere, else the mean of the colours. It stands in all three channels.
    Number,
}

/// A decoded picture with its alpha channel.
pub(super) struct Decoded {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) pixels: Vec<[f32; 3]>,
    pub(super) alpha: Option<Vec<f32>>,
}

/// Reads a picture.
///
/// # Errors
///
/// A message that begins with the file's name.
pub(crate) fn read(path: &Path, encoding: Encoding, content: Content) -> Result<Image, String> {
    let name = path.display().to_string();
    let wrong = |message: String| format!("picture {name}: {message}");
    let format = Format::of(path).ok_or_else(|| {
        wrong("unknown format; expected .exr, .pfm, .hdr, .png, .tga, .jpg or .jpeg".to_owned())
    })?;
    let bytes = std::fs::read(path).map_err(|e| wrong(format!("cannot be read: {e}")))?;
    let decoded = match format {
        Format::Exr => exr_file::decode(&bytes),
        Format::Pfm => pfm::decode(&bytes),
        Format::Hdr => integers_or_hdr(&bytes, ::image::ImageFormat::Hdr, Encoding::Linear),
        Format::Png => integers_or_hdr(&bytes, ::image::ImageFormat::Png, encoding),
        Format::Tga => integers_or_hdr(&bytes, ::image::ImageFormat::Tga, encoding),
        Format::Jpeg => integers_or_hdr(&bytes, ::image::ImageFormat::Jpeg, encoding),
    };
    let Decoded {
        width,
        height,
        mut pixels,
        alpha,
    } = decoded.map_err(wrong)?;
    if u64::from(width) * u64::from(height) != pixels.len() as u64 || pixels.is_empty() {
        return Err(wrong(
            "it has no pixels, or fewer than it promises".to_owned(),
        ));
    }
    if content == Content::Number {
        match alpha.filter(|a| a.len() == pixels.len() && a.iter().any(|&a| a != 1.0)) {
            Some(alpha) => pixels.iter_mut().zip(alpha).for_each(|(p, a)| *p = [a; 3]),
            None => pixels
                .iter_mut()
                .for_each(|p| *p = [(p[0] + p[1] + p[2]) / 3.0; 3]),
        }
    }
    if let Some(i) = pixels.iter().position(|p| p.iter().any(|v| !v.is_finite())) {
        let (x, y) = (i as u64 % u64::from(width), i as u64 / u64::from(width));
        return Err(wrong(format!("pixel ({x}, {y}) is not finite")));
    }
    // Filters with negative lobes leave such values in float pictures.
    pixels.iter_mut().for_each(|p| *p = p.map(|v| v.max(0.0)));
    Ok(Image {
        name,
        width,
        height,
        pixels,
    })
}

fn integers_or_hdr(
    bytes: &[u8],
    format: ::image::ImageFormat,
    encoding: Encoding,
) -> Result<Decoded, String> {
    let picture = ::image::ImageReader::with_format(Cursor::new(bytes), format)
        .decode()
        .map_err(|e| e.to_string())?;
    let (width, height) = (picture.width(), picture.height());
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!("it has too many pixels: {width} x {height}"));
    }
    use ::image::DynamicImage as Dynamic;
    let has_alpha = picture.has_alpha();
    let (pixels, alpha) = match &picture {
        Dynamic::ImageRgb32F(_) | Dynamic::ImageRgba32F(_) => {
            let buffer = picture.into_rgb32f();
            (buffer.pixels().map(|p| p.0).collect(), None)
        }
        Dynamic::ImageLuma8(_)
        | Dynamic::ImageLumaA8(_)
        | Dynamic::ImageRgb8(_)
        | Dynamic::ImageRgba8(_) => {
            let table: Vec<f32> = (0..=255u8)
                .map(|i| encoding.decode(f64::from(i) / 255.0))
                .collect();
            let buffer = picture.into_rgba8();
            let colour = |p: &[u8; 4]| [p[0], p[1], p[2]].map(|v| table[usize::from(v)]);
            let pixels = buffer.pixels().map(|p| colour(&p.0)).collect();
            (
                pixels,
                has_alpha.then(|| buffer.pixels().map(|p| f32::from(p.0[3]) / 255.0).collect()),
            )
        }
        _ => {
            let buffer = picture.into_rgba16();
            let decode = |v: u16| encoding.decode(f64::from(v) / 65535.0);
            let pixels = buffer
                .pixels()
                .map(|p| [p.0[0], p.0[1], p.0[2]].map(decode))
                .collect();
            let alpha = |p: &::image::Rgba<u16>| f32::from(p.0[3]) / 65535.0;
            (
                pixels,
                has_alpha.then(|| buffer.pixels().map(alpha).collect()),
            )
        }
    };
    Ok(Decoded {
        width,
        height,
        pixels,
        alpha,
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
        let srgb = read(&path, Encoding::Srgb, Content::Colour).unwrap();
        let linear = read(&path, Encoding::Linear, Content::Colour).unwrap();
        let number = read(&path, Encoding::Linear, Content::Number).unwrap();
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
        let number = read(&path, Encoding::Srgb, Content::Number).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(number.pixels[0], [0.2; 3]);
    }

    #[test]
    fn exr_is_read_from_the_top() {
        let path = std::env::temp_dir().join(format!("specula-{}-top.exr", std::process::id()));
        let value = |x: usize, y: usize| (x as f32, y as f32, 0.5f32);
        exr::prelude::write_rgb_file(&path, 3, 2, value).unwrap();
        let image = read(&path, Encoding::Linear, Content::Colour).unwrap();
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
            let error = read(&path, Encoding::Srgb, Content::Colour).unwrap_err();
            std::fs::remove_file(&path).unwrap();
            assert!(error.contains(&file), "{error}");
        }
    }
}
